#pragma once

#include <cstdint>
#include <expected>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/pick/pick_hit.h"
#include "scenegraph/pick/pick_result.h"
#include "scenegraph/scene.h"

namespace stillframe::scenegraph {

/// Why nothing was picked.
enum class PickError : std::uint8_t {
  NothingThere,  ///< the pixel and those near it show the background or mere reference, or lie outside of the picture
  Undescribed,   ///< what is drawn there is none of the layers' any more, or has no place
};
[[nodiscard]] const char* toString(PickError error) noexcept;

/// The first of the hits, best first, that a layer of the scene describes. The hits are of the graph as it is now.
[[nodiscard]] std::expected<PickResult, PickError> describeHits(const Scene& scene, std::span<const PickHit> hits);

/// Where what was picked is in another frame, at the scene's time; nullopt when that has no place.
[[nodiscard]] std::optional<glm::dvec3> pointIn(const Scene& scene, const PickResult& result, const std::string& frame);
/// Where it is now in the fixed frame: it goes along with its source frame.
[[nodiscard]] std::optional<glm::dvec3> pointInFixedNow(const Scene& scene, const PickResult& result);

/// All there is to say of it, a name and a text each, with all digits: what it is, its time, its position in its source
/// frame, in the fixed frame and in `display_frame`, its fields. Positions are those of now.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> pickRows(const Scene& scene, const PickResult& result,
                                                                        const std::string& display_frame);
/// "x y z" with all digits.
[[nodiscard]] std::string pointText(const glm::dvec3& point);

/// From one picked point to another, in the fixed frame.
struct Measurement {
  glm::dvec3 delta_in_fixed{0.0};
  double length_m = 0.0;
};
[[nodiscard]] Measurement measure(const glm::dvec3& from_in_fixed, const glm::dvec3& to_in_fixed);

}  // namespace stillframe::scenegraph
