#pragma once

#include <algorithm>
#include <cstdint>

namespace stillframe::nodes {

/// Kinds of layers that lie flat, the foremost first. What is drawn as lines (paths) or points lies before all of them,
/// at step 0, whatever plane they share.
enum class FlatKind : std::uint8_t {
  ReferenceGrid,
  GridMap,        ///< a grid map in its flat mode: a map of some quantity on the ground
  OccupancyGrid,  ///< the ground
};

/// Steps that a flat layer lies behind lines in its plane: u_depth_step of flat_depth.glsl, the one order for all flat
/// layers. Of one kind the layer that stands first in the view's list lies furthest behind: `order` is its place among
/// `of_kind`. The reference grid lies half a step behind; grid maps share the step behind that, however many there are;
/// occupancy grids lie one step each behind it.
[[nodiscard]] inline float flatDepthStep(FlatKind kind, std::uint32_t order, std::uint32_t of_kind) noexcept {
  const auto behind = static_cast<float>(of_kind > order ? of_kind - order : 1);  // 1 for the foremost
  constexpr float kReferenceGrid = 0.5F;
  switch (kind) {
    case FlatKind::ReferenceGrid:
      break;
    case FlatKind::GridMap:
      return kReferenceGrid + behind / static_cast<float>(std::max(of_kind, 1U) + 1);
    case FlatKind::OccupancyGrid:
      return kReferenceGrid + behind;
  }
  return kReferenceGrid;
}

}  // namespace stillframe::nodes
