// Before OSG's headers, which bring the same ones without prototypes.
#include "tests/scenegraph/pipeline/live_objects.h"
#include "tests/scenegraph/pipeline/output.h"

#include "scenegraph/pipeline/view_pipeline.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/blending.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "tests/scenegraph/pipeline/shader_scene.h"

namespace stillframe::scenegraph {
namespace {

using Names = std::vector<std::string>;
using Rgb = Output::Rgb;

/// A pass that writes an expression of `scene`, the colour it reads.
PostPass makePass(const std::string& name, const std::string& input, const std::string& expression) {
  return {name,
          "#version 450 compatibility\nuniform sampler2D u_image;\nvoid main() {\n"
          "  vec3 scene = texelFetch(u_image, ivec2(gl_FragCoord.xy), 0).rgb;\n  gl_FragColor = vec4(" +
              expression + ", 1.0);\n}\n",
          {{"u_image", input}},
          nullptr};
}

class ViewPipelineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = OffscreenContext::create();
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    pipeline_ = std::make_unique<ViewPipeline>(root_);
    pipeline_->setView({.eye_from_fixed = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0})});
    pipeline_->setBackground({0, 0, 0, 1});
  }
  void TearDown() override {
    pipeline_.reset();
    EXPECT_EQ(context_->debugLog().count(), 0U) << ::testing::PrintToString(context_->debugLog().messages());
  }
  void present(const Output& output) {
    const auto drawn = pipeline_->render(output.id(), output.width(), output.height());
    EXPECT_TRUE(drawn) << drawn.error().message;
  }

  std::unique_ptr<OffscreenContext> context_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::unique_ptr<ViewPipeline> pipeline_;
};

TEST_F(ViewPipelineTest, PresentsEverySrgbByteExactly) {
  const Output output{256, 4};
  std::vector<osg::Vec3> vertices;
  std::vector<osg::Vec4> colors;
  for (int value = 0; value < 256; ++value) {
    const float shade = static_cast<float>(value) / 255.0F;
    vertices.emplace_back(static_cast<float>(value) - 127.5F, 0.0F, 0.0F);
    colors.emplace_back(shade, 1.0F - shade, shade, 1.0F);
  }
  root_->addChild(makeShape(GL_POINTS, vertices, colors));
  root_->getOrCreateStateSet()->setMode(GL_VERTEX_PROGRAM_POINT_SIZE,
                                        osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  pipeline_->setView({.eye_from_fixed = lookAt({0, 0.5, 3}, {0, 0.5, 0}, {0, 1, 0}),
                      .is_orthographic = true,
                      .vertical_extent_m = 4.0});
  present(output);
  for (int value = 0; value < 256; ++value) {
    EXPECT_EQ(output.pixel(value, 1), (Rgb{value, 255 - value, value}));
  }
}

TEST_F(ViewPipelineTest, RunsNothingThatNoOneAskedFor) {
  const Output output{16, 16};
  ASSERT_TRUE(pipeline_->renderLinear(16, 16));
  EXPECT_EQ(pipeline_->passes(), Names{"scene"});
  present(output);
  EXPECT_EQ(pipeline_->passes(), (Names{"scene", "present"}));
  ASSERT_TRUE(pipeline_->renderLinear(16, 16));
  EXPECT_EQ(pipeline_->passes(), Names{"scene"});
}

TEST_F(ViewPipelineTest, DrawsIntoWhicheverFramebufferItIsHanded) {
  root_->addChild(makeQuad(5, 5, 0, {1, 0, 0, 1}));
  const Output first{32, 32};
  present(first);
  EXPECT_EQ(first.pixel(16, 16), (Rgb{255, 0, 0}));
  root_->removeChildren(0, 1);
  root_->addChild(makeQuad(5, 5, 0, {0, 1, 0, 1}));
  const Output second{32, 32};
  ASSERT_NE(first.id(), second.id());
  present(second);
  EXPECT_EQ(second.pixel(16, 16), (Rgb{0, 255, 0}));
  EXPECT_EQ(first.pixel(16, 16), (Rgb{255, 0, 0}));
}

/// Vertices that always lie at the same place in memory: one at a time.
class PlacedVertices : public osg::Vec3Array {
 public:
  using osg::Vec3Array::Vec3Array;
  static void* operator new(std::size_t size) {
    static std::array<std::max_align_t, 64> place;
    EXPECT_LE(size, sizeof(place));
    return place.data();
  }
  static void operator delete(void* /*place*/) {}
};

TEST_F(ViewPipelineTest, DrawsAnArrayThatLiesWhereAnotherLayBefore) {
  constexpr unsigned kPlaceAttribute = 7;
  const auto by_attribute = makeProgram("test_attribute",
                                        "#version 450 compatibility\nlayout(location = 7) in vec3 a_place;\n"
                                        "out vec4 v_color;\nvoid main() {\n"
                                        "  gl_Position = gl_ModelViewProjectionMatrix * vec4(a_place, 1.0);\n"
                                        "  v_color = gl_Color;\n}\n",
                                        kTestFragment);
  pipeline_->setView(
      {.eye_from_fixed = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0}), .is_orthographic = true, .vertical_extent_m = 2.0});
  const void* place = nullptr;
  for (const bool is_attribute : {false, true}) {
    for (const float side : {-1.0F, 1.0F, -1.0F}) {
      const osg::ref_ptr<osg::Geode> shape = makeQuad(1, 1, 0, {1, 0, 0, 1});
      osg::Geometry& geometry = *shape->getDrawable(0)->asGeometry();
      osg::ref_ptr<osg::Vec3Array> half = new PlacedVertices;
      EXPECT_TRUE(place == nullptr || place == half.get());
      place = half.get();
      for (const auto& [x, y] : {std::pair{0.0F, -1.0F}, {side, -1.0F}, {0.0F, 1.0F}, {side, 1.0F}}) {
        half->push_back({x, y, 0});
      }
      if (is_attribute) {
        geometry.setVertexAttribArray(kPlaceAttribute, half, osg::Array::BIND_PER_VERTEX);
        geometry.getOrCreateStateSet()->setAttributeAndModes(by_attribute);
      } else {
        geometry.setVertexArray(half);
      }
      root_->addChild(shape);
      ASSERT_TRUE(pipeline_->renderLinear(32, 32));  // nothing is drawn after the scene, which would hide it
      const std::vector<float> row = pipeline_->readColor(16, 1);
      const auto red = [&](std::size_t x) { return row.at(4 * x) > 0.0F; };
      EXPECT_EQ(red(8), side < 0) << side << (is_attribute ? ", an attribute" : "");
      EXPECT_EQ(red(24), side > 0) << side << (is_attribute ? ", an attribute" : "");
      root_->removeChildren(0, 1);
    }
  }
}

TEST_F(ViewPipelineTest, FillsTheOutputAtEverySize) {
  root_->addChild(makeQuad(5000, 50, 0, {0, 0, 1, 1}));
  for (const auto& [width, height] : {std::pair{64, 48}, {1, 1}, {7, 300}, {0, 0}, {640, 2}, {64, 0}, {64, 48}}) {
    if (width == 0 || height == 0) {
      EXPECT_TRUE(pipeline_->render(0, width, height));
      EXPECT_TRUE(pipeline_->passes().empty());
      continue;
    }
    const Output output{width, height};
    present(output);
    EXPECT_EQ(output.pixel(0, 0), (Rgb{0, 0, 255})) << width << "x" << height;
    EXPECT_EQ(output.pixel(width - 1, height - 1), (Rgb{0, 0, 255})) << width << "x" << height;
  }
}

TEST_F(ViewPipelineTest, RunsPostPassesInOrder) {
  const Output output{16, 16};
  root_->addChild(makeQuad(5, 5, 0, {1, 0, 0, 1}));
  pipeline_->setPostChain({.passes = {makePass("invert", "scene", "1.0 - scene")}});
  present(output);
  EXPECT_EQ(output.pixel(8, 8), (Rgb{0, 255, 255}));
  EXPECT_EQ(pipeline_->passes(), (Names{"scene", "invert", "present"}));

  pipeline_->setPostChain({.passes = {makePass("invert", "scene", "1.0 - scene"),
                                      makePass("rotate", "invert", "scene.brg * vec3(1.0, 0.0, 1.0)")}});
  present(output);
  EXPECT_EQ(output.pixel(8, 8), (Rgb{255, 0, 255}));  // (0, 1, 1) -> (1, 0, 1)
  EXPECT_EQ(pipeline_->passes(), (Names{"scene", "invert", "rotate", "present"}));
  ASSERT_TRUE(pipeline_->renderLinear(16, 16));
  const std::vector<float> rows = pipeline_->readColor(3, 5);
  ASSERT_EQ(rows.size(), 5U * 16U * 4U);
  EXPECT_EQ(rows[0], 1.0F);
  EXPECT_EQ(rows[1], 0.0F);
  EXPECT_EQ(pipeline_->readDepth(11, 5).size(), 5U * 16U);
  for (const auto& [first, count] : {std::pair{-1, 1}, {0, 0}, {12, 5}, {16, 1}}) {
    EXPECT_TRUE(pipeline_->readColor(first, count).empty()) << first;
    EXPECT_TRUE(pipeline_->readDepth(first, count).empty()) << first;
  }

  pipeline_->setPostChain({});
  present(output);
  EXPECT_EQ(output.pixel(8, 8), (Rgb{255, 0, 0}));
}

TEST_F(ViewPipelineTest, LetsAPassReadDepthAndItsParameters) {
  const Output output{16, 16};
  root_->addChild(makeQuad(0.5F, 5, 0, {1, 0, 0, 1}));
  PostPass pass{"nearness",
                "#version 450 compatibility\nuniform sampler2D u_depth;\nuniform float u_gain;\nvoid main() {\n"
                "  float depth = texelFetch(u_depth, ivec2(gl_FragCoord.xy), 0).r;\n"
                "  gl_FragColor = vec4(vec3(depth * u_gain), 1.0);\n}\n",
                {{"u_depth", "depth"}},
                new osg::StateSet};
  osg::ref_ptr<osg::Uniform> gain = new osg::Uniform{"u_gain", 300.0F};
  pass.parameters->addUniform(gain);
  pipeline_->setPostChain({.passes = {pass}});
  present(output);
  EXPECT_EQ(output.pixel(8, 8), (Rgb{255, 255, 255}));  // near 0.01 m / 3 m * 300 = 1
  EXPECT_EQ(output.pixel(0, 8), (Rgb{0, 0, 0}));
  gain->set(0.0F);
  present(output);
  EXPECT_EQ(output.pixel(8, 8), (Rgb{0, 0, 0}));
}

TEST_F(ViewPipelineTest, BindsItsTexturesWhicheverUnitWasLeftActive) {
  const Output output{16, 16};
  root_->addChild(makeQuad(5, 5, 0, {1, 1, 0, 1}));
  for (const GLenum unit : {3U, 0U, 5U}) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glClientActiveTexture(GL_TEXTURE0 + unit);
    present(output);
    EXPECT_EQ(output.pixel(8, 8), (Rgb{255, 255, 0})) << unit;
    pipeline_->releaseGl();
  }
}

TEST_F(ViewPipelineTest, ReleasesTwiceAndDrawsOn) {
  const Output output{16, 16};
  const LiveObjects before = LiveObjects::count();
  root_->addChild(makeQuad(5, 5, 0, {1, 1, 0, 1}));
  pipeline_->setPostChain({.passes = {makePass("invert", "scene", "1.0 - scene")}});
  for (int round = 0; round < 3; ++round) {
    present(output);
    EXPECT_EQ(output.pixel(8, 8), (Rgb{0, 0, 255})) << round;
    EXPECT_NE(LiveObjects::count(), before);
    pipeline_->releaseGl();
    pipeline_->releaseGl();
    EXPECT_EQ(LiveObjects::count(), before) << round;
  }
}

/// Four things, one of them blended, at different depths, and a pass.
TEST_F(ViewPipelineTest, DrawsInStepsWhatItDrawsAtOnce) {
  const Output output{64, 48};
  root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
  root_->addChild(makeQuad(0.5F, 2, 0.5F, {0, 1, 0, 1}));
  const osg::ref_ptr<osg::Geode> blended = makeQuad(2, 0.5F, 1, {0, 0, 1, 0.5F});
  setBlended(*blended->getOrCreateStateSet(), true);
  root_->addChild(blended);
  root_->addChild(makeShape(GL_POINTS, {{0, 0, 1.5F}, {-1, 1, 0}}, {{1, 1, 1, 1}}));
  pipeline_->setPostChain({.passes = {makePass("invert", "scene", "1.0 - scene")}});
  const auto picture = [&] {
    std::vector<Rgb> pixels;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        pixels.push_back(output.pixel(x, y));
      }
    }
    return pixels;
  };
  present(output);
  const std::vector<Rgb> at_once = picture();
  const Names passes = pipeline_->passes();
  const auto in_steps = [&](double budget_ms) {
    int steps = 1;
    for (auto drawn = pipeline_->step(output.id(), 64, 48, budget_ms); drawn == PictureStep::More; ++steps) {
      EXPECT_EQ(picture(), at_once) << "nothing is shown before all is drawn";
      drawn = pipeline_->step(output.id(), 64, 48, budget_ms);
    }
    pipeline_->present(output.id());
    EXPECT_EQ(picture(), at_once);
    EXPECT_EQ(pipeline_->passes(), passes);
    return steps;
  };
  EXPECT_GE(in_steps(0.0), 5) << "a drawable or a pass each";
  EXPECT_EQ(in_steps(1e6), 1);

  // What was begun is left for a picture of another size, and for one that is drawn at once.
  ASSERT_EQ(pipeline_->step(output.id(), 64, 48, 0.0), PictureStep::More);
  auto smaller = pipeline_->step(output.id(), 32, 24, 1e6);
  for (int steps = 1; steps < 20 && smaller == PictureStep::More; ++steps) {  // its passes are new
    smaller = pipeline_->step(output.id(), 32, 24, 1e6);
  }
  ASSERT_EQ(smaller, PictureStep::Whole);
  ASSERT_EQ(pipeline_->step(output.id(), 64, 48, 0.0), PictureStep::More);
  present(output);
  EXPECT_EQ(picture(), at_once);
  EXPECT_GE(in_steps(0.0), 5);
}

TEST_F(ViewPipelineTest, LeaksNothingOverAThousandResizesAndToggles) {
  const Output output{128, 128};
  root_->addChild(makeQuad(5, 5, 0, {1, 0, 1, 1}));
  const std::vector<PostPass> passes{makePass("invert", "scene", "1.0 - scene")};
  const auto settle = [&] {
    pipeline_->setPostChain({});
    EXPECT_TRUE(pipeline_->render(output.id(), 100, 100));
    EXPECT_TRUE(pipeline_->render(output.id(), 100, 100));
    return LiveObjects::count();
  };
  (void)settle();
  pipeline_->setPostChain({.passes = passes});
  EXPECT_TRUE(pipeline_->render(output.id(), 100, 100));
  const LiveObjects at_first = settle();
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(pipeline_->render(output.id(), 1 + i % 128, 1 + (7 * i) % 128));
  }
  EXPECT_EQ(settle(), at_first) << "after resizing";
  for (int i = 0; i < 1000; ++i) {
    pipeline_->setPostChain({.passes = i % 2 == 0 ? passes : std::vector<PostPass>{}});
    EXPECT_TRUE(pipeline_->render(output.id(), 100, 100));
  }
  EXPECT_EQ(settle(), at_first) << "after toggling";
}

}  // namespace
}  // namespace stillframe::scenegraph
