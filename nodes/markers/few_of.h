#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace stillframe::nodes {

/// A list that holds its first element in itself, and all of them in a vector from the second on: for what is mostly
/// one, and there a hundred thousand times. In one piece, as a vector is.
template <typename T>
class FewOf {
 public:
  using value_type = T;

  [[nodiscard]] std::size_t size() const noexcept { return one_ ? 1 : many_.size(); }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] const T* data() const noexcept { return one_ ? &*one_ : many_.data(); }
  [[nodiscard]] T* data() noexcept { return one_ ? &*one_ : many_.data(); }
  [[nodiscard]] const T* begin() const noexcept { return data(); }
  [[nodiscard]] const T* end() const noexcept { return data() + size(); }
  [[nodiscard]] T* begin() noexcept { return data(); }
  [[nodiscard]] T* end() noexcept { return data() + size(); }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept { return data()[i]; }
  [[nodiscard]] T& operator[](std::size_t i) noexcept { return data()[i]; }
  [[nodiscard]] const T& at(std::size_t i) const {
    if (i >= size()) {
      throw std::out_of_range("FewOf::at");
    }
    return data()[i];
  }

  /// Invalidates references to the elements.
  T& push_back(T value) {  // NOLINT(readability-identifier-naming): as containers have it
    if (empty()) {
      return one_.emplace(std::move(value));
    }
    if (one_) {
      many_.push_back(std::move(*one_));
      one_.reset();
    }
    return many_.emplace_back(std::move(value));
  }

  /// Memory besides its own.
  [[nodiscard]] std::size_t byteSize() const noexcept { return many_.size() * sizeof(T); }

 private:
  std::optional<T> one_;
  std::vector<T> many_;
};

}  // namespace stillframe::nodes
