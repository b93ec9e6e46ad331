// Points that a thread of their own draws while a picture is drawn in steps: the picture is the same, and whoever needs
// what they do meanwhile waits for them.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <semaphore>
#include <thread>

#include "scenegraph/pipeline/gl_output.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;
using scenegraph::PictureStep;

constexpr int kWidth = 96;
constexpr int kHeight = 64;

/// A wall of points 10 m ahead of x.
scenegraph::PointCloud wall(int columns, int rows) {
  CloudBuilder builder("lidar");
  builder.xyz();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      builder.point({10.0, 8.0 * column / columns - 4.0, 6.0 * row / rows - 3.0});
    }
  }
  return builder.build();
}

class PointsAside : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "lidar", {})
             .topic("/points", ObjectType::PointCloud)
             .at(1_s, wall(400, 300))
             .at(2_s, wall(40, 30))
             .build(),
         "map");
    add("/points", {{"color_field", "y"}});
    scene_->update(tf::TimePoint{1_s});
    auto context = scenegraph::OffscreenContext::create();
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    output_ = std::make_unique<scenegraph::gl::Output>(kWidth, kHeight);
    pipeline_ = std::make_unique<scenegraph::ViewPipeline>(osg::ref_ptr<osg::Group>(&scene_->root()));
    pipeline_->setPointWay(scenegraph::PointWay::Cpu);
    look(0.0);
    pipeline_->setWake([this] { woken_.release(); });
  }
  void TearDown() override {
    context_->makeCurrent();
    pipeline_.reset();
    output_.reset();
    context_.reset();
    ScenePictureTest::TearDown();
  }

  void look(double eye_x) {
    pipeline_->setView({.eye_from_fixed = scenegraph::lookAt({eye_x, 0, 0}, {10, 0, 0}, {0, 0, 1})});
  }
  /// To the end, or to where it waits; what is new to OpenGL has steps of its own.
  PictureStep step(int width_px = kWidth) {
    for (int steps = 0; steps < 10'000; ++steps) {
      const auto done = pipeline_->step(output_->id(), width_px, kHeight, 1e6);
      EXPECT_TRUE(done) << done.error().message;
      if (done == PictureStep::Busy) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      } else if (done != PictureStep::More) {
        return done.value_or(PictureStep::More);
      }
    }
    return PictureStep::More;
  }
  [[nodiscard]] std::vector<float> pixels() const { return pipeline_->readColor(0, kHeight); }
  std::vector<float> atOnce() {
    const auto drawn = pipeline_->renderLinear(kWidth, kHeight);
    EXPECT_TRUE(drawn) << drawn.error().message;
    return pixels();
  }
  /// Steps to the whole picture, and how often they waited.
  std::pair<std::vector<float>, int> aside() {
    int waits = 0;
    auto done = step();
    for (; done == PictureStep::Waits; done = step()) {
      ++waits;
      woken_.acquire();
    }
    EXPECT_EQ(done, PictureStep::Whole);
    auto picture = pixels();
    pipeline_->present(output_->id());
    return {std::move(picture), waits};
  }

  std::counting_semaphore<> woken_{0};
  std::unique_ptr<scenegraph::OffscreenContext> context_;
  std::unique_ptr<scenegraph::gl::Output> output_;
  std::unique_ptr<scenegraph::ViewPipeline> pipeline_;
};

TEST_F(PointsAside, AreThePictureThatIsDrawnAtOnce) {
  const auto at_once = atOnce();
  look(1.0);
  const auto nearer = atOnce();
  ASSERT_NE(nearer, at_once);
  for (int round = 0; round < 3; ++round) {
    look(round % 2 == 0 ? 0.0 : 1.0);
    const auto [picture, waits] = aside();
    EXPECT_TRUE(picture == (round % 2 == 0 ? at_once : nearer)) << round;
    EXPECT_EQ(waits, 1) << "once woken it goes on to the end";
    ASSERT_TRUE(pipeline_->pointProgress());
    EXPECT_EQ(pipeline_->pointProgress()->share, 1.0);
  }
}

TEST_F(PointsAside, BecomeMoreWithEachPictureWhereTimeIsShort) {
  const auto at_once = atOnce();
  pipeline_->setPointLimits({.budget_ms = 0.01});
  look(1.0);
  (void)atOnce();
  look(0.0);
  int pictures = 1;
  auto picture = aside().first;
  EXPECT_LT(pipeline_->pointProgress()->share, 1.0);
  for (; pipeline_->pointProgress()->share < 1.0 && pictures < 200; ++pictures) {
    picture = aside().first;
  }
  EXPECT_GT(pictures, 3);
  EXPECT_TRUE(picture == at_once);
}

TEST_F(PointsAside, AreWaitedForByWhoeverDrawsOrPicksMeanwhile) {
  const auto at_once = atOnce();
  for (int round = 0; round < 20; ++round) {
    look(1.0);
    ASSERT_EQ(step(), PictureStep::Waits);
    look(0.0);
    EXPECT_TRUE(atOnce() == at_once) << round;
    look(1.0);
    ASSERT_EQ(step(), PictureStep::Waits);
    EXPECT_FALSE(pipeline_->pick(kWidth / 2, kHeight / 2).empty());
    EXPECT_EQ(step(), PictureStep::Whole) << "they are there";
    pipeline_->present(output_->id());
  }
}

TEST_F(PointsAside, AreLeftForAPictureOfAnotherSize) {
  const auto at_once = atOnce();
  look(1.0);
  ASSERT_EQ(step(), PictureStep::Waits);
  look(0.0);
  (void)step(kWidth / 2);
  EXPECT_TRUE(aside().first == at_once);
}

TEST_F(PointsAside, EndBeforeTheirCloudIsGoneWithItsSceneOrItsContext) {
  for (int round = 0; round < 10; ++round) {
    look(0.1 * round);
    ASSERT_EQ(step(), PictureStep::Waits);
    if (round % 2 == 0) {
      pipeline_->releaseGl();
    } else {
      scene_->update(tf::TimePoint{round % 4 == 1 ? 2_s : 1_s});
      EXPECT_EQ(scene_->layers().size(), 1U);
    }
  }
  ASSERT_EQ(step(), PictureStep::Waits);
  pipeline_.reset();
}

TEST_F(PointsAside, AreNobodysBusinessWhereThereAreNone) {
  scene_->layers().front()->layer->setVisible(false);
  scene_->update(tf::TimePoint{1_s});
  EXPECT_EQ(step(), PictureStep::Whole);
  EXPECT_FALSE(woken_.try_acquire());
}

}  // namespace
}  // namespace stillframe::test
