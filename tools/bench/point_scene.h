#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "scenegraph/camera/camera.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::bench {

/// A scene to measure points with, the same whenever it is made.
struct PointSceneShape {
  std::size_t points = 1'000'000;  ///< of all layers together
  bool is_shuffled = false;        ///< else in the order of a scanner that turns once
  int layers = 1;                  ///< topics /points0, /points1, ...
  int messages = 1;                ///< a second apart from 0 s, each with all those points
};

/// Hills, walls and poles about the origin of "map", with an intensity: 16 bytes a point, FLOAT32.
[[nodiscard]] scenegraph::PointCloud makePointCloud(std::size_t points, bool is_shuffled, std::uint32_t seed);
[[nodiscard]] std::shared_ptr<scenegraph::Dataset> makePointDataset(const PointSceneShape& shape);
/// From within, looking around: `step` turns by half a degree each.
[[nodiscard]] scenegraph::CameraView viewOfPoints(int step);
/// From outside, where all of it is seen.
[[nodiscard]] scenegraph::CameraView viewOfAllPoints(int step);
/// From ten times as far.
[[nodiscard]] scenegraph::CameraView viewFromAfar(int step);

}  // namespace stillframe::bench
