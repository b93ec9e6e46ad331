#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace stillframe::nodes {

/// States of a sequence of steps, kept wherever a certain amount of work has gone by, so that any state costs a bounded
/// amount of work to come to, back as well as on.
///
/// When they outgrow `max_bytes`, every other one goes and the amount doubles. Not thread-safe.
template <typename State>
class Checkpoints {
 public:
  struct Item {
    std::size_t place = 0;  ///< steps that went in
    State state;
    std::size_t own_bytes = 0;  ///< beyond the one before, with which it may share
  };

  /// Bytes of all but the first, each that several share once.
  using Recount = std::function<std::size_t(std::span<const Item>)>;

  /// The first is the state before any step. Without `recount`, what is thinned out takes all its own bytes along.
  Checkpoints(State start, std::size_t max_bytes, std::size_t work_step, Recount recount = {})
      : max_bytes_(max_bytes), work_step_(work_step), recount_(std::move(recount)) {
    items_.push_back({0, std::move(start), 0});
  }

  /// The newest at or before `place`. Valid until the next call that is not const.
  [[nodiscard]] const Item& before(std::size_t place) const {
    return *std::prev(std::ranges::upper_bound(items_, place, {}, &Item::place));
  }
  /// Whether so much work since the last one is worth another.
  [[nodiscard]] bool isDue(std::size_t work) const noexcept { return work >= work_step_; }
  void keep(std::size_t place, State state, std::size_t own_bytes) {
    const auto after = std::ranges::upper_bound(items_, place, {}, &Item::place);
    items_.insert(after, Item{place, std::move(state), own_bytes});
    bytes_ += own_bytes;
    while (bytes_ > max_bytes_ && items_.size() > 1) {
      thin();
    }
  }
  /// Drops those of more steps than `place`.
  void forgetAfter(std::size_t place) {
    while (items_.back().place > place) {
      bytes_ -= items_.back().own_bytes;
      items_.pop_back();
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }
  /// Beyond the first.
  [[nodiscard]] std::size_t byteSize() const noexcept { return bytes_; }

 private:
  void thin() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (i % 2 == 0) {
        if (kept != i) {
          items_[kept] = std::move(items_[i]);
        }
        ++kept;
      }
    }
    items_.resize(kept);
    work_step_ *= 2;
    bytes_ = 0;
    if (recount_) {
      bytes_ = recount_(items_);
    } else {
      for (const Item& item : items_) {
        bytes_ += item.own_bytes;
      }
    }
  }

  std::size_t max_bytes_;
  std::size_t work_step_;
  Recount recount_;
  std::size_t bytes_ = 0;
  std::vector<Item> items_;  // ascending
};

}  // namespace stillframe::nodes
