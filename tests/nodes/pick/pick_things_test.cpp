// Picked markers, poses, links and frames; and whatever type of layer there is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/scene_entities.h"
#include "tests/nodes/pick/pick_picture.h"
#include "tests/nodes/poses/poses_builder.h"
#include "tests/support/layer_contract.h"

namespace stillframe::test {
namespace {

using scenegraph::EntityColor;
using scenegraph::LineType;
using scenegraph::ObjectType;
using scenegraph::PickError;
using scenegraph::SceneEntities;
using scenegraph::SceneEntity;

const tf::RigidTransform kMapFromBase = turn(0.5, 4e6, -1e6, 100.0);

DatasetBuilder atBase() {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base", kMapFromBase);
  return builder;
}

SceneEntity entityOf(const std::string& id) {
  SceneEntity entity;
  entity.frame_id = "base";
  entity.id = "3:box:" + id;
  entity.marker_namespace = "box";
  entity.stamp = {55};
  entity.metadata = {{"class", "car " + id}};
  return entity;
}

/// Looks down on base's origin, 1 m being 10 pixels of 200; base is turned against the map.
class PickedThings : public PickTest {
 protected:
  void drawDown() {
    const glm::dvec3 eye = tf::transformPoint(kMapFromBase, {0, 0, 20});
    const glm::dvec3 target = kMapFromBase.translation;
    const glm::dvec3 up = kMapFromBase.rotation * glm::dvec3(0, 1, 0);
    draw(1_s,
         {.eye_from_fixed = scenegraph::lookAt(eye, target, up), .is_orthographic = true, .vertical_extent_m = 20.0});
  }
  /// At a place of base seen from above.
  auto at(double x, double y, int reach = 3) {
    return pickAt(static_cast<int>(100 + 10 * x), static_cast<int>(100 - 10 * y), reach);
  }
};

TEST_F(PickedThings, MarkersOfEveryKindAreToldApart) {
  SceneEntities scene;
  const auto take = [&](SceneEntity entity) {
    scene.steps.push_back({false, scene.entities.size()});
    scene.entities.push_back(std::move(entity));
  };
  SceneEntity cubes = entityOf("cubes");
  cubes.cubes.push_back({.pose = translate(-8, 8, 1), .size = {2, 2, 2}, .color = {1.0F, 0.5F, 0.0F, 1.0F}});
  cubes.cubes.push_back({.pose = translate(-4, 8, 0), .size = {2, 2, 4}, .color = {}});
  take(cubes);
  SceneEntity sphere = entityOf("sphere");
  sphere.spheres.push_back({.pose = translate(0, 8, 0), .size = {3, 3, 3}, .color = {}});
  take(sphere);
  for (const double y : {4.0, 2.0}) {
    SceneEntity line = entityOf("line " + std::to_string(static_cast<int>(y)));
    scenegraph::LinePrimitive strip;
    strip.type = LineType::Strip;
    strip.thickness = 0.3;
    strip.points = {{-8, y, 1}, {0, y, 2}, {8, y, 3}};
    line.lines.push_back(strip);
    take(line);
  }
  for (const double x : {-6.0, 2.0}) {
    SceneEntity triangle = entityOf("triangle " + std::to_string(static_cast<int>(x)));
    scenegraph::TrianglePrimitive corners;
    corners.points = {{x, -4, 0}, {x + 4, -4, 0}, {x, 0, 2}};
    triangle.triangles.push_back(corners);
    take(triangle);
  }
  SceneEntity points = entityOf("points");
  scenegraph::PointsPrimitive squares;
  squares.width_m = squares.height_m = 0.5;
  squares.points = {{-4, -8, 0.5}, {4, -8, -0.5}};
  points.points.push_back(squares);
  take(points);
  SceneEntity text = entityOf("text");
  text.texts.push_back(
      {.pose = translate(6, 8, 0.25), .is_billboard = true, .font_size = 2.0, .color = {}, .text = "MMM"});
  take(text);
  open(atBase().topic("/markers", ObjectType::SceneEntities).at(1_s, scene).build(), "map");
  add("/markers");
  drawDown();

  struct Case {
    double x, y;
    const char* id;
    const char* primitive;
    glm::dvec3 point;
  };
  for (const Case& c :
       {Case{-8, 8, "cubes", "cube", {-8, 8, 2}}, Case{-4, 8, "cubes", "cube", {-4, 8, 2}},
        Case{-8.6, 7.4, "cubes", "cube", {-8.6, 7.4, 2}}, Case{0, 8, "sphere", "sphere", {0, 8, 1.5}},
        Case{-4, 4, "line 4", "line", {-4, 4, 1.5}}, Case{4, 4, "line 4", "line", {4, 4, 2.5}},
        Case{-4, 2, "line 2", "line", {-4, 2, 1.5}}, Case{-5, -3, "triangle -6", "triangles", {-5, -3, 0.5}},
        Case{3, -2, "triangle 2", "triangles", {3, -2, 1.0}}, Case{-4, -8, "points", "point", {-4, -8, 0.5}},
        Case{4, -8, "points", "point", {4, -8, -0.5}}, Case{6, 8, "text", "text", {6, 8, 0.25}}}) {
    const auto result = at(c.x, c.y);
    ASSERT_TRUE(result) << c.id << " at " << c.x << ", " << c.y;
    EXPECT_EQ(result->picked.kind, "marker");
    EXPECT_EQ(result->picked.id, c.id);
    EXPECT_EQ(field(result->picked, "primitive"), c.primitive);
    EXPECT_EQ(field(result->picked, "namespace"), "box");
    EXPECT_EQ(field(result->picked, "class"), std::string("car ") + c.id);
    EXPECT_EQ(result->picked.stamp, tf::TimePoint{55});
    EXPECT_EQ(result->frame, "base");
    // The middle of a pixel is half a pixel off the place asked for.
    expectPoint(result->picked.point_in_frame, c.point, std::string(c.id) == "sphere" ? 0.1 : 0.06);
    expectPoint(result->point_in_fixed, tf::transformPoint(kMapFromBase, result->picked.point_in_frame), 1e-8);
  }
  const scenegraph::Picked cube = at(-4, 8)->picked;
  EXPECT_EQ(field(cube, "pose_x"), "-4");
  EXPECT_EQ(field(cube, "pose_qw"), "1");
  EXPECT_EQ(field(cube, "size_z"), "4");
  EXPECT_EQ(field(at(0, 8)->picked, "size_x"), "3");
  EXPECT_EQ(field(at(-4, 4)->picked, "thickness"), "0.3");
  EXPECT_EQ(field(at(4, -8)->picked, "width"), "0.5");
  EXPECT_EQ(field(at(6, 8)->picked, "font_size"), "2");
  EXPECT_EQ(field(at(6, 8)->picked, "text"), "MMM");
  EXPECT_EQ(field(at(-8, 8)->picked, "color"), "#ff8000");
  EXPECT_EQ(at(0, -8).error(), PickError::NothingThere);
}

TEST_F(PickedThings, ArrowsCylindersAndAxesSayTheirOwnPosesAndSizes) {
  const tf::RigidTransform pose = test::turn(0.3, -5.0, 1.0 / 3.0, 0.0);
  SceneEntities scene;
  SceneEntity one = entityOf("all");
  one.arrows.push_back({.pose = pose,
                        .shaft_length = 3.0,
                        .shaft_diameter = 1.1,
                        .head_length = 1.0 / 3.0,
                        .head_diameter = 2.0,
                        .color = {}});
  one.cylinders.push_back(
      {.pose = translate(5, 5, 0), .size = {2, 3, 4}, .bottom_scale = 1.0, .top_scale = 0.5, .color = {}});
  one.axes.push_back({.pose = translate(5, -5, 0), .length = 2.5, .thickness = 0.6});
  scene.steps.push_back({false, 0});
  scene.entities.push_back(one);
  open(atBase().topic("/markers", ObjectType::SceneEntities).at(1_s, scene).build(), "map");
  add("/markers");
  drawDown();
  const glm::dvec3 shaft = tf::transformPoint(pose, {1.5, 0, 0});
  const auto arrow = at(shaft.x, shaft.y);
  ASSERT_TRUE(arrow);
  EXPECT_EQ(field(arrow->picked, "primitive"), "arrow");
  EXPECT_EQ(field(arrow->picked, "pose_y"), scenegraph::pickText(1.0 / 3.0)) << "with every digit";
  EXPECT_EQ(field(arrow->picked, "pose_qz"), scenegraph::pickText(pose.rotation.z));
  EXPECT_EQ(field(arrow->picked, "head_length"), scenegraph::pickText(1.0 / 3.0));
  EXPECT_EQ(field(arrow->picked, "shaft_diameter"), "1.1");
  const auto cylinder = at(5, 5);
  ASSERT_TRUE(cylinder);
  EXPECT_EQ(field(cylinder->picked, "primitive"), "cylinder");
  EXPECT_EQ(field(cylinder->picked, "size_y"), "3");
  EXPECT_EQ(field(cylinder->picked, "top_scale"), "0.5");
  const auto axes = at(6.5, -5);
  ASSERT_TRUE(axes);
  EXPECT_EQ(field(axes->picked, "primitive"), "axes");
  EXPECT_EQ(field(axes->picked, "length"), "2.5");
}

TEST_F(PickedThings, SurfacesAreHitWhereTheRayMeetsThemNotWhereDepthIsRounded) {
  SceneEntities scene;
  SceneEntity box = entityOf("floor");
  box.cubes.push_back({.pose = translate(0, 0, -0.5), .size = {18, 18, 1}, .color = {}});
  scene.entities.push_back(box);
  scene.steps.push_back({false, 0});
  open(atBase().topic("/markers", ObjectType::SceneEntities).at(1_s, scene).build(), "base");
  add("/markers");
  // Along the floor from afar: a step of float depth is centimetres there.
  draw(1_s, {.eye_from_fixed = scenegraph::lookAt({-900.0, 0, 60}, {0, 0, 0}, {0, 0, 1}), .vertical_fov_rad = 0.01});
  for (const int y : {95, 100, 105}) {
    const auto result = pickAt(100, y, 0);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->point_in_fixed.z, 0.0, 1e-6);
  }
}

TEST_F(PickedThings, PosesSayTheirPlaceInTheMessage) {
  std::vector<tf::RigidTransform> path;
  for (int i = 0; i < 9; ++i) {
    path.push_back(translate(i - 4.0, 2.0, 0.25 * i));
  }
  open(atBase()
           .topic("/array", ObjectType::PosesInFrame)
           .at(1_s, posesOf(scenegraph::PosesKind::Array,
                            {translate(-5, -2, 0), turn(1.0, 0, -2, 0), turn(2.0, 5, -2, 0)}, "base"))
           .topic("/path", ObjectType::PosesInFrame)
           .at(1_s, posesOf(scenegraph::PosesKind::Path, path, "base"))
           .build(),
       "map");
  add("/array", {{"length", "3"}});
  add("/path");
  drawDown();
  for (int i = 0; i < 3; ++i) {
    const auto result = at(5.0 * i - 5.0, -2.0);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->topic, "/array");
    EXPECT_EQ(result->picked.kind, "pose");
    EXPECT_EQ(result->picked.id, std::to_string(i));
    expectPoint(result->picked.point_in_frame, {5.0 * i - 5.0, -2.0, 0.0}, 0.0);
  }
  for (int i = 1; i < 8; ++i) {
    const auto result = at(i - 4.0 + 0.2, 2.0);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->topic, "/path");
    EXPECT_EQ(result->picked.id, std::to_string(i));
    EXPECT_EQ(field(result->picked, "part"), "line");
    EXPECT_EQ(result->picked.stamp, tf::TimePoint{i * 1_s});
    EXPECT_EQ(result->picked.point_in_frame, path[static_cast<std::size_t>(i)].translation);
  }
}

TEST_F(PickedThings, LinksSayTheirNameAndShapeAndFramesTheirParent) {
  const std::string urdf =
      "<robot name='r'><link name='base'><visual><geometry><box size='4 4 1'/></geometry></visual></link>"
      "<link name='wheel'><visual><geometry><sphere radius='1'/></geometry></visual></link>"
      "<joint name='axle' type='fixed'><parent link='base'/><child link='wheel'/><origin xyz='6 0 0'/></joint></robot>";
  open(atBase()
           .topic("/robot", ObjectType::RobotDescription)
           .at(0, scenegraph::RobotDescription{.format = "urdf", .text = urdf})
           .build(),
       "map");
  add("/robot");
  drawDown();
  auto result = at(1, 1);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->picked.kind, "link");
  EXPECT_EQ(result->picked.id, "base");
  EXPECT_EQ(field(result->picked, "shape"), "box");
  EXPECT_EQ(field(result->picked, "joint"), "none");
  EXPECT_NEAR(result->picked.point_in_frame.z, 0.5, 1e-7);
  result = at(6, 0);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->picked.id, "wheel");
  EXPECT_EQ(field(result->picked, "joint"), "axle");
  EXPECT_EQ(result->frame, "base") << "placed by its joint";

  scene_->removeLayer("/robot");
  add("tf", {{"axis_length", "2"}});
  drawDown();
  result = at(1, 0);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->picked.kind, "frame");
  EXPECT_EQ(result->picked.id, "base");
  EXPECT_EQ(field(result->picked, "parent"), "map");
  EXPECT_EQ(field(result->picked, "in_parent_x"), "4e+06");
  EXPECT_EQ(result->point_in_fixed, kMapFromBase.translation);
}

/// Whatever the type: what its layer draws can be picked, and what is said of it lies where it is drawn.
class EveryLayerPicks : public PickTest, public testing::WithParamInterface<LayerCase> {};

TEST_P(EveryLayerPicks, DescribesWhatItDraws) {
  const auto types = typesUnderTest();
  const auto type = std::ranges::find(types, GetParam().type, &scenegraph::LayerType::name);
  ASSERT_NE(type, types.end());
  DatasetBuilder builder = atBase();
  if (GetParam().add != nullptr) {
    builder.topic("/data", type->consumes);
    GetParam().add(builder, 1_s, "base", 3);
  }
  open(builder.build(), "map");
  const auto& layer = add(GetParam().add != nullptr ? "/data" : std::string(type->name));
  scene_->update(tf::TimePoint{1_s});
  const osg::BoundingBoxd box = layer.boundsInFixed();
  if (type->name == "grid") {
    EXPECT_FALSE(box.valid()) << "mere reference: not picked, see PickPass";
    return;
  }
  ASSERT_TRUE(box.valid());
  const double reach = std::max(0.5, 0.6 * (box._max - box._min).length());
  const glm::dvec3 middle(box.center().x(), box.center().y(), box.center().z());
  const scenegraph::CameraView view{
      .eye_from_fixed = scenegraph::lookAt(middle + reach * glm::dvec3(1.5, -2.0, 2.0), middle, {0, 0, 1}),
      .vertical_fov_rad = 0.6};
  draw(1_s, view);
  int found = 0;
  std::set<std::string> ids;
  for (int y = 2; y < 200; y += 6) {
    for (int x = 2; x < 200; x += 6) {
      const auto hits = renderer_->pick(x, y, 4);
      const auto result = scenegraph::describeHits(*scene_, hits);
      ASSERT_TRUE(result || hits.empty()) << "drawn and not described at " << x << ", " << y;
      if (!result) {
        continue;
      }
      ++found;
      ids.insert(result->picked.id);
      EXPECT_FALSE(result->picked.kind.empty());
      EXPECT_EQ(result->frame, "base");
      const auto at = scenegraph::toScreen(view, {200, 200}, result->point_in_fixed);
      ASSERT_TRUE(at);
      // A cell is known by its middle, a pose and a frame by their origin: those may be some way off.
      const bool is_surface =
          result->picked.kind == "point" || result->picked.kind == "pixel" || result->picked.kind == "link";
      if (is_surface) {
        EXPECT_LT(glm::distance(at->position_px, glm::dvec2(x + 0.5, y + 0.5)), 4.0 + 3.0) << result->picked.id;
      }
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_FALSE(ids.contains(""));
}

INSTANTIATE_TEST_SUITE_P(Types, EveryLayerPicks, testing::ValuesIn(layerCases()),
                         [](const auto& tested) { return std::string(tested.param.type); });

}  // namespace
}  // namespace stillframe::test
