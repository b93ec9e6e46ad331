#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <span>

#include "nodes/markers/markers_settings.h"
#include "scenegraph/objects/scene_entities.h"
#include "tests/nodes/markers/marker_builder.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using scenegraph::LineType;
using scenegraph::ObjectType;
using scenegraph::SceneEntities;
using scenegraph::SceneEntity;
using testing::HasSubstr;

constexpr scenegraph::Color kBackground{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};

/// One of everything, in rows.
SceneEntities everything() {
  SceneEntity all = entityIn("base", "all", "kinds");
  all.cubes.push_back({.pose = turn(0.5, -6, 4, 0.7), .size = {1.4, 1.4, 1.4}, .color = kRed});
  all.spheres.push_back({.pose = at(-3, 4, 0.8), .size = {1.6, 1.6, 1.6}, .color = {0.2F, 0.5F, 0.9F, 1}});
  all.cylinders.push_back(
      {.pose = at(0, 4, 0.8), .size = {1.4, 1.4, 1.6}, .bottom_scale = 1, .top_scale = 1, .color = {1, 0.8F, 0.2F, 1}});
  all.cylinders.push_back({.pose = at(3, 4, 0.8),
                           .size = {1.6, 1.6, 1.6},
                           .bottom_scale = 1,
                           .top_scale = 0,
                           .color = {0.6F, 0.9F, 0.3F, 1}});
  all.cylinders.push_back({.pose = at(6, 4, 0.8),
                           .size = {1.6, 1.6, 1.6},
                           .bottom_scale = 0.4,
                           .top_scale = 1,
                           .color = {0.8F, 0.4F, 0.9F, 1}});
  all.arrows.push_back({.pose = turn(0.4, -7, 1, 0.4),
                        .shaft_length = 1.5,
                        .shaft_diameter = 0.3,
                        .head_length = 0.6,
                        .head_diameter = 0.7,
                        .color = {1, 0.5F, 0.1F, 1}});
  all.axes.push_back({.pose = turn(0.3, -3, 1), .length = 1.4, .thickness = 0.15});
  for (int i = 0; i < 12; ++i) {
    all.cubes.push_back({.pose = at(-0.7 + 0.5 * (i % 4), 0.6 + 0.5 * (i / 4), 0.2),
                         .size = {0.4, 0.4, 0.4},
                         .color = {static_cast<float>(i) / 11.0F, 0.4F, 0.8F, 1}});
  }
  all.points.push_back(
      {.pose = at(2.4, 0.5), .width_m = 0.2, .height_m = 0.3, .points = {}, .color = {}, .colors = {}});
  for (int i = 0; i < 20; ++i) {
    all.points[0].points.emplace_back(0.35 * (i % 5), 0.4 * (i / 5), 0.2 * (i % 3));
    all.points[0].colors.push_back({1, static_cast<float>(i) / 19.0F, 0, 1});
  }
  all.triangles.push_back({.pose = at(5.2, 0.5),
                           .points = {{0, 0, 0}, {1.6, 0, 0}, {0.8, 1.4, 1}},
                           .color = {},
                           .colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}},
                           .indices = {}});
  all.triangles.push_back({.pose = at(6.4, 0.5),
                           .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}},
                           .color = {0.9F, 0.9F, 0.5F, 1},
                           .colors = {},
                           .indices = {0, 1, 2, 0, 2, 3}});
  all.lines.push_back({.type = LineType::Strip,
                       .pose = at(-7, -2.5),
                       .thickness = 0.12,
                       .points = {{0, 0, 0}, {1, 1, 0.3}, {2, 0, 0}, {3, 1, 0.3}},
                       .color = kGreen,
                       .colors = {},
                       .indices = {}});
  all.lines.push_back({.type = LineType::Loop,
                       .pose = at(-3.2, -2.5),
                       .thickness = 4,
                       .is_scale_invariant = true,
                       .points = {{0, 0, 0}, {1.5, 0, 0}, {1.5, 1.2, 0}, {0, 1.2, 0}},
                       .color = {},
                       .colors = {{1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}, {0, 0.4F, 1, 1}},
                       .indices = {}});
  all.lines.push_back({.type = LineType::List,
                       .pose = at(-1, -2.5),
                       .thickness = 0.08,
                       .points = {{0, 0, 0}, {0, 1.2, 0.6}, {0.5, 0, 0}, {0.5, 1.2, 0.6}, {1, 0, 0}, {1, 1.2, 0.6}},
                       .color = {1, 0.4F, 0.7F, 1},
                       .colors = {},
                       .indices = {}});
  all.spheres.push_back({.pose = at(2, -2, 0.8), .size = {1.8, 1.2, 1.8}, .color = {0.2F, 0.6F, 1, 0.4F}});
  all.spheres.push_back({.pose = at(2, -2, 0.8), .size = {0.8, 0.5, 0.8}, .color = {1, 0.3F, 0.2F, 1}});
  all.texts.push_back({.pose = at(5.6, -1.6, 0.5),
                       .is_billboard = true,
                       .font_size = 0.8,
                       .color = kWhite,
                       .text = "gr\u00fc\u00df\nzwei"});
  all.texts.push_back({.pose = at(0, -4.5, 0.2),
                       .is_billboard = true,
                       .font_size = 15,
                       .is_scale_invariant = true,
                       .color = {1, 0.9F, 0.3F, 1},
                       .text = "15 px \u2192 \u03b1\u03b2"});
  return sceneOf({std::move(all)});
}

scenegraph::CameraView fromTheSide(const glm::dvec3& place = {0, 0, 0}) {
  return {.eye_from_fixed =
              scenegraph::lookAt(place + glm::dvec3(0.0, -11.0, 9.0), place + glm::dvec3(0, 0.4, 0), {0, 0, 1})};
}

class MarkerPicture : public ScenePictureTest {};

TEST_F(MarkerPicture, ShowsEveryKindOfPrimitive) {
  open(datasetOf(everything()), "map");
  const auto& layer = add("/markers");
  scene_->update(tf::TimePoint{1_s});
  const auto picture = draw(1_s, fromTheSide(), 320, 240);
  EXPECT_TRUE(matchesGolden(picture, "markers", {.pixels = 0.01}));
  EXPECT_THAT(drawnPixels(picture), testing::AllOf(testing::Ge(7700), testing::Le(8200)));
  EXPECT_EQ(layer.status(), scenegraph::Status{}) << layer.status().message;
  const auto counts = layer.counts();
  EXPECT_EQ(counts[0], (std::pair<std::string, std::uint64_t>{"entities", 1}));
  EXPECT_EQ(counts[1].second, 13U + 3U + 3U + 1U + 1U + 20U + 2U + 3U + 2U);
}

TEST_F(MarkerPicture, KeepsColoursOfWhatFacesTheViewer) {
  open(datasetOf(sceneOf({cube("a", -5, 5, kRed), cube("b", 5, 5, kGreen)})), "map");
  add("/markers");
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 50, 50), (Bytes3{204, 51, 26}));
  EXPECT_EQ(pixel(picture, 150, 50), (Bytes3{0, 255, 0}));
  EXPECT_EQ(drawnPixels(picture), 800);
}

TEST_F(MarkerPicture, SwitchesNamespacesAndFadesAll) {
  open(datasetOf(sceneOf({cube("one ns", -5, 5, kRed), cube("b", 5, 5, kGreen)})), "map");
  auto& layer = add("/markers");
  draw(1_s, fromAbove());
  ASSERT_TRUE(layer.settings().contains("ns_b"));
  ASSERT_TRUE(layer.settings().contains("ns_one_20ns"));
  ASSERT_TRUE(layer.applySettings({{"ns_one_20ns", "false"}}));
  auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 50, 50), (Bytes3{0, 0, 0}));
  EXPECT_EQ(drawnPixels(picture), 400);
  EXPECT_EQ(layer.counts()[2], (std::pair<std::string, std::uint64_t>{"hidden", 1}));
  ASSERT_TRUE(layer.applySettings({{"ns_one_20ns", "true"}, {"opacity", "0.5"}}));
  picture = draw(1_s, fromAbove());
  EXPECT_NEAR(pixel(picture, 150, 50)[1], 188, 2);
  EXPECT_EQ(drawnPixels(picture), 800);
  EXPECT_FALSE(layer.applySettings({{"ns_b", "perhaps"}}));
  EXPECT_FALSE(layer.applySettings({{"ns_B_zz", "true"}})) << "not a key that any name gives";
}

TEST_F(MarkerPicture, FollowsTheMessagesWhereverTheTickGoes) {
  SceneEntities gone;
  gone.deletions.push_back({.type = scenegraph::SceneEntityDeletion::Type::All,
                            .stamp = {std::numeric_limits<std::int64_t>::max()},
                            .id = "",
                            .marker_namespace = ""});
  gone.steps.push_back({true, 0});
  SceneEntity brief = cube("brief", 0, -5, kGreen);
  brief.lifetime_ns = 500_ms;
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "base")
           .topic("/markers", ObjectType::SceneEntities)
           .at(1_s, sceneOf({cube("a", -5, 5, kRed), brief}))
           .at(2_s, sceneOf({cube("a", 5, 5, kGreen, 4.0)}))
           .at(3_s, std::move(gone))
           .build(),
       "map");
  const auto& layer = add("/markers");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 800);
  EXPECT_EQ(drawnPixels(draw(1'499_ms, fromAbove())), 800);
  EXPECT_EQ(drawnPixels(draw(1'500_ms, fromAbove())), 400);
  EXPECT_EQ(pixel(draw(2_s, fromAbove()), 150, 50), (Bytes3{0, 255, 0}));
  EXPECT_EQ(drawnPixels(draw(3_s, fromAbove())), 0);
  EXPECT_EQ(layer.counts()[0].second, 0U);
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 800);
  EXPECT_EQ(drawnPixels(draw(0, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "NoMessage");
}

TEST_F(MarkerPicture, DrawsAHundredThousandInOneCallAndOneChangeInPlace) {
  std::vector<SceneEntity> many;
  for (int i = 0; i < 100'000; ++i) {
    many.push_back(cube(std::to_string(i), -9.9 + 0.0625 * (i % 316), -9.9 + 0.0625 * (i / 316), kRed, 0.05));
    many.back().marker_namespace = "";
  }
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "base")
           .topic("/markers", ObjectType::SceneEntities)
           .at(1_s, sceneOf(std::move(many)))
           .at(2_s, sceneOf({cube("5", 9.5, 9.5, kGreen, 0.5)}))
           .build(),
       "map");
  const auto& layer = add("/markers");
  scene_->update(tf::TimePoint{1_s});
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{
                                {"entities", 100'000}, {"primitives", 100'000}, {"hidden", 0}, {"draw_calls", 1}}));
  EXPECT_EQ(pixel(draw(2_s, fromAbove()), 195, 5), (Bytes3{0, 255, 0}));
  EXPECT_EQ(layer.counts()[3].second, 1U);
}

TEST_F(MarkerPicture, KeepsToWhatTheDriverTakesInABuffer) {
  std::vector<SceneEntity> many;
  for (int i = 0; i < 50; ++i) {
    many.push_back(cube(std::to_string(i), -9.0 + 0.3 * i, 4, kRed, 0.2));
  }
  SceneEntity line = entityIn("map", "line");
  line.lines.push_back({.type = LineType::Strip,
                        .pose = at(-9, -4),
                        .thickness = 0.5,
                        .points = {},
                        .color = kGreen,
                        .colors = {},
                        .indices = {}});
  for (int i = 0; i < 60; ++i) {
    line.lines[0].points.emplace_back(0.3 * i, 0, 0);
  }
  many.push_back(line);
  open(datasetOf(sceneOf(std::move(many))), "map");
  const auto& layer = add("/markers");
  const int whole = drawnPixels(draw(1_s, fromAbove()));
  ASSERT_EQ(layer.status(), scenegraph::Status{});

  scene_->setBufferTexels(199);
  const int line_alone = drawnPixels(draw(1_s, fromAbove()));
  EXPECT_GT(line_alone, 500);
  EXPECT_LT(line_alone, whole);
  EXPECT_EQ(layer.status().code, "BufferTooLarge");
  EXPECT_THAT(layer.status().message, HasSubstr("its 51 markers need a buffer of 200 texels"));
  EXPECT_THAT(layer.status().message, HasSubstr("this OpenGL driver takes 199"));

  scene_->setBufferTexels(59);
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.counts()[3].second, 0U);
  EXPECT_FALSE(layer.boundsInFixed().valid());

  scene_->setBufferTexels(200);
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), whole);
  EXPECT_EQ(layer.status(), scenegraph::Status{});
}

TEST_F(MarkerPicture, SaysWhyThereIsNothing) {
  SceneEntity brief = cube("brief", 5, 5, kGreen);
  brief.lifetime_ns = 1_s;
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "base")
           .topic("/markers", ObjectType::SceneEntities)
           .at(1_s, sceneOf({brief}))
           .build(),
       "map");
  auto& layer = add("/markers");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 400);
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_THAT(layer.applySettings({{"namespaces", "none"}}).error().message, HasSubstr("ns_NAME for a namespace"));
  ASSERT_TRUE(layer.applySettings({{nodes::namespaceKey("brief"), "false"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "NamespacesHidden");
  EXPECT_EQ(drawnPixels(draw(2_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "NoMarkers");
  EXPECT_THAT(layer.status().message, HasSubstr("deleted or their lifetime has ended"));
}

TEST_F(MarkerPicture, SaysWhatItDoesNotDraw) {
  SceneEntity bad = entityIn("map", "bad");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  bad.cubes.push_back({.pose = at(nan, 0), .size = {1, 1, 1}, .color = {}});
  bad.spheres.push_back({.pose = at(0, 0), .size = {1e300, 1, 1}, .color = {}});
  bad.lines.push_back({.type = LineType::Strip,
                       .pose = {},
                       .thickness = 1,
                       .points = {{0, 0, 0}, {1, 0, 0}},
                       .color = {},
                       .colors = {},
                       .indices = {0, 4'000'000'000U}});
  bad.triangles.push_back(
      {.pose = {}, .points = {{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .color = {}, .colors = {}, .indices = {}});
  bad.texts.push_back({.pose = at(0, nan), .font_size = 1, .color = {}, .text = "\xff\xfe\x80 text"});
  bad.texts.push_back({.pose = at(0, 0), .font_size = HUGE_VAL, .color = {}, .text = "huge"});
  open(datasetOf(sceneOf({bad, cube("good", 5, 5, kGreen)})), "map");
  const auto& layer = add("/markers");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 400);
  EXPECT_EQ(layer.status().code, "PrimitivesLeftOut");
  EXPECT_THAT(layer.status().message, HasSubstr("4 primitives"));
}

TEST_F(MarkerPicture, TrianglesThatAllLieOnALineAreToldAndOneAmongOthersIsNot) {
  SceneEntity flat = entityIn("map", "flat");
  flat.triangles.push_back({.pose = {},
                            .points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 3, 0}, {3, 3, 0}, {3, 3, 0}},
                            .color = kRed,
                            .colors = {},
                            .indices = {}});
  SceneEntity sound = flat;
  sound.triangles.front().points.insert(sound.triangles.front().points.end(), {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  open(datasetOf(sceneOf({flat})), "map");
  const auto& layer = add("/markers");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "PrimitivesLeftOut");
  EXPECT_THAT(layer.status().message, HasSubstr("2 primitives"));
  open(datasetOf(sceneOf({sound})), "map");
  const auto& other = add("/markers");
  EXPECT_GT(drawnPixels(draw(1_s, fromAbove())), 100);
  EXPECT_EQ(other.status().level, scenegraph::StatusLevel::Ok) << other.status().message;
}

TEST_F(MarkerPicture, NamesTheFrameThatCannotBePlacedAndDrawsTheRest) {
  SceneEntity lost = cube("lost", -5, 5, kRed);
  lost.frame_id = "nowhere";
  open(datasetOf(sceneOf({lost, cube("here", 5, 5, kGreen)})), "map");
  const auto& layer = add("/markers");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 400);
  EXPECT_EQ(layer.status().code, "UnknownSource");
  EXPECT_THAT(layer.status().message, HasSubstr("nowhere"));
}

TEST_F(MarkerPicture, SaysWhenAMarkerThatIsNotLockedIsCarriedAlong) {
  SceneEntity loose = cube("loose", 0, 0, kRed);
  loose.frame_id = "base";
  loose.is_frame_locked = false;
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "base")
           .transform(2_s, "map", "base", translate(1, 0, 0))
           .topic("/markers", ObjectType::SceneEntities)
           .at(1_s, sceneOf({loose}))
           .build(),
       "map");
  const auto& layer = add("/markers");
  draw(1_s, fromAbove());
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_EQ(pixel(draw(2_s, fromAbove(1)), 100, 100), (Bytes3{204, 51, 26}));
  EXPECT_EQ(layer.status().code, "NotFrameLocked");
}

TEST_F(MarkerPicture, IsTheSameInAPlainViewer) {
  for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(5e5, 5e6, 120.0)}) {
    open(datasetOf(everything(), {.translation = place}), "map");
    add("/markers", {{"texts", "false"}});
    scene_->update(tf::TimePoint{1_s});
    const auto view = fromTheSide(place);
    const auto ours =
        scenegraph::toBytes(render(scene_->root(), view, {.width = 320, .height = 240, .background = kBackground}));
    const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root());
    ASSERT_TRUE(back.valid());
    const auto differs = difference(ours, drawPlainly(*back, view, 0.1, 100.0, 320, 240, kBackground));
    // What is translucent is blended by us in linear light, by a stock viewer in sRGB bytes: the one sphere.
    EXPECT_LT(differs.beyond_one, 1100U) << "largest " << differs.largest;
  }
}

}  // namespace
}  // namespace stillframe::test
