#pragma once

#include <expected>
#include <osg/Group>
#include <string>
#include <vector>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/accuracy/accuracy.h"

namespace stillframe::accuracy {

/// A picture of a part of a scene's points, held against the picture of all.
struct PointsAccuracyRow {
  std::string method;         ///< "CPU", "CPU, 16 bit" (positions), "compute", "OpenGL"
  double share = 1.0;         ///< of the points in view that are drawn, in the order of sample_order.h
  double milliseconds = 0.0;  ///< a whole frame, the shortest of several
  double wrong = 0.0;         ///< share of the pixels with points in either picture whose colour is a step off or more
  double holes = 0.0;         ///< share of the pixels with points in the whole picture that have none here
  double rmse = 0.0;          ///< of the sRGB bytes of all pixels, 0 to 255
};

struct PointsAccuracy {
  AccuracyReport report;
  std::vector<PointsAccuracyRow> rows;
};

/// Error against run time of drawing fewer points, and of rounder positions, for the points of `root` as seen from
/// `view` in 1280x720. The reference is every point by OpenGL. `what` names the scene. Takes some seconds.
[[nodiscard]] std::expected<PointsAccuracy, scenegraph::Status> pointsAccuracy(scenegraph::OffscreenRenderer& renderer,
                                                                               osg::Group& root,
                                                                               const scenegraph::CameraView& view,
                                                                               const std::string& what);

}  // namespace stillframe::accuracy
