#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace stillframe::nodes {

/// A name that wants a place in the picture.
struct LabelWish {
  glm::dvec2 anchor_px{0.0, 0.0};  ///< lower left corner, y down
  glm::dvec2 size_px{0.0, 0.0};
  double depth_m = 0.0;  ///< nearer ones are placed first
  bool is_in_picture = false;
};

/// What becomes of it.
struct LabelPlace {
  bool is_shown = false;
  /// Others that start at the same place, to be written below it, by their index; empty when it is not shown.
  std::vector<std::size_t> also;
};

/// Places names so that none covers another: those anchored within `same_px` of each other become one, of several lines
/// but no more than `most_lines`; of the rest the nearest to the eye are shown. O(n log n + n * shown).
[[nodiscard]] std::vector<LabelPlace> placeLabels(std::span<const LabelWish> wishes, double same_px,
                                                  std::size_t most_lines);

}  // namespace stillframe::nodes
