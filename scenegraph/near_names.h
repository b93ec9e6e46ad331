#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stillframe::scenegraph {

/// Names in `known` that somebody who typed `wanted` may have meant: equal but for case, or within two edits, or
/// containing it; the nearest first, at most five. Looks at the first 4096 names only.
[[nodiscard]] std::vector<std::string> nearNames(std::string_view wanted, std::span<const std::string> known);

/// "'a', 'b', 'c'" of the first `limit` names, and how many more there are.
[[nodiscard]] std::string quotedList(std::span<const std::string> names, std::size_t limit = 8);

/// "there is no frame 'mpa'; did you mean 'map'?": `kind` is "frame" or "topic", `known` what there is.
[[nodiscard]] std::string noSuch(std::string_view kind, std::string_view wanted, std::span<const std::string> known);

}  // namespace stillframe::scenegraph
