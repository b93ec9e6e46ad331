// Clouds that have let go of their message, and colours that are made on a worker.
#include <deque>
#include <osg/Geometry>
#include <thread>

#include "nodes/point_cloud/describe_point.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using nodes::CloudPoints;
using scenegraph::ObjectType;
using scenegraph::PointCloud;

constexpr int kPoints = 120'000;  // more bytes than CloudPoints::kSmallBytes, and more than are coloured at once

PointCloud largeCloud() {
  PointCloud cloud;
  cloud.frame_id = "map";
  cloud.width = kPoints;
  cloud.point_step = 20;
  cloud.row_step = kPoints * cloud.point_step;
  using scenegraph::FieldType;
  cloud.fields = {{"x", 0, FieldType::Float32},
                  {"y", 4, FieldType::Float32},
                  {"z", 8, FieldType::Float32},
                  {"intensity", 12, FieldType::Float32},
                  {"ring", 16, FieldType::Float32}};
  auto bytes = std::make_shared<std::vector<std::byte>>(cloud.row_step);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const auto number = static_cast<float>(i);
    const std::array<float, 5> point{0.001F * number, 0.0F, 1.0F, number, number / 2.0F};
    std::memcpy(bytes->data() + i * cloud.point_step, point.data(), sizeof point);
  }
  cloud.data = {*bytes, bytes};
  return cloud;
}

/// A cloud and how often its message was read again.
struct Settled {
  explicit Settled(bool is_there = true) {
    points.settle([this, is_there]() -> std::shared_ptr<const PointCloud> {
      ++reads;
      return is_there ? std::make_shared<const PointCloud>(largeCloud()) : nullptr;
    });
  }
  mutable int reads = 0;
  CloudPoints points = *CloudPoints::make(std::make_shared<const PointCloud>(largeCloud()));
};

TEST(SettledCloud, KeepsWhatItDrawsAndNotTheMessage) {
  const Settled settled;
  EXPECT_TRUE(settled.points.source().data.bytes.empty());
  EXPECT_EQ(settled.points.source().frame_id, "map");
  EXPECT_EQ(settled.points.messageBytes(), std::size_t{kPoints} * 20);
  (void)settled.points.axisPercentiles(0, 1, 99);
  EXPECT_EQ(settled.reads, 0);
  EXPECT_LT(settled.points.byteSize(), 1.05 * kPoints * 12);
}

TEST(SettledCloud, HasTheWantedChannelWithoutReadingAgain) {
  const auto wantsRing = [](const CloudPoints& cloud) {
    EXPECT_EQ(cloud.converted().points, 0U);  // asked before they are there
    return std::optional<std::string>("ring");
  };
  auto points = *CloudPoints::make(std::make_shared<const PointCloud>(largeCloud()), {}, wantsRing);
  EXPECT_GT(points.byteSize(), kPoints * (20 + 12 + 4));
  points.settle([] { return nullptr; });
  const nodes::CloudChannel* const ring = points.channel("ring");
  ASSERT_NE(ring, nullptr);
  ASSERT_EQ(ring->values->size(), kPoints);
  EXPECT_EQ((*ring->values)[kPoints - 1], (kPoints - 1) / 2.0F);
  EXPECT_EQ(ring->limits.high, (kPoints - 1) / 2.0);
}

TEST(SettledCloud, ReadsTheMessageAgainForAnotherField) {
  const Settled settled;
  const nodes::CloudChannel* const ring = settled.points.channel("ring");
  ASSERT_NE(ring, nullptr);
  EXPECT_EQ((*ring->values)[kPoints - 1], (kPoints - 1) / 2.0F);
  EXPECT_EQ(ring->limits.high, (kPoints - 1) / 2.0);
  (void)settled.points.channel("ring");
  EXPECT_EQ(settled.reads, 1);
}

TEST(SettledCloud, HoldsTheMessageWhileSomebodyPicks) {
  const Settled settled;
  const auto whole = CloudPoints::make(std::make_shared<const PointCloud>(largeCloud()));
  const auto picked = nodes::describePoint(settled.points, 5);
  const auto expected = nodes::describePoint(*whole, 5);
  ASSERT_TRUE(picked && expected);
  EXPECT_EQ(picked->fields, expected->fields);
  EXPECT_EQ(picked->point_in_frame, expected->point_in_frame);
  (void)nodes::describePoint(settled.points, 6);
  EXPECT_EQ(settled.reads, 1);
  settled.points.releaseGlObjects();
  (void)nodes::describePoint(settled.points, 6);
  EXPECT_EQ(settled.reads, 2);
}

TEST(SettledCloud, HasNothingMissingButWhatCannotBeReadAnyMore) {
  const Settled settled(false);
  EXPECT_FALSE(nodes::describePoint(settled.points, 5));
  const nodes::CloudChannel* const ring = settled.points.channel("ring");
  ASSERT_NE(ring, nullptr);
  EXPECT_EQ(ring->limits.finite, 0U);
  EXPECT_EQ((*ring->values)[7], nodes::kMissingValue);
  EXPECT_EQ(settled.points.converted().points, std::size_t{kPoints});
}

/// Runs jobs only when told to, each on a thread of its own.
class ManualExecutor final : public scenegraph::Executor {
 public:
  void submit(std::function<void()> job) override { jobs_.push_back(std::move(job)); }
  void submitSpare(std::function<void()> /*job*/) override {}
  void drain() override {
    for (; !jobs_.empty(); jobs_.pop_front()) {
      std::thread(jobs_.front()).join();
    }
  }

 private:
  std::deque<std::function<void()>> jobs_;
};

class ColorsOfClouds : public testing::Test {
 protected:
  ColorsOfClouds() {
    builder_.topic("/points", ObjectType::PointCloud).at(0, largeCloud());
    scene_.emplace(builder_.build(), nodes::layerTypes(), later_);
    scene_->setFixedFrame("map");
    layer_ = (*scene_->addLayer("/points"))->layer.get();
    settle();
  }
  void settle() {
    do {
      scene_->update({0});
      later_.drain();
    } while (scene_->isPending());
  }
  [[nodiscard]] double legendTop() const { return layer_->legend() ? layer_->legend()->high : -1.0; }

  DatasetBuilder builder_;
  ManualExecutor later_;
  std::optional<scenegraph::Scene> scene_;
  scenegraph::Layer* layer_ = nullptr;
};

TEST_F(ColorsOfClouds, StayUntilThoseOfAnotherFieldAreMade) {
  EXPECT_EQ(legendTop(), kPoints - 1.0);
  ASSERT_TRUE(layer_->applySettings({{"color_field", "ring"}}));
  scene_->update({0});
  EXPECT_TRUE(scene_->isPending());
  EXPECT_EQ(legendTop(), kPoints - 1.0);
  settle();
  EXPECT_EQ(legendTop(), (kPoints - 1) / 2.0);
  ASSERT_TRUE(layer_->applySettings({{"color_field", "intensity"}}));
  scene_->update({0});
  EXPECT_FALSE(scene_->isPending()) << "they were made before";
  EXPECT_EQ(legendTop(), kPoints - 1.0);
}

TEST_F(ColorsOfClouds, StayUntilTheirPercentilesAreKnown) {
  ASSERT_TRUE(layer_->applySettings({{"range_mode", "percentile"}, {"percentile_high", "50"}}));
  scene_->update({0});
  EXPECT_TRUE(scene_->isPending());
  EXPECT_EQ(legendTop(), kPoints - 1.0);
  settle();
  EXPECT_NEAR(legendTop(), kPoints / 2.0, 1.0);
}

TEST_F(ColorsOfClouds, ChangeOfMindsEndsAtTheLastOne) {
  ASSERT_TRUE(layer_->applySettings({{"color_field", "ring"}}));
  scene_->update({0});
  ASSERT_TRUE(layer_->applySettings({{"color_field", "intensity"}}));
  scene_->update({0});
  settle();
  EXPECT_EQ(legendTop(), kPoints - 1.0);
}

}  // namespace
}  // namespace stillframe::test
