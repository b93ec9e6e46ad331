// Foxglove's scans, grids and clouds of a recording, exported and drawn by plain OpenSceneGraph.
#include <algorithm>
#include <filesystem>

#include "tests/nodes/scene_picture.h"
#include "tests/support/plain_viewer.h"
#include "tools/ingest/recording.h"

namespace stillframe::test {
namespace {

constexpr scenegraph::Color kBlack{.r = 0, .g = 0, .b = 0, .a = 1};

class RecordedExport : public ScenePictureTest, public testing::WithParamInterface<const char*> {};

TEST_P(RecordedExport, IsTheSameInAPlainViewer) {
  const std::filesystem::path file =
      std::filesystem::path(STILLFRAME_TEST_DATA) / "mcap_made/foxglove_protobuf_scene.mcap";
  auto recording = ingest::Recording::open(std::span(&file, 1));
  ASSERT_TRUE(recording) << recording.error().message;
  (*recording)->load();
  open((*recording)->dataset(), "");
  scene_->setFixedFrame(std::nullopt);
  const auto& layer = add(GetParam());
  const tf::TimePoint end = dataset_->timeRange()->second;
  scene_->update(end);
  const osg::BoundingBoxd box = layer.boundsInFixed();
  ASSERT_TRUE(box.valid()) << layer.status().message;
  const double radius = box.radius();
  const glm::dvec3 middle{box.center().x(), box.center().y(), box.center().z()};
  const scenegraph::CameraView view{
      .eye_from_fixed = scenegraph::lookAt(middle + radius * glm::dvec3(0.9, -1.1, 1.3), middle, {0, 0, 1})};
  const auto ours = draw(end.ns, view, 320, 240);
  const int drawn = drawnPixels(ours);
  EXPECT_GT(drawn, 300);
  const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root());
  ASSERT_TRUE(back.valid());
  const auto plain = drawPlainly(*back, view, 0.05 * radius, 10.0 * radius, 320, 240, kBlack);
  const auto differs = difference(ours, plain);
  RecordProperty("drawn", drawn);
  RecordProperty("pixels", static_cast<int>(differs.pixels));
  RecordProperty("beyond_one", static_cast<int>(differs.beyond_one));
  // Where two points or the edge of a surface share a pixel, the depth buffers of 24 bits and of floats may differ.
  EXPECT_LE(differs.beyond_one * 100, static_cast<std::size_t>(drawn)) << "of " << drawn << ", " << differs.largest;
  EXPECT_NEAR(drawnPixels(plain), drawn, 3);
}

INSTANTIATE_TEST_SUITE_P(Foxglove, RecordedExport,
                         testing::Values("/scan", "/grid", "/lidar/points", "/lidar/draco", "/lidar/cloudini",
                                         "/depth/image"),
                         [](const auto& instance) {
                           std::string name = instance.param + 1;
                           std::ranges::replace(name, '/', '_');
                           return name;
                         });

}  // namespace
}  // namespace stillframe::test
