// Robots: where their links are, what stands for what is missing, and what the status says.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenegraph/objects/robot_description.h"
#include "tests/nodes/meshes/mesh_files.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"

namespace stillframe::test {
namespace {

using scenegraph::JointStates;
using scenegraph::ObjectType;
using scenegraph::RobotDescription;
using testing::HasSubstr;

const std::string kArm = R"(<robot name="arm"><material name="red"><color rgba="1 0 0 1"/></material>
<material name="green"><color rgba="0 1 0 1"/></material>
<link name="base"><visual><geometry><box size="4 4 1"/></geometry><material name="red"/></visual>
<collision><geometry><box size="6 6 1"/></geometry></collision></link>
<link name="upper"><visual><origin xyz="3 0 0"/><geometry><box size="2 2 1"/></geometry><material name="green"/></visual></link>
<link name="tip"><visual><origin xyz="1 0 0"/><geometry><sphere radius="0.5"/></geometry></visual></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 3"/>
<limit lower="-1.6" upper="1.6" effort="1" velocity="1"/></joint>
<joint name="wrist" type="prismatic"><parent link="upper"/><child link="tip"/><origin xyz="5 0 0"/><axis xyz="0 1 0"/>
<limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="shoulder" multiplier="2" offset="0"/></joint></robot>)";

RobotDescription urdf(const std::string& text) { return {.format = "urdf", .text = text}; }

class RobotModelPicture : public ScenePictureTest {
 protected:
  /// The arm with `base` in the middle of `map`, and whatever else `more` adds.
  template <typename More>
  scenegraph::Layer& show(const std::string& text, More more, const scenegraph::SettingTexts& settings = {}) {
    DatasetBuilder builder;
    builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base");
    more(builder);
    builder.topic("/robot_description", ObjectType::RobotDescription).at(0, urdf(text));
    open(builder.build(), "map");
    return add("/robot_description", settings);
  }
  scenegraph::Layer& show(const std::string& text, const scenegraph::SettingTexts& settings = {}) {
    return show(text, [](DatasetBuilder&) {}, settings);
  }
};

constexpr Bytes3 kNothing{0, 0, 0};

TEST_F(RobotModelPicture, PlacesLinksByTransforms) {
  const auto& layer = show(kArm, [](DatasetBuilder& builder) {
    builder.transform(0, "base", "upper", turn(std::acos(-1.0) / 2)).transform(0, "base", "tip", translate(-6, 0, 0));
  });
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 100, 100), (Bytes3{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 100, 70), (Bytes3{0, 255, 0})) << "turned to +y";
  EXPECT_EQ(pixel(picture, 130, 100), kNothing);
  EXPECT_NE(pixel(picture, 50, 100), kNothing) << "the tip";
  EXPECT_EQ(layer.status(), scenegraph::Status{}) << layer.status().message;
  EXPECT_DOUBLE_EQ(scene_->boundsInFixed().yMax(), 4.0);
  EXPECT_NEAR(scene_->boundsInFixed().xMin(), -5.5, 1e-6);
}

TEST_F(RobotModelPicture, PlacesLinksByJointStatesWhereThereAreNoTransforms) {
  const auto& layer = show(kArm, [](DatasetBuilder& builder) {
    builder.topic("/joint_states", ObjectType::JointStates)
        .at(1_s, JointStates{.stamp = {}, .names = {"shoulder"}, .positions = {std::acos(-1.0) / 2}})
        .at(2_s, JointStates{.stamp = {}, .names = {"shoulder"}, .positions = {-7.0}});
  });
  auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 100, 70), (Bytes3{0, 255, 0}));
  EXPECT_EQ(layer.status().code, "ForwardKinematics") << layer.status().message;
  EXPECT_THAT(layer.status().message, HasSubstr("'/joint_states'"));
  picture = draw(2_s, fromAbove());
  EXPECT_NE(pixel(picture, 99, 130), kNothing) << "clamped to -1.6, not turned to -7";
  EXPECT_THAT(layer.status().message, HasSubstr("2 joints are beyond their limits"));
  draw(500_ms, fromAbove());
  EXPECT_EQ(layer.status().code, "LinksUnplaced");
  EXPECT_EQ(layer.counts()[1].second, 1U) << "the base alone before the first joint state";
}

TEST_F(RobotModelPicture, GathersJointsThatReportApart) {
  const auto& layer = show(kArm, [](DatasetBuilder& builder) {
    builder.topic("/joint_states", ObjectType::JointStates)
        .at(1_s, JointStates{.stamp = {}, .names = {"shoulder"}, .positions = {0.0}})
        .at(1_s + 10_ms, JointStates{.stamp = {}, .names = {"gripper"}, .positions = {0.5}});
  });
  draw(1_s + 10_ms, fromAbove());
  EXPECT_EQ(layer.status().code, "ForwardKinematics") << layer.status().message;
  EXPECT_EQ(layer.counts()[1].second, 3U);
}

TEST_F(RobotModelPicture, NamesTheJointOfWhichTheJointStatesDoNotTellWhateverTheFixedFrame) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "elsewhere", "other");
  builder.topic("/joint_states", ObjectType::JointStates)
      .at(0, JointStates{.stamp = {}, .names = {"of_another_robot"}, .positions = {0.0}});
  builder.topic("/robot_description", ObjectType::RobotDescription).at(0, urdf(kArm));
  open(builder.build(), "base");
  const auto& layer = add("/robot_description");
  draw(1_s, fromAbove());
  EXPECT_EQ(layer.status().code, "LinksUnplaced");
  EXPECT_THAT(layer.status().message, HasSubstr("2 of 3 links have no place"));
  EXPECT_THAT(layer.status().message, HasSubstr("'/joint_states' tells of the joint 'shoulder'"));
}

TEST_F(RobotModelPicture, SaysThatJointsOfWhichNothingTellsStandAtZero) {
  const auto& layer = show(kArm);
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 130, 100), (Bytes3{0, 255, 0}));
  EXPECT_EQ(layer.status().code, "JointsAtZero");
  EXPECT_EQ(layer.status().level, scenegraph::StatusLevel::Info);
}

TEST_F(RobotModelPicture, CollisionShapesAndLinksAreSwitchedAlone) {
  auto& layer = show(kArm, {{"collision", "true"}, {"visual", "false"}, {"collision_color", "#0000ff"}});
  EXPECT_EQ(pixel(draw(1_s, fromAbove()), 128, 128), (Bytes3{0, 0, 255}));
  ASSERT_TRUE(layer.applySettings({{"collision", "false"}, {"visual", "true"}, {"link.base.visible", "false"}}));
  auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 100, 100), kNothing);
  EXPECT_EQ(pixel(picture, 130, 100), (Bytes3{0, 255, 0}));
  ASSERT_TRUE(layer.applySettings({{"link.upper.opacity", "0.5"}}));
  picture = draw(1_s, fromAbove());
  EXPECT_LT(pixel(picture, 130, 100)[1], 240);
  EXPECT_GT(pixel(picture, 130, 100)[1], 60);
  EXPECT_EQ(layer.settings().at("link.upper.opacity"), "0.5");
  ASSERT_TRUE(layer.applySettings({{"link.uper.visible", "false"}}));
  draw(1_s, fromAbove());
  EXPECT_EQ(layer.status().code, "UnknownLink");
  EXPECT_THAT(layer.status().message, HasSubstr("'uper'"));
  ASSERT_TRUE(layer.applySettings({{"link.uper.visible", "true"}}));
  ASSERT_TRUE(layer.applySettings({{"link.upper.opacity", "1"}, {"link.base.visible", "true"}}));
  EXPECT_EQ(pixel(draw(1_s, fromAbove()), 100, 100), (Bytes3{255, 0, 0}));
}

TEST_F(RobotModelPicture, SaysThatARobotHasNoShapes) {
  const auto& layer = show(R"(<robot name="bare"><link name="base"/></robot>)");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "NoVisuals");
  EXPECT_THAT(layer.status().message, HasSubstr("none of its links has a shape"));
}

TEST_F(RobotModelPicture, AMissingMeshLeavesABoxOfTheLinksSizeAndItsName) {
  const auto& layer = show(
      R"(<robot name="r"><link name="base"><visual><geometry><mesh filename="package://gone/part.stl"/></geometry></visual>
<collision><geometry><box size="8 4 1"/></geometry></collision></link></robot>)");
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(layer.status().code, "UnknownPackage");
  EXPECT_THAT(layer.status().message, HasSubstr("link 'base'"));
  EXPECT_THAT(layer.status().message, HasSubstr("package://gone/part.stl"));
  EXPECT_NE(pixel(picture, 138, 100), kNothing);
  EXPECT_EQ(pixel(picture, 100, 125), kNothing);
  EXPECT_DOUBLE_EQ(scene_->boundsInFixed().xMax(), 4.0);
}

TEST_F(RobotModelPicture, MeshesKeepTheirColoursAndTakeMirroredScales) {
  const FilesFolder files;
  files.add("p/package.xml", "<name>p</name>");
  files.add("p/t.mtl", "newmtl red\nKd 0 0 1\n");
  files.add("p/t.obj", "mtllib t.mtl\nv 0 0 0\nv 4 0 0\nv 0 4 0\nusemtl red\nf 1 2 3\n");
  files.add("p/t.stl",
            "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 0 4 "
            "0\nendloop\nendfacet\nendsolid t\n");
  const auto& layer = show(
      R"(<robot name="r"><link name="base"><visual><geometry><mesh filename="package://p/t.obj"/></geometry>
<material name="m"><color rgba="0 1 0 1"/></material></visual><visual><geometry><mesh filename="package://p/t.stl" scale="-1 1 1"/></geometry>
<material name="m"/></visual></link></robot>)",
      {{"package_path", files.path().string()}});
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(layer.status(), scenegraph::Status{}) << layer.status().message;
  EXPECT_EQ(pixel(picture, 110, 90), (Bytes3{0, 0, 255})) << "the file's own material";
  EXPECT_EQ(pixel(picture, 90, 90), (Bytes3{0, 255, 0})) << "the description's, mirrored and lit";
}

TEST_F(RobotModelPicture, DescriptionsThatAreNoneSayWhyAndDrawNothing) {
  const auto& layer = show("<sdf version='1.7'/>");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "SdfUnsupported");
  EXPECT_EQ(layer.status().level, scenegraph::StatusLevel::Error);
}

class GoldenRobot : public RobotModelPicture {};

TEST_F(GoldenRobot, Robot) {
  const auto& layer = show(
      R"(<robot name="r"><material name="steel"><color rgba="0.55 0.6 0.68 1"/></material><material name="glass"><color rgba="0.3 0.7 1 0.5"/></material>
<link name="base"><visual><origin xyz="0 0 0.15"/><geometry><box size="1.2 0.8 0.3"/></geometry><material name="steel"/></visual>
<visual><origin xyz="0.35 0 0.5" rpy="0 0.3 0"/><geometry><capsule radius="0.12" length="0.5"/></geometry><material name="orange"><color rgba="1 0.55 0.1 1"/></material></visual>
<visual><origin xyz="-0.3 0 0.6"/><geometry><sphere radius="0.3"/></geometry><material name="glass"/></visual></link>
<link name="wheel"><visual><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.25" length="0.12"/></geometry><material name="dark"><color rgba="0.2 0.2 0.22 1"/></material></visual></link>
<link name="part"><visual><geometry><mesh filename="package://gone/part.dae"/></geometry></visual></link>
<joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/><origin xyz="0.2 -0.5 0.2"/></joint>
<joint name="mount" type="fixed"><parent link="base"/><child link="part"/><origin xyz="0.9 0.2 0.2"/></joint></robot>)");
  const auto picture =
      draw(1_s, {.eye_from_fixed = scenegraph::lookAt({1.8, -2.2, 1.5}, {0.1, 0, 0.3}, {0, 0, 1})}, 320, 240);
  EXPECT_TRUE(matchesGolden(picture, "robot_model"));
  EXPECT_EQ(layer.status().code, "UnknownPackage");
  EXPECT_GT(drawnPixels(picture), 8000);
  EXPECT_LT(drawnPixels(picture), 8800);
}

}  // namespace
}  // namespace stillframe::test
