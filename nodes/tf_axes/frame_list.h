#pragma once

#include <set>
#include <string>
#include <string_view>

namespace stillframe::nodes {

/// Names of frames as the setting `hidden_frames` has them: separated by commas, blanks round a name left out; a comma
/// or backslash in a name has a backslash before it.
using FrameNameSet = std::set<std::string, std::less<>>;
[[nodiscard]] FrameNameSet splitFrameNames(std::string_view list);
[[nodiscard]] std::string joinFrameNames(const FrameNameSet& names);

}  // namespace stillframe::nodes
