#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <osg/MatrixTransform>
#include <vector>

#include "tests/scenegraph/pipeline/shader_scene.h"
#include "tests/support/offscreen_test.h"

namespace stillframe::scenegraph {

/// Writes the vertex colour as it is: scene-linear light of any size, and in alpha the share that is data.
inline const char* const kRawFragment = R"(#version 450 compatibility
in vec4 v_color;
void main() { gl_FragColor = v_color; }
)";

/// A shape whose colours go into the scene's target untouched.
inline osg::ref_ptr<osg::Geode> makeRawShape(GLenum mode, const std::vector<osg::Vec3>& vertices,
                                             const std::vector<osg::Vec4>& colors) {
  osg::ref_ptr<osg::Geode> geode = makeShape(mode, vertices, colors);
  geode->getDrawable(0)->getOrCreateStateSet()->setAttributeAndModes(
      makeProgram("test_raw", kTestVertex, kRawFragment));
  return geode;
}

/// A row of `colors`, one pixel each, for lookAcross().
inline osg::ref_ptr<osg::Geode> makeRow(const std::vector<osg::Vec4>& colors) {
  std::vector<osg::Vec3> vertices;
  std::vector<osg::Vec4> corners;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const auto left = static_cast<float>(i);
    for (const auto& [x, y] : {std::pair{0.0F, -99.0F}, {1.0F, -99.0F}, {1.0F, 99.0F}, {0.0F, 99.0F}}) {
      vertices.emplace_back(left + x, y, 0.0F);
      corners.push_back(colors[i]);
    }
  }
  return makeRawShape(GL_QUADS, vertices, corners);
}

/// Orthographic, one metre a pixel over 0..width and -height/2..height/2.
inline CameraView lookAcross(int width, int height) {
  return {.eye_from_fixed = lookAt({width / 2.0, 0, 3}, {width / 2.0, 0, 0}, {0, 1, 0}),
          .is_orthographic = true,
          .vertical_extent_m = static_cast<double>(height),
          .half_depth_m = 10.0};
}

/// Two walls at a right angle, the crease along the y axis at the origin, seen into the corner.
inline osg::ref_ptr<osg::Group> makeCorner(float size_m) {
  osg::ref_ptr<osg::Group> corner = new osg::Group;
  const osg::Vec4 white(1, 1, 1, 1);
  corner->addChild(makeShape(GL_TRIANGLE_STRIP,
                             {{0, -size_m, 0}, {size_m, -size_m, size_m}, {0, size_m, 0}, {size_m, size_m, size_m}},
                             {white}));
  corner->addChild(makeShape(GL_TRIANGLE_STRIP,
                             {{0, -size_m, 0}, {-size_m, -size_m, size_m}, {0, size_m, 0}, {-size_m, size_m, size_m}},
                             {white}));
  return corner;
}

/// Pictures of small scenes through chains of passes.
class PassTest : public test::OffscreenTest {
 protected:
  Picture draw(const CameraView& view, int width, int height, const PostChain& chain) {
    return render(*root_, view, {.width = width, .height = height, .background = background_, .post = chain});
  }
  static float red(const Picture& picture, int x, int y) {
    return picture.rgba[static_cast<std::size_t>(y * picture.width + x) * 4];
  }
  /// Values of the picture that are no finite number, or below zero.
  static std::size_t badValues(const Picture& picture) {
    return static_cast<std::size_t>(
        std::ranges::count_if(picture.rgba, [](float value) { return !std::isfinite(value) || value < 0.0F; }));
  }
  /// Root of the mean square difference of two pictures' colours.
  static double rmse(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      const double difference = static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]);
      sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(a.rgba.size()));
  }

  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  Color background_{0, 0, 0, 1};
};

}  // namespace stillframe::scenegraph
