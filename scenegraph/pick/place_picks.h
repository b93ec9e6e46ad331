#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/camera/picking.h"
#include "scenegraph/pick/scene_pick.h"

namespace stillframe::scenegraph {

/// Where a picture shows what is picked and measured, in its pixels: what a window and a file draw alike.
struct PlacedPicks {
  struct Line {
    glm::dvec2 from_px{0.0, 0.0};
    glm::dvec2 to_px{0.0, 0.0};
    std::string text;  ///< its length

    friend bool operator==(const Line&, const Line&) = default;
  };
  std::optional<glm::dvec2> ring_px;  ///< middle of the ring round the selected point
  std::vector<Line> lines;

  [[nodiscard]] bool isEmpty() const noexcept { return !ring_px && lines.empty(); }
  friend bool operator==(const PlacedPicks&, const PlacedPicks&) = default;
};

/// What has no place now, or is not seen, is left out; what is picked goes along with its source frame.
[[nodiscard]] PlacedPicks placePicks(const Scene& scene, const CameraView& view, const PictureSize& size,
                                     const PickMarks& picks);

/// Upper left corner of a line's text of `text_px` pixels: above the middle of the line, moved so that all of it lies
/// in the picture, as far as it has room. nullopt where that middle is not in the picture.
[[nodiscard]] std::optional<glm::dvec2> textCorner(const PlacedPicks::Line& line, const glm::dvec2& text_px,
                                                   const PictureSize& size);

/// In the fixed frame, as its frames are now; nullopt when one of them has no place.
[[nodiscard]] std::optional<Measurement> measureNow(const Scene& scene, const PickMarks::Pair& pair);

/// "3.21 m  (dx 1.2, dy -0.5, dz 2.9)".
[[nodiscard]] std::string measurementText(const Measurement& measurement);

/// Source frames of what is picked and measured, each once, in order.
[[nodiscard]] std::vector<std::string> framesOf(const PickMarks& picks);

}  // namespace stillframe::scenegraph
