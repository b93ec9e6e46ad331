#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "tests/nodes/poses/poses_builder.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {

/// Poses on "/poses" at 1 s, `base` in the middle of `map`.
inline std::shared_ptr<scenegraph::Dataset> datasetOf(scenegraph::PosesInFrame poses) {
  return DatasetBuilder()
      .topic("/tf", scenegraph::ObjectType::FrameTransforms)
      .transform(0, "map", "base")
      .topic("/poses", scenegraph::ObjectType::PosesInFrame)
      .at(1_s, std::move(poses))
      .build();
}

/// Draws a topic of poses and says what is seen of it.
class PosesPicture : public ScenePictureTest {
 protected:
  scenegraph::BytePicture drawPoses(scenegraph::PosesInFrame poses, const scenegraph::SettingTexts& settings = {},
                                    const scenegraph::CameraView& view = fromAbove()) {
    open(datasetOf(std::move(poses)), "map");
    layer_ = &add("/poses", settings);
    return draw(1_s, view);
  }
  /// Channel that is far above the two others; -1 when none is.
  static int hue(const Bytes3& color) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (color[c] > 60 + color[(c + 1) % 3] && color[c] > 60 + color[(c + 2) % 3]) {
        return static_cast<int>(c);
      }
    }
    return -1;
  }
  static std::pair<int, int> extent(const scenegraph::BytePicture& picture) {
    int left = picture.width;
    int right = -1;
    int top = picture.height;
    int bottom = -1;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (pixel(picture, x, y) != Bytes3{0, 0, 0}) {
          left = std::min(left, x);
          right = std::max(right, x);
          top = std::min(top, y);
          bottom = std::max(bottom, y);
        }
      }
    }
    return {right - left + 1, bottom - top + 1};
  }
  std::uint64_t count(const std::string& name) const {
    for (const auto& [key, value] : layer_->counts()) {
      if (key == name) {
        return value;
      }
    }
    ADD_FAILURE() << name;
    return 0;
  }

  scenegraph::Layer* layer_ = nullptr;
};

}  // namespace stillframe::test
