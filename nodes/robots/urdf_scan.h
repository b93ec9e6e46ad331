#pragma once

#include <cstddef>
#include <expected>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "scenegraph/status.h"

namespace stillframe::nodes {

/// The text of a robot as it may be given to urdfdom, whose XML reader recurses, loops on broken UTF-8 and knows no
/// capsules.
struct ScannedUrdf {
  std::string text;  ///< well-formed UTF-8, capsules written as cylinders
  /// Capsules: link, whether visual (else collision), which of those of the link.
  std::set<std::tuple<std::string, bool, std::size_t>> capsules;
};

/// Bounds of what is read.
inline constexpr std::size_t kMaxUrdfBytes = std::size_t{16} << 20U;
inline constexpr std::size_t kMaxUrdfElements = 1'000'000;
inline constexpr std::size_t kMaxUrdfDepth = 100;
inline constexpr std::size_t kMaxRobotLinks = 10'000;

/// Looks over the text in one pass, without recursion, and refuses what is no robot that can be drawn: "UrdfTooLarge",
/// "UrdfEntities" (declares entities), "XacroUnexpanded", "SdfUnsupported", "MjcfUnsupported", "NotUrdf",
/// "UrdfMalformed", and trees that are none: "UrdfLoop", "UrdfTwoParents", "UrdfTwoRoots", "UrdfNoRoot" (no links),
/// "UrdfUnknownLink". Each says which links.
[[nodiscard]] std::expected<ScannedUrdf, scenegraph::Status> scanUrdf(std::string_view text);

}  // namespace stillframe::nodes
