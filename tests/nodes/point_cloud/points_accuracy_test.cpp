#include "tools/accuracy/points_accuracy.h"

#include <random>

#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

class PointsAccuracyTest : public ScenePictureTest {};

TEST_F(PointsAccuracyTest, ErrorsFallAsMoreIsDrawnAndAllOfItIsRight) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-9.0, 9.0);
  CloudBuilder builder("map");
  builder.xyz();
  for (int i = 0; i < 30'000; ++i) {
    builder.point({across(random), across(random), across(random) * 0.1});
  }
  open(DatasetBuilder()
           .topic("/tf", scenegraph::ObjectType::FrameTransforms)
           .transform(0, "map", "lidar", {})
           .topic("/points", scenegraph::ObjectType::PointCloud)
           .at(1_s, builder.build())
           .build(),
       "map");
  add("/points");
  scene_->update(tf::TimePoint{1_s});
  const auto accuracy = accuracy::pointsAccuracy(*renderer_, scene_->root(), fromAbove(), "A test");
  ASSERT_TRUE(accuracy) << accuracy.error().message;
  std::map<std::string, std::vector<accuracy::PointsAccuracyRow>> curves;
  for (const auto& row : accuracy->rows) {
    curves[row.method].push_back(row);
  }
  ASSERT_EQ(curves.size(), 4U);
  for (const auto& [method, curve] : curves) {
    ASSERT_EQ(curve.size(), 10U) << method;
    for (std::size_t i = 1; i < curve.size(); ++i) {
      EXPECT_LT(curve[i].holes, curve[i - 1].holes) << method << " at " << curve[i].share;
      EXPECT_LT(curve[i].rmse, curve[i - 1].rmse) << method << " at " << curve[i].share;
    }
    EXPECT_GT(curve.front().holes, 0.99) << method;
    EXPECT_LT(curve.back().wrong, method == "CPU, 16 bit" ? 0.05 : 0.001) << method;
  }
  EXPECT_EQ(curves["OpenGL"].back().wrong, 0.0) << "the reference itself";
  EXPECT_NE(accuracy->report.table.find("30000 points"), std::string::npos);
  EXPECT_NE(accuracy->report.svg.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace stillframe::test
