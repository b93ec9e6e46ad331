#include "nodes/robots/urdf_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "nodes/robots/urdf_scan.h"

namespace stillframe::nodes {
namespace {

std::string robot(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"r\">" + inside + "</robot>";
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + (more.empty() ? "fixed" : "revolute") + "\"><parent link=\"" +
         parent + "\"/><child link=\"" + child + "\"/>" + more + "</joint>";
}
std::string codeOf(const std::string& text) {
  const auto read = readUrdf(text);
  return read ? "Ok" : read.error().code;
}

TEST(UrdfReader, ReadsShapesMaterialsAndJoints) {
  const auto read = readUrdf(robot(
      R"(<material name="blue"><color rgba="0 0 0.8 0.5"/></material>
<link name="base"><visual><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
<collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision></link>
<link name="arm"><visual><geometry><sphere radius="2"/></geometry></visual>
<visual><geometry><capsule radius="0.25" length="1"/></geometry></visual>
<visual><geometry><mesh filename="package://p/m.stl" scale="1 -1 0.001"/></geometry></visual></link>)" +
      joint("j", "base", "arm", R"(<axis xyz="0 0 5"/><limit lower="-1" upper="2" effort="1" velocity="1"/>)")));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->links.size(), 2U);
  const RobotShape& box = read->links[0].visuals.at(0);
  EXPECT_EQ(box.size, glm::dvec3(1, 2, 3));
  EXPECT_EQ(box.color, (scenegraph::Color{0, 0, 0.8F, 0.5F}));
  EXPECT_LT(glm::length(tf::transformPoint(box.link_from_shape, {1, 0, 0}) - glm::dvec3(1, 3, 3)), 1e-12);
  EXPECT_EQ(read->links[0].collisions.at(0).kind, RobotShapeKind::Cylinder);
  EXPECT_EQ(read->links[0].collisions.at(0).size, glm::dvec3(1, 1, 2));
  const auto& shapes = read->links[1].visuals;
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].kind, RobotShapeKind::Sphere);
  EXPECT_EQ(shapes[1].kind, RobotShapeKind::Capsule);
  EXPECT_EQ(shapes[2].size, glm::dvec3(1, -1, 0.001));
  EXPECT_FALSE(shapes[2].color);
  EXPECT_EQ(read->joints[0].axis, glm::dvec3(0, 0, 1));
  EXPECT_EQ(read->joints[0].limits->upper, 2.0);
  EXPECT_EQ(read->remarks, "");
}

TEST(UrdfReader, RefusesWhatIsNoTreeAndSaysWhere) {
  const std::string links = R"(<link name="a"/><link name="b"/><link name="c"/>)";
  EXPECT_EQ(codeOf(robot(links + joint("1", "a", "b") + joint("2", "b", "c"))), "Ok");
  EXPECT_EQ(codeOf(robot(links + joint("1", "a", "b") + joint("2", "b", "c") + joint("3", "c", "a"))), "UrdfLoop");
  EXPECT_EQ(codeOf(robot(links + joint("1", "b", "c") + joint("2", "c", "b"))), "UrdfLoop");
  EXPECT_EQ(codeOf(robot(links + joint("1", "a", "b"))), "UrdfTwoRoots");
  EXPECT_EQ(codeOf(robot(links + joint("1", "a", "c") + joint("2", "b", "c"))), "UrdfTwoParents");
  EXPECT_EQ(codeOf(robot(links + joint("1", "a", "a") + joint("2", "a", "b") + joint("3", "b", "c"))), "UrdfLoop");
  EXPECT_EQ(codeOf(robot("")), "UrdfNoRoot");
  EXPECT_EQ(codeOf(robot(R"(<link name="a"/>)" + joint("1", "nowhere", "a"))), "UrdfUnknownLink");
  EXPECT_EQ(codeOf(robot(R"(<link neme="a"/><link name="b"/><link name="c"/>)" + joint("1", "", "b"))),
            "UrdfMalformed");
  const auto two = readUrdf(robot(links + joint("1", "a", "b")));
  EXPECT_NE(two.error().message.find("'c'"), std::string::npos) << two.error().message;
}

TEST(UrdfReader, RefusesOtherFormatsAndUnexpandedXacro) {
  EXPECT_EQ(codeOf("<sdf version='1.6'><model name='m'/></sdf>"), "SdfUnsupported");
  EXPECT_EQ(codeOf("<mujoco model='m'/>"), "MjcfUnsupported");
  EXPECT_EQ(codeOf("<html/>"), "NotUrdf");
  EXPECT_EQ(codeOf("no xml at all"), "NotUrdf");
  EXPECT_EQ(codeOf(""), "NotUrdf");
  EXPECT_EQ(codeOf(robot(R"(<xacro:include filename="x"/><link name="a"/>)")), "XacroUnexpanded");
  EXPECT_EQ(codeOf(robot(R"(<link name="${prefix}a"/>)")), "XacroUnexpanded");
  EXPECT_EQ(
      codeOf(
          R"(<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><!-- <xacro:x/> --><link name="a"/></robot>)"),
      "Ok");
}

TEST(UrdfReader, RefusesEntitiesBeforeAnyoneExpandsThem) {
  std::string laughs = "<!DOCTYPE robot [<!ENTITY a \"ha\">";
  for (char c = 'b'; c < 'l'; ++c) {
    laughs += std::string("<!ENTITY ") + c + " \"";
    for (int i = 0; i < 10; ++i) {
      laughs += std::string("&") + static_cast<char>(c - 1) + ";";
    }
    laughs += "\">";
  }
  EXPECT_EQ(codeOf(laughs + "]><robot name=\"&k;\"><link name=\"a\"/></robot>"), "UrdfEntities");
  EXPECT_EQ(codeOf("<!DOCTYPE robot SYSTEM \"file:///etc/passwd\"><robot name=\"r\"><link name=\"a\"/></robot>"), "Ok");
}

TEST(UrdfReader, BoundsDepthAndSize) {
  std::string deep = "<robot name=\"r\"><link name=\"a\"/>";
  for (int i = 0; i < 200'000; ++i) {
    deep += "<x>";
  }
  EXPECT_EQ(codeOf(deep), "UrdfTooLarge");
  EXPECT_EQ(codeOf(robot(std::string(kMaxUrdfBytes, ' '))), "UrdfTooLarge");
  std::string many;
  for (std::size_t i = 0; i <= kMaxRobotLinks; ++i) {
    many += "<link name=\"l" + std::to_string(i) + "\"/>";
  }
  EXPECT_EQ(codeOf(robot(many)), "UrdfTooLarge");
}

TEST(UrdfReader, ALongChainIsReadWithoutRecursion) {
  std::string chain = R"(<link name="l0"/>)";
  for (int i = 1; i < 9'000; ++i) {
    chain += "<link name=\"l" + std::to_string(i) + "\"/>" +
             joint("j" + std::to_string(i), "l" + std::to_string(i - 1), "l" + std::to_string(i));
  }
  const auto read = readUrdf(robot(chain));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->links.size(), 9'000U);
}

TEST(UrdfReader, BrokenTextIsAStatusAndSilent) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const std::string good = robot(R"(<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>)");
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    EXPECT_NE(codeOf(good.substr(0, cut)), "Ok");
  }
  const auto odd =
      readUrdf(robot(R"(<link name="a"><visual><geometry><box size="1 one 1"/></geometry></visual></link>)"));
  EXPECT_TRUE(odd && odd->links[0].visuals.empty() && !odd->remarks.empty());
  EXPECT_EQ(codeOf(robot(R"(<link name="a"/><link name="a"/>)")), "UrdfTwoLinks");
  EXPECT_EQ(codeOf(std::string("\xEF", 1)), "NotUrdf");
  EXPECT_EQ(codeOf(good + std::string("\xEF\0\0", 3)), "Ok");  // TinyXML never ended on these
  EXPECT_EQ(codeOf(robot("\xEF\xBB\x01")), "UrdfNoRoot");
  EXPECT_EQ(::testing::internal::GetCapturedStderr() + ::testing::internal::GetCapturedStdout(), "");
}

TEST(UrdfReader, SizesThatAreNoneLeaveTheirShapeOut) {
  const auto read = readUrdf(robot(
      R"(<link name="a"><visual><geometry><box size="1 0 1"/></geometry></visual><visual><geometry><sphere radius="-1"/></geometry></visual>
<visual><geometry><cylinder radius="1e30" length="1"/></geometry></visual><visual><geometry><sphere radius="1"/></geometry></visual></link>)"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->links[0].visuals.size(), 1U);
  EXPECT_NE(read->remarks.find("link 'a'"), std::string::npos);
}

}  // namespace
}  // namespace stillframe::nodes
