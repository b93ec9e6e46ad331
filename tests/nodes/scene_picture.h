#pragma once

#include <array>
#include <cstdlib>
#include <memory>
#include <string>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/export/picture_io.h"
#include "scenegraph/scene.h"
#include "tests/support/builders.h"
#include "tests/support/offscreen_test.h"

namespace stillframe::test {

using Bytes3 = std::array<int, 3>;

/// A scene of the real layers, drawn without a window.
///
/// With STILLFRAME_PICTURES=DIR in the environment each picture is written there, to be looked at.
class ScenePictureTest : public OffscreenTest {
 protected:
  void open(std::shared_ptr<scenegraph::Dataset> dataset, const std::string& fixed_frame) {
    scene_.reset();
    dataset_ = std::move(dataset);
    scene_ = std::make_unique<scenegraph::Scene>(dataset_, nodes::layerTypes(), *executor_);
    scene_->setFixedFrame(fixed_frame);
  }
  scenegraph::Layer& add(const std::string& topic, const scenegraph::SettingTexts& settings = {}) {
    const auto slot = scene_->addLayer(topic);
    EXPECT_TRUE(slot) << slot.error().message;
    const auto applied = (*slot)->layer->applySettings(settings);
    EXPECT_TRUE(applied) << applied.error().message;
    return *(*slot)->layer;
  }
  scenegraph::BytePicture draw(std::int64_t time_ns, const scenegraph::CameraView& view, int width = 200,
                               int height = 200, const scenegraph::PostChain& post = {}) {
    scene_->update(tf::TimePoint{time_ns});
    scene_->setView(view, {static_cast<double>(width), static_cast<double>(height)});
    return toBeSeen(
        render(scene_->root(), view, {.width = width, .height = height, .background = {0, 0, 0, 1}, .post = post}));
  }
  /// Its bytes, also written where STILLFRAME_PICTURES says.
  scenegraph::BytePicture toBeSeen(const scenegraph::Picture& picture) {
    auto bytes = scenegraph::toBytes(picture);
    if (const char* folder = std::getenv("STILLFRAME_PICTURES")) {
      const auto* info = testing::UnitTest::GetInstance()->current_test_info();
      const std::string name = std::string(info->name()) + "_" + std::to_string(pictures_++) + ".png";
      EXPECT_TRUE(scenegraph::writePng(bytes, std::string(folder) + "/" + name));
    }
    return bytes;
  }

  static Bytes3 pixel(const scenegraph::BytePicture& picture, int x, int y) {
    const std::uint8_t* rgb = &picture.rgb[static_cast<std::size_t>(y * picture.width + x) * 3];
    return {rgb[0], rgb[1], rgb[2]};
  }
  /// Pixels that are not the black background.
  static int drawnPixels(const scenegraph::BytePicture& picture) {
    int drawn = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      drawn += picture.rgb[i] + picture.rgb[i + 1] + picture.rgb[i + 2] > 0 ? 1 : 0;
    }
    return drawn;
  }

  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::unique_ptr<scenegraph::Scene> scene_;
  int pictures_ = 0;
};

/// Straight down from `height` over (x, y): x to the right, y up; 1 m is 10 pixels of 200 when orthographic.
inline scenegraph::CameraView fromAbove(double x = 0.0, double y = 0.0, double z = 10.0) {
  return {.eye_from_fixed = scenegraph::lookAt({x, y, z}, {x, y, z - 1.0}, {0, 1, 0}),
          .is_orthographic = true,
          .vertical_extent_m = 20.0};
}

}  // namespace stillframe::test
