// Several views of one dataset: what is decoded and converted is there once.
#include <gtest/gtest.h>
#include <malloc.h>

#include <memory>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/scene.h"
#include "tests/support/builders.h"

namespace stillframe::nodes {
namespace {

using namespace tf::literals;
using tf::TimePoint;

constexpr int kPoints = 400'000;
constexpr std::size_t kPointBytes = 12;

/// map -> odom -> lidar, with a large cloud at 1 s and at 2 s.
test::DatasetBuilder largeClouds() {
  test::DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms)
      .transform(0, "map", "odom", test::translate(1, 0, 0))
      .transform(0, "odom", "lidar", test::translate(0, 1, 0));
  builder.topic("/points", scenegraph::ObjectType::PointCloud);
  for (const std::int64_t stamp : {1_s, 2_s}) {
    scenegraph::PointCloud cloud = test::CloudBuilder("lidar").xyz().point({1, 2, 3}).build();
    const auto bytes = std::make_shared<std::vector<std::byte>>(kPoints * kPointBytes);
    cloud.width = kPoints;
    cloud.row_step = kPoints * cloud.point_step;
    cloud.data = {*bytes, bytes};
    builder.at(stamp, cloud);
  }
  return builder;
}

class SharedViews : public testing::Test {
 protected:
  scenegraph::Scene& addView(const char* fixed_frame) {
    views_.push_back(std::make_unique<scenegraph::Scene>(dataset_, layerTypes(), *executor_));
    views_.back()->addDefaultLayers();
    views_.back()->setFixedFrame(fixed_frame);
    return *views_.back();
  }
  void show(TimePoint time) {
    for (const auto& view : views_) {
      do {
        view->update(time);
      } while (view->isPending());
    }
  }
  static std::size_t heapBytes() {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
  }

  test::DatasetBuilder builder_ = largeClouds();
  std::shared_ptr<scenegraph::Dataset> dataset_ = builder_.build();
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  std::vector<std::unique_ptr<scenegraph::Scene>> views_;
};

TEST_F(SharedViews, FourViewsDecodeOnce) {
  addView("map");
  show(TimePoint{1_s});
  show(TimePoint{2_s});
  const std::size_t decoded = builder_.source().decodeCount();
  const std::size_t cached = dataset_->cache().bytes();
  for (const char* const frame : {"odom", "lidar", "map"}) {
    addView(frame);
  }
  show(TimePoint{1_s});
  show(TimePoint{2_s});
  EXPECT_EQ(builder_.source().decodeCount(), decoded);
  EXPECT_EQ(dataset_->cache().bytes(), cached);
  for (const auto& view : views_) {
    EXPECT_EQ(view->findLayer("/points")->layer->counts().front().second, kPoints);
  }
}

TEST_F(SharedViews, FourViewsThatStartTogetherDecodeOnce) {
  addView("map");
  show(TimePoint{2_s});
  const std::size_t of_one = builder_.source().decodeCount();
  test::DatasetBuilder others = largeClouds();
  dataset_ = others.build();
  const std::size_t of_transforms = others.source().decodeCount();
  views_.clear();
  for (const char* const frame : {"odom", "lidar", "map", "odom"}) {
    addView(frame);
  }
  show(TimePoint{2_s});
  EXPECT_EQ(others.source().decodeCount() - of_transforms, of_one - of_transforms);
}

TEST_F(SharedViews, MemoryOfTheDataDoesNotGrowWithViews) {
  addView("map");
  show(TimePoint{2_s});
  const std::size_t before = heapBytes();
  for (const char* const frame : {"odom", "lidar", "map"}) {
    addView(frame);
  }
  show(TimePoint{2_s});
  EXPECT_LT(heapBytes() - before, kPoints * kPointBytes / 4) << "three more views; one copy would be four times that";
}

}  // namespace
}  // namespace stillframe::nodes
