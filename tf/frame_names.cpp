#include "tf/frame_names.h"

namespace stillframe::tf {

std::optional<FrameId> FrameNames::find(std::string_view name) const noexcept {
  const auto it = ids_.find(name);
  return it == ids_.end() ? std::nullopt : std::optional<FrameId>(it->second);
}

FrameId FrameNames::intern(std::string_view name) {
  if (const auto known = find(name)) {
    return *known;
  }
  const auto frame = static_cast<FrameId>(names_.size());
  ids_.emplace(names_.emplace_back(name), frame);
  return frame;
}

}  // namespace stillframe::tf
