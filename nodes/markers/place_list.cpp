#include "nodes/markers/place_list.h"

#include <iterator>

namespace stillframe::nodes {

std::uint32_t PlaceList::take(std::uint32_t count) {
  taken_ += count;
  if (count == 1 && !gaps_.empty()) {
    const auto lowest = gaps_.begin();
    const auto [first, length] = *lowest;
    gaps_.erase(lowest);
    if (length > 1) {
      gaps_.emplace(first + 1, length - 1);
    }
    return first;
  }
  const std::uint32_t first = size_;
  size_ += count;
  return first;
}

void PlaceList::restore(std::uint32_t first, std::uint32_t count) {
  if (first > size_) {
    gaps_.emplace(size_, first - size_);
  }
  size_ = first + count;
  taken_ += count;
}

void PlaceList::free(std::uint32_t first, std::uint32_t count) {
  if (count == 0) {
    return;
  }
  taken_ -= count;
  auto next = gaps_.lower_bound(first);
  if (next != gaps_.end() && next->first == first + count) {
    count += next->second;
    next = gaps_.erase(next);
  }
  if (next != gaps_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == first) {
      first = before->first;
      count += before->second;
      gaps_.erase(before);
    }
  }
  if (first + count == size_) {
    size_ = first;
  } else {
    gaps_.emplace(first, count);
  }
}

}  // namespace stillframe::nodes
