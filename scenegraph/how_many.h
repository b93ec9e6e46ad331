#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace stillframe::scenegraph {

/// `plural` as it is said of so many: "entities" of two or none, "entity" of one. English words only.
[[nodiscard]] std::string nounOf(std::uint64_t count, std::string_view plural);

/// "1 pose", "200 poses".
[[nodiscard]] std::string howMany(std::uint64_t count, std::string_view plural);

}  // namespace stillframe::scenegraph
