#include "tests/viewer/viewer_support.h"

#include <QApplication>
#include <QTest>
#include <algorithm>
#include <cstdlib>

#include "viewer/widget/scene_widget.h"

namespace stillframe::test {

using scenegraph::FieldType;
using scenegraph::ObjectType;

bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, 10'000); }

namespace {

void runEvents() {
  for (int i = 0; i < 20; ++i) {
    QCoreApplication::sendPostedEvents();
    QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
  }
}

bool hasFrameUnderWay() {
  return std::ranges::any_of(QApplication::allWidgets(), [](const QWidget* widget) {
    const auto* const view = qobject_cast<const viewer::SceneWidget*>(widget);
    return view != nullptr && view->isVisible() && !view->isUpToDate();
  });
}

}  // namespace

void settle() {
  constexpr int kLongestMs = 1000;  // a view whose window is covered draws nothing
  constexpr int kMostFrames = 5;    // the end of one may ask for the tick of another
  runEvents();
  for (int frames = 0; frames < kMostFrames && hasFrameUnderWay(); ++frames) {
    if (!QTest::qWaitFor([] { return !hasFrameUnderWay(); }, kLongestMs)) {
      return;
    }
    runEvents();
  }
}

std::shared_ptr<scenegraph::Dataset> makeRobotDataset() {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms);
  for (std::int64_t second = 0; second <= 10; ++second) {
    builder.transform(second * 1_s, "map", "odom");
    builder.transform(second * 1_s, "odom", "base_link", translate(static_cast<double>(second), 0.0, 0.0));
    builder.transform(second * 1_s, "base_link", "lidar", translate(0.0, 0.0, 1.0));
  }
  builder.topic("/points", ObjectType::PointCloud);
  for (const std::int64_t second : {1, 2}) {
    CloudBuilder cloud("lidar");
    cloud.xyz();
    for (int i = 0; i < 41 * 41; ++i) {
      const int row = i / 41;
      cloud.point({i % 41 * 0.05 - 1.0, row * 0.05 - 1.0, 0.0});
    }
    builder.at(second * 1_s, cloud.stamp(second * 1_s).build());
  }
  return builder.build();
}

viewer::RecordingOpener fakeOpener() {
  return [](const std::vector<std::filesystem::path>& files)
             -> std::expected<viewer::OpenedRecording, scenegraph::Status> {
    if (files.at(0).filename() == "bad.mcap") {
      return std::unexpected(
          scenegraph::Status{scenegraph::StatusLevel::Error, "NotMcap", "bad.mcap is no MCAP recording"});
    }
    return viewer::OpenedRecording{makeRobotDataset(), [](const std::function<bool(double)>& progress) {
                                     for (int i = 0; i <= 10; ++i) {
                                       if (!progress(i / 10.0)) {
                                         return;
                                       }
                                     }
                                   }};
  };
}

int drawnPixels(const QImage& image) {
  const QRgb first = image.pixel(0, 0);
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QRgb pixel = image.pixel(x, y);
      count += std::abs(qRed(pixel) - qRed(first)) + std::abs(qGreen(pixel) - qGreen(first)) +
                           std::abs(qBlue(pixel) - qBlue(first)) >
                       12
                   ? 1
                   : 0;
    }
  }
  return count;
}

}  // namespace stillframe::test
