#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "scenegraph/pipeline/offscreen_renderer.h"

namespace stillframe::test {

/// Pictures without a window; every test also fails on a GL debug message.
class OffscreenTest : public testing::Test {
 protected:
  void SetUp() override {
    auto renderer = scenegraph::OffscreenRenderer::create();
    ASSERT_TRUE(renderer) << renderer.error().message;
    renderer_ = std::move(*renderer);
  }
  void TearDown() override {
    if (renderer_ != nullptr) {
      EXPECT_EQ(renderer_->context().debugLog().count(), 0U)
          << testing::PrintToString(renderer_->context().debugLog().messages());
    }
  }
  /// An empty picture, and a failure, where it is refused.
  scenegraph::Picture render(osg::Group& root, const scenegraph::CameraView& view,
                             const scenegraph::RenderOptions& options) {
    auto picture = renderer_->render(root, view, options);
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? std::move(*picture) : scenegraph::Picture{};
  }

  std::unique_ptr<scenegraph::OffscreenRenderer> renderer_;
};

}  // namespace stillframe::test
