#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <osg/MatrixTransform>
#include <set>

#include "nodes/line_state.h"
#include "nodes/lines/line_drawable.h"
#include "nodes/points/colormap.h"
#include "scenegraph/geometry.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using nodes::LineBuilder;
using nodes::LineDrawable;
using nodes::LineStyle;
using Kind = LineBuilder::Kind;
using Points = std::vector<glm::dvec3>;

class LinePicture : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    place_->addChild(lines_.geometry());
    root_->addChild(place_);
  }
  void setLine(Kind kind, const Points& points, const LineStyle& style = {}) {
    LineBuilder builder;
    append(builder, kind, points, style);
    lines_.set(builder.take());
  }
  static void append(LineBuilder& builder, Kind kind, const Points& points, const LineStyle& style = {}) {
    builder.begin(kind, style);
    for (const glm::dvec3& point : points) {
      builder.add(point);
    }
    builder.end();
  }
  scenegraph::BytePicture drawLines(const scenegraph::CameraView& view = fromAbove()) {
    return toBeSeen(render(*root_, view, {.width = 200, .height = 200, .background = {0, 0, 0, 1}}));
  }
  static int drawnInColumn(const scenegraph::BytePicture& picture, int x) {
    int drawn = 0;
    for (int y = 0; y < picture.height; ++y) {
      drawn += pixel(picture, x, y) != Bytes3{0, 0, 0} ? 1 : 0;
    }
    return drawn;
  }
  static std::set<Bytes3> colors(const scenegraph::BytePicture& picture) {
    std::set<Bytes3> all;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        all.insert(pixel(picture, x, y));
      }
    }
    return all;
  }

  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::MatrixTransform> place_ = new osg::MatrixTransform;
  LineDrawable lines_;
};

TEST_F(LinePicture, IsAsWideAsItsPixels) {
  for (const int width : {1, 2, 5, 20}) {
    setLine(Kind::Strip, {{-5, 0.013, 0}, {5, 0.013, 0}}, {.width = static_cast<double>(width)});
    const auto picture = drawLines();
    EXPECT_EQ(drawnInColumn(picture, 100), width);
    EXPECT_EQ(drawnPixels(picture), 100 * width) << "ends are cut straight";
  }
  setLine(Kind::Strip, {{-5, 0.0, 0}, {5, 0.0, 0}}, {.width = 1.0});
  EXPECT_EQ(drawnPixels(drawLines()), 100) << "between two rows of pixels too";
}

TEST_F(LinePicture, IsAsWideAsItsMetresAndNeverThinnerThanAPixel) {
  setLine(Kind::Strip, {{-5, 0.013, 0}, {5, 0.013, 0}}, {.width = 0.6, .in_metres = true});
  EXPECT_EQ(drawnPixels(drawLines()), 100 * 6);
  lines_.setStyle(0, {.width = 1e-9, .in_metres = true});
  EXPECT_EQ(drawnPixels(drawLines()), 100);
  lines_.setStyle(0, {.width = 3.0, .in_metres = false});
  EXPECT_EQ(drawnPixels(drawLines()), 100 * 3);

  // Seen along a line of 1 m: its width falls with the distance.
  setLine(Kind::Strip, {{0, 2, -1}, {0, 80, -1}}, {.width = 1.0, .in_metres = true});
  const auto picture = drawLines({.eye_from_fixed = scenegraph::lookAt({0, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                                  .vertical_fov_rad = std::numbers::pi / 2});
  const auto drawnInRow = [&](int y) {
    int drawn = 0;
    for (int x = 0; x < 200; ++x) {
      drawn += pixel(picture, x, y) != Bytes3{0, 0, 0} ? 1 : 0;
    }
    return drawn;
  };
  EXPECT_NEAR(drawnInRow(149), 50, 2) << "at 2 m, where 100 pixels are 2 m";
  EXPECT_NEAR(drawnInRow(125), 25, 2) << "at 4 m";
  EXPECT_NEAR(drawnInRow(110), 10, 2) << "at 10 m";
}

TEST_F(LinePicture, HasNeitherGapsNorSpikesNorDoubleBlendingAtJoints) {
  Points zigzag;
  for (int i = 0; i < 9; ++i) {
    zigzag.push_back({i % 2 == 0 ? -6.0 : 6.0 - i, -4.0 + i, 0});  // ever sharper turns
  }
  setLine(Kind::Strip, zigzag, {.width = 16.0});
  lines_.setColor({.r = 1.0F, .g = 1.0F, .b = 1.0F, .a = 1.0F});
  const auto opaque = drawLines();
  for (std::size_t i = 1; i + 1 < zigzag.size(); ++i) {
    const int x = 100 + static_cast<int>(std::lround(10 * zigzag[i].x));
    const int y = 100 - static_cast<int>(std::lround(10 * zigzag[i].y));
    const int outwards = i % 2 == 0 ? -1 : 1;
    EXPECT_NE(pixel(opaque, x + 6 * outwards, y), (Bytes3{0, 0, 0})) << "no gap outside joint " << i;
    EXPECT_EQ(pixel(opaque, x + 10 * outwards, y), (Bytes3{0, 0, 0})) << "no spike outside joint " << i;
  }
  setLine(Kind::Strip, {{-6, -6, 0}, {0, 6, 0}, {6, -6, 0}, {6, 6, 0}}, {.width = 16.0});
  lines_.setOpacity(0.5);
  EXPECT_EQ(colors(drawLines()).size(), 2U) << "black, and one half of white";
}

TEST_F(LinePicture, StaysWholeWhenSegmentsAreSmallerThanPixels) {
  Points circle;
  for (int i = 0; i < 20'000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 20'000;
    circle.push_back({5.0 * std::cos(angle), 5.0 * std::sin(angle), 0});
  }
  setLine(Kind::Loop, circle, {.width = 3.0});
  lines_.setOpacity(0.5);
  const auto picture = drawLines();
  EXPECT_NEAR(drawnPixels(picture), 2.0 * std::numbers::pi * 50 * 3, 20);
  EXPECT_LE(colors(picture).size(), 3U);

  setLine(Kind::Loop, {{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.01, 0}}, {.width = 6.0});
  EXPECT_NEAR(drawnPixels(drawLines()), std::numbers::pi * 9, 6) << "a loop within its own width is a dot, not a hole";
}

TEST_F(LinePicture, CutsWhatIsBehindTheCamera) {
  // From far behind the eye past its right side to far ahead: to the vanishing point from the right.
  setLine(Kind::Strip, {{1, -1000, 0}, {1, 1000, 0}}, {.width = 3.0});
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({0, 0, 0}, {0, 1, 0}, {0, 0, 1})};
  const auto picture = drawLines(view);
  EXPECT_EQ(drawnInColumn(picture, 199), 3);
  EXPECT_EQ(drawnInColumn(picture, 150), 3);
  EXPECT_EQ(drawnInColumn(picture, 98), 0);
  setLine(Kind::Strip, {{1, -1000, 0}, {1, -1, 0}}, {.width = 3.0});
  EXPECT_EQ(drawnPixels(drawLines(view)), 0);
  // Through the eye itself, and a strip that turns behind it.
  setLine(Kind::Strip, {{0, -5, 0}, {0, 5, 0}, {3, 9, 0}, {3, -9, 0}, {-3, -9, 0}, {-3, 9, 0}}, {.width = 3.0});
  const auto turned = drawLines(view);
  EXPECT_EQ(drawnInColumn(turned, 195), 3);
  EXPECT_EQ(drawnInColumn(turned, 5), 3);
}

TEST_F(LinePicture, BreaksAtNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  setLine(Kind::Strip, {{-5, 0, 0}, {-2, 0, 0}, {nan, 0, 0}, {2, 0, 0}, {5, 0, 0}}, {.width = 3.0});
  const auto picture = drawLines();
  EXPECT_EQ(drawnPixels(picture), 2 * 30 * 3);
  EXPECT_EQ(drawnInColumn(picture, 100), 0);
}

TEST_F(LinePicture, IsTheSameOnTheFarSideOfTheEarth) {
  const glm::dvec3 far{4'200'000.0, 470'000.0, 4'780'000.0};
  const Points points{{-5, -5, 0}, {0, 5, 0}, {0.3, -5, 0}, {5, 5, 0}};
  LineBuilder near_by;
  append(near_by, Kind::Strip, points, {.width = 3.0});
  lines_.set(near_by.take());
  const auto at_origin = drawLines(fromAbove());
  LineBuilder builder(far);
  Points moved;
  for (const glm::dvec3& point : points) {
    moved.push_back(far + point);
  }
  append(builder, Kind::Strip, moved, {.width = 3.0});
  lines_.set(builder.take());
  place_->setMatrix(osg::Matrixd::translate(far.x, far.y, far.z));
  EXPECT_LE(difference(at_origin, drawLines(fromAbove(far.x, far.y, far.z + 10))).pixels, 2U);
}

TEST_F(LinePicture, ColoursByPointAndByValue) {
  LineBuilder colored({}, LineBuilder::Channel::Colors);
  colored.begin(Kind::Strip, {.width = 5.0});
  colored.add({-10, 0, 0}, {255, 0, 0, 255});
  colored.add({10, 0, 0}, {0, 0, 255, 255});
  colored.end();
  lines_.set(colored.take());
  auto picture = drawLines();
  EXPECT_NEAR(pixel(picture, 2, 100)[0], 252, 3);
  EXPECT_NEAR(pixel(picture, 100, 100)[0], 127, 3);
  EXPECT_NEAR(pixel(picture, 197, 100)[2], 252, 3);

  LineBuilder valued({}, LineBuilder::Channel::Values);
  valued.begin(Kind::Strip, {.width = 5.0});
  valued.add({-10, 0, 0}, {}, 100.0F);
  valued.add({5, 0, 0}, {}, 200.0F);
  valued.add({10, 0, 0}, {}, std::numeric_limits<float>::quiet_NaN());
  valued.end();
  lines_.set(valued.take());
  const nodes::Colormap& viridis = *nodes::findColormap("viridis");
  lines_.setValueColors("viridis", nodes::mapRange({100.0, 300.0}), {.r = 1.0F, .g = 0.0F, .b = 1.0F, .a = 1.0F});
  picture = drawLines();
  for (const auto& [x, t] : {std::pair{1, 0.0}, {75, 0.25}, {148, 0.5}}) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(pixel(picture, x, 100)[i], viridis.at(t)[i] * 255, 3) << x;
    }
  }
  EXPECT_EQ(pixel(picture, 175, 100), (Bytes3{255, 0, 255}));
}

TEST_F(LinePicture, DrawsManyStripsOfManyStylesInOneCall) {
  LineBuilder builder;
  for (int i = 0; i < 9; ++i) {
    append(builder, Kind::Strip, {{-8.0, -8.0 + 2 * i, 0}, {8.0, -8.0 + 2 * i, 0}}, {.width = 1.0 + i});
  }
  append(builder, Kind::List, {{9, -9, 0}, {9, 9, 0}}, {.width = 0.4, .in_metres = true});
  lines_.set(builder.take());
  EXPECT_EQ(lines_.geometry()->getNumPrimitiveSets(), 1U);
  const auto picture = drawLines();
  EXPECT_EQ(drawnInColumn(picture, 100), 45);
  EXPECT_EQ(drawnPixels(picture), 45 * 160 + 4 * 180);
  lines_.clear();
  EXPECT_EQ(drawnPixels(drawLines()), 0);
}

TEST_F(LinePicture, ShowsBothHalvesOnASurfaceWhenPulled) {
  osg::ref_ptr<osg::Geometry> ground = scenegraph::makeGeometry();
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  corners->asVector() = {{-50, -50, 0}, {50, -50, 0}, {-50, 50, 0}, {50, 50, 0}};
  ground->setVertexArray(corners);
  ground->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
  nodes::LineState black;
  black.setColor({.r = 0.0F, .g = 0.0F, .b = 0.0F, .a = 1.0F});
  ground->setStateSet(black.stateSet());
  root_->addChild(ground);
  setLine(Kind::Strip, {{-50, 0, 0}, {50, 0, 0}}, {.width = 10.0});
  const scenegraph::CameraView slanted{.eye_from_fixed = scenegraph::lookAt({0, -10, 5}, {0, 0, 0}, {0, 0, 1})};
  scenegraph::CameraView level = slanted;
  level.is_orthographic = true;
  for (const auto& view : {slanted, level}) {
    lines_.setDepthPull(0.0);
    EXPECT_LE(drawnInColumn(drawLines(view), 100), 6);
    lines_.setDepthPull(4.0);
    EXPECT_EQ(drawnInColumn(drawLines(view), 100), 10);
  }
  setLine(Kind::Strip, {{-50, 0, -1}, {50, 0, -1}}, {.width = 10.0});
  EXPECT_EQ(drawnPixels(drawLines(slanted)), 0) << "what lies clearly behind stays hidden";
}

TEST_F(LinePicture, LooksTheSameInAPlainViewer) {
  LineBuilder builder({}, LineBuilder::Channel::Colors);
  for (int strip = 0; strip < 200; ++strip) {
    builder.begin(strip % 2 == 0 ? Kind::Strip : Kind::Loop,
                  {.width = strip % 3 == 0 ? 0.2 : 3.0, .in_metres = strip % 3 == 0});
    Random random(static_cast<std::uint64_t>(strip));
    for (int i = 0; i < 5; ++i) {
      builder.add(
          {random.number(-6, 6), random.number(-6, 6), random.number(-6, 6)},
          {static_cast<unsigned char>(random.number(0, 256)), static_cast<unsigned char>(60 + i * 40), 90, 255});
    }
    builder.end();
  }
  lines_.set(builder.take());
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({1, -4, 3}, {0, 0, 0}, {0, 0, 1})};
  const auto ours = drawLines(view);
  const osg::ref_ptr<osg::Node> back = exportedAndRead(*root_, ".osgt", 200);
  ASSERT_TRUE(back.valid());
  const auto plain = drawPlainly(*back, view, 0.01, 100.0, 200, 200, {0, 0, 0, 1});
  EXPECT_GE(drawnPixels(ours), 10'000);
  EXPECT_LE(difference(ours, plain).beyond_one, 40U) << "where lines cross within a step of ordinary depth";
}

}  // namespace
}  // namespace stillframe::test
