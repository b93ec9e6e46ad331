#pragma once

#include <cstdint>
#include <map>

namespace stillframe::nodes {

/// Which places of a batch are taken. Single places fill the lowest gap; longer runs go to the end.
class PlaceList {
 public:
  [[nodiscard]] std::uint32_t take(std::uint32_t count);
  /// Marks places as taken that another list gave: in ascending order, after nothing else.
  void restore(std::uint32_t first, std::uint32_t count);
  void free(std::uint32_t first, std::uint32_t count);

  [[nodiscard]] std::uint32_t size() const noexcept { return size_; }
  [[nodiscard]] std::uint32_t taken() const noexcept { return taken_; }
  /// Whether so much is free between what is taken that it should be moved together.
  [[nodiscard]] bool isSparse() const noexcept { return size_ - taken_ > taken_ + 1024; }

 private:
  std::map<std::uint32_t, std::uint32_t> gaps_;  // first place and length; never touching, never at the end
  std::uint32_t size_ = 0;
  std::uint32_t taken_ = 0;
};

}  // namespace stillframe::nodes
