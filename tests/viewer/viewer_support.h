#pragma once

#include <QImage>
#include <functional>
#include <memory>

#include "scenegraph/store/dataset.h"
#include "tests/support/builders.h"
#include "viewer/window/dataset_loader.h"

namespace stillframe::test {

/// Runs the event loop until `condition` holds; false when it does not within ten seconds.
bool waitFor(const std::function<bool()>& condition);
/// Runs the event loop until nothing is left to do.
void settle();

/// map -> odom -> base_link (moving along X, 1 m/s, 0..10 s at 1 Hz) -> lidar, with a 2 m cloud in "lidar" at 1 s and 2
/// s as topic "/points".
[[nodiscard]] std::shared_ptr<scenegraph::Dataset> makeRobotDataset();

/// Opens what makeRobotDataset() gives for any file but one named "bad.mcap".
[[nodiscard]] viewer::RecordingOpener fakeOpener();

/// Number of pixels of `image` that differ from its first by more than a little.
[[nodiscard]] int drawnPixels(const QImage& image);

}  // namespace stillframe::test
