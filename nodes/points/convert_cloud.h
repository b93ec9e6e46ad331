#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "nodes/points/cloud_layout.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/raster/point_blocks.h"

namespace stillframe::nodes {

/// Points that lie one point step after the other in the data, all of them kept.
struct PointRun {
  std::size_t offset = 0;  ///< of the first point, in bytes
  std::size_t count = 0;
};

/// The drawable points of a cloud: finite ones, relative to `origin`.
///
/// The positions themselves went to the sink given to convertCloud(). `runs` says which points they are, so that
/// channels and colours can be made later, for the same points and in the same order, without looking at x, y, z again.
struct ConvertedCloud {
  std::size_t points = 0;        ///< positions written
  std::size_t not_finite = 0;    ///< dropped: a NaN or infinite coordinate
  std::size_t out_of_reach = 0;  ///< dropped: finite, but farther than kReach on an axis
  glm::dvec3 origin{0.0};        ///< what was taken off each position: zero, or the box centre on axes beyond kNearby
  glm::dvec3 box_min{0.0};       ///< of the points, in the cloud's own coordinates; meaningful when points > 0
  glm::dvec3 box_max{0.0};
  std::vector<PointRun> runs;
  std::size_t point_step = 0;               ///< bytes
  std::vector<scenegraph::PointBox> boxes;  ///< of the groups of the positions, as boxesOf() finds them

  /// Coordinates beyond this (m) would overflow the float arithmetic of bounds and culling.
  static constexpr float kReach = 1e15F;
  /// Below this (m) a float has 0.06 mm or better, and positions stay as they are.
  static constexpr double kNearby = 1024.0;
};

/// Room for positions: called at most once, with the number of floats the cloud can need (3 a point); the floats are
/// written from its start, x y z x y z. Returning storage of the final consumer saves a copy.
using FloatSink = std::function<float*(std::size_t floats)>;

/// What else is made of each point while its bytes are in the cache: told of the points as their positions are found.
class AlongPositions {
 public:
  AlongPositions() = default;
  AlongPositions(const AlongPositions&) = delete;
  AlongPositions& operator=(const AlongPositions&) = delete;
  virtual ~AlongPositions() = default;

  /// First of all: so many points at most. Not called when there are none.
  virtual void begin(std::size_t points) = 0;
  /// The points of `runs` lie from the `place`-th on, for now. Of several parts at a time, each on a thread.
  virtual void add(std::span<const PointRun> runs, std::size_t place) = 0;
  /// `count` points that have been added, and lie from `from` on, go to `to`, which is before that. One thread.
  virtual void move(std::size_t from, std::size_t count, std::size_t to) = 0;
};

/// Finite points of a cloud as float positions, in one pass over the data. Any thread; no state.
///
/// Every data type (mixed ones too), any stride, both byte orders, row padding, fields in any order or overlapping; of
/// a coordinate with count > 1 the first value. Contiguous little-endian FLOAT32 x, y, z take a vectorised path.
/// Data that is still arriving is converted as it comes, and all of it waited for ("MalformedCloud" when it comes to no
/// good end): at the same time as another thread unpacks it, that costs next to nothing.
/// Coordinates beyond kNearby cost a second pass: they are written relative to the box centre in double, so that UTM
/// coordinates in FLOAT64 keep their millimetres.
[[nodiscard]] std::expected<ConvertedCloud, CloudError> convertCloud(const scenegraph::PointCloud& cloud,
                                                                     const FloatSink& positions,
                                                                     AlongPositions* along = nullptr);

}  // namespace stillframe::nodes
