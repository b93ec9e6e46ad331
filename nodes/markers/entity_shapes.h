#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nodes/markers/few_of.h"
#include "nodes/primitives/instance.h"
#include "scenegraph/objects/scene_entities.h"

namespace stillframe::nodes {

/// Beyond, a place is nonsense and a cell has no number: the sun is 1.5e11 m away.
inline constexpr double kReach_m = 1e12;

/// What is drawn as copies of one mesh. An arrow is two frustums, a set of axes three.
enum class ShapeKind : std::uint8_t {
  Box,
  Sphere,
  Frustum,
  Square,  ///< faces the viewer, unlit
};

/// Shapes that share a draw call, within one frame.
///
/// Matrices are floats relative to the middle of a cell of the frame, kCell_m wide: 0.1 mm is the largest error.
struct ShapeBatchKey {
  static constexpr double kCell_m = 4096.0;

  ShapeKind kind = ShapeKind::Box;
  bool is_blended = false;
  std::array<std::int32_t, 3> cell{};

  [[nodiscard]] glm::dvec3 origin() const { return kCell_m * glm::dvec3(cell[0], cell[1], cell[2]); }
  friend auto operator<=>(const ShapeBatchKey&, const ShapeBatchKey&) = default;
};

/// The part of an entity that is in one batch.
struct ShapeRun {
  ShapeBatchKey key;
  std::uint32_t first = 0;  ///< place in the batch, given by SceneHistory
  FewOf<Instance> instances;
};

/// A primitive as its message has it, for people; instances of it have its place in EntityShapes::sources as their id.
struct PrimitiveSource {
  enum class Kind : std::uint8_t { Arrow, Cube, Sphere, Cylinder, Points, Axes };
  Kind kind = Kind::Cube;
  tf::RigidTransform pose;
  std::array<double, 5> sizes{};  ///< what they mean is said by sizeNames()
};
[[nodiscard]] const char* toString(PrimitiveSource::Kind kind) noexcept;
/// Names of the sizes that a kind has, as the messages call them.
[[nodiscard]] std::span<const char* const> sizeNames(PrimitiveSource::Kind kind) noexcept;

struct EntityShapes {
  FewOf<ShapeRun> runs;
  FewOf<PrimitiveSource> sources;
  std::uint32_t unsound = 0;    ///< primitives whose numbers are not finite or beyond all reach: not drawn
  std::uint32_t flat = 0;       ///< drawn with a size of 0 along an axis
  std::uint32_t invisible = 0;  ///< of alpha 0: not drawn
};

/// Arrows, cubes, spheres, cylinders, points and axes of an entity. `use_cells` false: all in the cell about the
/// frame's origin, at a float's precision. Any thread.
[[nodiscard]] EntityShapes shapesOf(const scenegraph::SceneEntity& entity, bool use_cells = true);

/// The pose with its rotation normalised; all zero stands for none, as RViz reads it.
[[nodiscard]] tf::RigidTransform soundPose(const tf::RigidTransform& pose);

}  // namespace stillframe::nodes
