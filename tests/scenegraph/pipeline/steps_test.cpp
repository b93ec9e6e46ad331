// Pictures that are drawn in steps: those that are drawn at once, to the bit.
#include "tests/scenegraph/pipeline/output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <osg/MatrixTransform>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/blending.h"
#include "scenegraph/passes/antialiasing.h"
#include "scenegraph/pipeline/drawable_slices.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "tests/scenegraph/pipeline/shader_scene.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

PostChain supersampling(int samples) {
  PostChain chain;
  appendAntialiasing({.mode = "ssaa", .samples = samples}, chain);
  return chain;
}

class PictureSteps : public ::testing::Test {
 protected:
  struct Pixels {
    std::vector<float> colors;
    std::vector<float> depths;
    bool operator==(const Pixels&) const = default;
  };

  void SetUp() override {
    auto context = OffscreenContext::create();
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    output_ = std::make_unique<Output>(kWidth, kHeight);
    pipeline_ = std::make_unique<ViewPipeline>(root_);
    pipeline_->setView({.eye_from_fixed = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0})});
    pipeline_->setBackground({0.1F, 0.1F, 0.2F, 1});
  }
  void TearDown() override {
    pipeline_.reset();
    output_.reset();
    EXPECT_EQ(context_->debugLog().count(), 0U) << ::testing::PrintToString(context_->debugLog().messages());
  }

  /// Panes of one colour each that run through each other.
  void addPanes(int count) {
    for (int i = 0; i < count; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(count);
      const osg::ref_ptr<osg::MatrixTransform> turned =
          new osg::MatrixTransform{osg::Matrixd::rotate(3.1 * share + 0.1, osg::Vec3d(0.2, 1.0, 0.1))};
      turned->addChild(makeQuad(1.5F, 1.2F, 0.1F * share, {share, 1.0F - share, 0.5F, 0.3F}));
      setBlended(*turned->getOrCreateStateSet(), true);
      root_->addChild(turned);
    }
  }

  [[nodiscard]] Pixels read() const { return {pipeline_->readColor(0, kHeight), pipeline_->readDepth(0, kHeight)}; }
  [[nodiscard]] Pixels atOnce() {
    EXPECT_TRUE(pipeline_->render(output_->id(), kWidth, kHeight));
    return read();
  }
  /// Steps that a picture takes, each as short as can be; its pixels are read().
  [[nodiscard]] int inSteps(double budget_ms = 0.0) {
    for (int steps = 1; steps < 10'000; ++steps) {
      const auto drawn = pipeline_->step(output_->id(), kWidth, kHeight, budget_ms);
      if (drawn != PictureStep::More) {
        EXPECT_EQ(drawn, PictureStep::Whole);
        return steps;
      }
    }
    ADD_FAILURE() << "it does not come to an end";
    return 0;
  }

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Output> output_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::unique_ptr<ViewPipeline> pipeline_;
};

TEST_F(PictureSteps, EveryBlendedThingIsAStepOfItsOwn) {
  root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
  const int without = inSteps();
  addPanes(12);
  const Pixels at_once = atOnce();
  EXPECT_EQ(pipeline_->blendedBands(), 1);
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(inSteps(), without + 12 + 1) << "and what lays them over the picture";
    EXPECT_TRUE(read() == at_once) << round;
    EXPECT_EQ(pipeline_->blendedBands(), 1);
    pipeline_->present(output_->id());
  }
  EXPECT_EQ(inSteps(1e6), 1);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, BlendedThingsBeyondTheRoomForThemComeInBandsAsWell) {
  addPanes(12);
  const Pixels at_once = atOnce();
  pipeline_->setBlendLimits({.most_fragments = 1U << 12U});
  EXPECT_GT(inSteps(), 3 * 12);
  EXPECT_TRUE(read() == at_once);
  const int bands = pipeline_->blendedBands();
  EXPECT_GT(bands, 3);
  EXPECT_TRUE(atOnce() == at_once);
  EXPECT_EQ(pipeline_->blendedBands(), bands);
}

TEST_F(PictureSteps, OtherThingsThatAreBlendedMeanwhileEndWithThePicture) {
  addPanes(6);
  const Pixels at_once = atOnce();
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  EXPECT_TRUE(atOnce() == at_once) << "what was begun is left";
  EXPECT_GT(inSteps(), 6);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, EachSubFrameIsDrawnInStepsOfItsOwn) {
  root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
  addPanes(3);
  const int without = inSteps();
  for (const int samples : {4, 8}) {
    const auto chain = supersampling(samples);
    pipeline_->setPostChain(chain);
    const Pixels at_once = atOnce();
    EXPECT_GE(inSteps(), samples * without) << samples;
    EXPECT_TRUE(read() == at_once) << samples;
    pipeline_->present(output_->id());
    EXPECT_GE(inSteps(), samples * without) << samples;
    EXPECT_TRUE(read() == at_once) << samples;
  }
}

TEST_F(PictureSteps, PointsOfSubFramesAreAllThere) {
  std::vector<osg::Vec3> points;
  std::vector<osg::Vec4> colors;
  for (int i = 0; i < 20'000; ++i) {
    const auto at = static_cast<float>(i);
    points.emplace_back(std::sin(at * 0.37F), std::sin(at * 0.73F), std::sin(at * 1.17F));
    colors.emplace_back(0.5F + 0.5F * std::sin(at), 0.5F, 0.2F, 1.0F);
  }
  root_->addChild(makeShape(GL_POINTS, points, colors));
  pipeline_->setPointWay(PointWay::Cpu);
  pipeline_->setPostChain(supersampling(4));
  const Pixels at_once = atOnce();
  EXPECT_GT(inSteps(), 4);
  EXPECT_TRUE(read() == at_once);
}

/// A wavy sheet of so many triangles, with indices or without.
osg::ref_ptr<osg::Geode> makeSheet(unsigned triangles, bool has_indices, const osg::Vec4& color) {
  std::vector<osg::Vec3> corners;
  for (unsigned i = 0; i < triangles; ++i) {
    const float x = static_cast<float>(i % 300) / 150.0F - 1.0F;
    const float y = static_cast<float>(i / 300) / 150.0F - 1.0F;
    const float z = 0.3F * std::sin(9.0F * x) * std::cos(7.0F * y);
    corners.insert(corners.end(), {{x, y, z}, {x + 0.02F, y, z}, {x, y + 0.02F, -z}});
  }
  const osg::ref_ptr<osg::Geode> sheet = makeShape(GL_TRIANGLES, corners, {color});
  if (has_indices) {
    osg::Geometry& geometry = *sheet->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned i = 3 * triangles; i > 0; --i) {
      indices->push_back(i - 1);
    }
    geometry.setPrimitiveSet(0, indices);
  }
  return sheet;
}

TEST_F(PictureSteps, AStepEndsWithinALargeDrawable) {
  constexpr unsigned kTriangles = 70'001;  // three slices
  root_->addChild(makeQuad(1, 1, -0.5F, {1, 0, 0, 1}));
  const int without = inSteps();
  for (const bool has_indices : {false, true}) {
    for (const bool is_blended : {false, true}) {
      const osg::ref_ptr<osg::Geode> sheet = makeSheet(kTriangles, has_indices, {0, 1, 0.4F, 0.5F});
      osg::Geometry& geometry = *sheet->getDrawable(0)->asGeometry();
      const osg::PrimitiveSet* const set = geometry.getPrimitiveSet(0);
      setBlended(*sheet->getOrCreateStateSet(), is_blended);
      root_->addChild(sheet);
      const Pixels at_once = atOnce();
      EXPECT_EQ(inSteps(), without + 3 + (is_blended ? 1 : 0)) << has_indices << is_blended;
      EXPECT_TRUE(read() == at_once) << has_indices << is_blended;
      EXPECT_EQ(geometry.getNumPrimitiveSets(), 1U);
      EXPECT_EQ(geometry.getPrimitiveSet(0), set) << "for picking and export it is what it was";
      root_->removeChild(sheet);
    }
  }
}

/// Triangles of a sheet as so many instances of three of them, each told apart by its number alone.
osg::ref_ptr<osg::Geode> makeCopies(int copies, const std::string& instance, const osg::Vec4& color) {
  const osg::ref_ptr<osg::Geode> geode = makeSheet(3, false, color);
  osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
  geometry.getPrimitiveSet(0)->setNumInstances(copies);
  geometry.getOrCreateStateSet()->setAttributeAndModes(makeProgram("copies", R"(#version 450 compatibility
uniform int u_first_instance;
out vec4 v_color;
void main() {
  int i = )" + instance + R"(;
  float at = float(i);
  v_color = gl_Color * vec4(fract(at * 0.37), fract(at * 0.173), 1.0, 1.0);
  gl_Position = gl_ModelViewProjectionMatrix *
                (gl_Vertex + vec4(float(i % 200) * 0.01, float(i / 200) * 0.01, 0.2 * sin(at), 0.0));
})",
                                                                   kTestFragment));
  return geode;
}

TEST_F(PictureSteps, AStepEndsWithinManyInstances) {
  constexpr int kCopies = 25'000;  // three slices of three triangles each
  root_->addChild(makeQuad(1, 1, -0.5F, {1, 0, 0, 1}));
  const int without = inSteps();
  for (const bool is_blended : {false, true}) {
    const osg::ref_ptr<osg::Geode> copies =
        makeCopies(kCopies, "u_first_instance + gl_InstanceID", {0.5F, 1, 0.4F, 0.5F});
    osg::Geometry& geometry = *copies->getDrawable(0)->asGeometry();
    setBlended(*copies->getOrCreateStateSet(), is_blended);
    root_->addChild(copies);
    const Pixels at_once = atOnce();
    for (int round = 0; round < 2; ++round) {
      EXPECT_EQ(inSteps(), without + 3 + (is_blended ? 1 : 0)) << is_blended;
      EXPECT_TRUE(read() == at_once) << is_blended;
      pipeline_->present(output_->id());
    }
    EXPECT_EQ(geometry.getPrimitiveSet(0)->getNumInstances(), kCopies) << "for picking and export it is what it was";
    EXPECT_EQ(geometry.getDrawCallback(), nullptr);
    EXPECT_TRUE(atOnce() == at_once) << "the number of the first one goes with its slice";
    root_->removeChild(copies);
  }
}

TEST_F(PictureSteps, InstancesThatAShaderCountsForItselfAreDrawnInTheFirstSlice) {
  root_->addChild(makeCopies(25'000, "gl_InstanceID", {0.5F, 1, 0.4F, 1}));
  const Pixels at_once = atOnce();
  EXPECT_GT(inSteps(), 3);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, AMillionInstancesTakeManySlicesAndStripsNone) {
  const osg::ref_ptr<osg::Geode> sheet = makeSheet(70'001, false, {0, 1, 0.4F, 1});
  const osg::ref_ptr<osg::PrimitiveSet> set = sheet->getDrawable(0)->asGeometry()->getPrimitiveSet(0);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 3U);
  set->setNumInstances(1);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 3U);
  set->setNumInstances(5);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 5U) << "a slice is an instance at least";
  set->setNumInstances(0);
  set->setMode(GL_TRIANGLE_STRIP);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 1U);
  const osg::ref_ptr<osg::Geode> copies = makeSheet(6, false, {0, 1, 0.4F, 1});
  copies->getDrawable(0)->asGeometry()->getPrimitiveSet(0)->setNumInstances(1'000'000);
  EXPECT_EQ(sliceCount(*copies->getDrawable(0)), 184U);
}

}  // namespace
}  // namespace stillframe::scenegraph
