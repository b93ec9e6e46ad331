#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "tf/errors.h"

namespace stillframe::tf {

/// Frame names interned to dense ids in order of first appearance. find() does not allocate. Names come stripped of
/// leading slashes. Not thread-safe: TransformBuffer holds the lock.
class FrameNames {
 public:
  [[nodiscard]] std::optional<FrameId> find(std::string_view name) const noexcept;
  /// The id of `name`, new if need be.
  FrameId intern(std::string_view name);
  /// The name of a valid id.
  [[nodiscard]] const std::string& name(FrameId frame) const noexcept { return names_[frame]; }
  [[nodiscard]] std::size_t size() const noexcept { return names_.size(); }

 private:
  std::deque<std::string> names_;                      // index = FrameId; a deque never moves its strings
  std::unordered_map<std::string_view, FrameId> ids_;  // keys view names_
};

}  // namespace stillframe::tf
