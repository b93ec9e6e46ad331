#pragma once

// What tests of pictures in steps share.
#include "tests/scenegraph/pipeline/output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <osg/MatrixTransform>
#include <utility>
#include <vector>

#include "scenegraph/blending.h"
#include "scenegraph/passes/antialiasing.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "tests/scenegraph/pipeline/shader_scene.h"

namespace stillframe::scenegraph {

inline constexpr int kWidth = 96;
inline constexpr int kHeight = 72;

inline PostChain supersampling(int samples) {
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

  /// The same of a picture that is then presented, so that the next begins anew.
  [[nodiscard]] int inStepsAndPresented(double budget_ms = 0.0) {
    const int steps = inSteps(budget_ms);
    pipeline_->present(output_->id());
    return steps;
  }

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Output> output_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::unique_ptr<ViewPipeline> pipeline_;
};

/// A wavy sheet of so many triangles, with indices or without.
inline osg::ref_ptr<osg::Geode> makeSheet(unsigned triangles, bool has_indices, const osg::Vec4& color) {
  std::vector<osg::Vec3> corners;
  for (unsigned i = 0; i < triangles; ++i) {
    const unsigned row = i / 300;
    const float x = static_cast<float>(i % 300) / 150.0F - 1.0F;
    const float y = static_cast<float>(row) / 150.0F - 1.0F;
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

}  // namespace stillframe::scenegraph
