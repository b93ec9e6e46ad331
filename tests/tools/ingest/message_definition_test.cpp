#include "tools/ingest/message_definition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/ingest/ros_samples.h"

namespace stillframe::ingest {
namespace {

using Array = FieldDefinition::Array;

MessageDefinitions parsed(std::string_view text, DefinitionLanguage language = DefinitionLanguage::Ros2) {
  auto definitions = parseDefinitions(language, "pkg/msg/Root", text);
  EXPECT_TRUE(definitions) << definitions.error();
  return definitions ? *definitions : MessageDefinitions{};
}

std::string errorOf(std::string_view text, DefinitionLanguage language = DefinitionLanguage::Ros2) {
  const auto definitions = parseDefinitions(language, "pkg/msg/Root", text);
  return definitions ? "" : definitions.error();
}

TEST(MessageDefinition, ReadsEveryKindOfField) {
  const auto definitions = parsed(
      "int32 plain\nfloat64[] sequence\nuint8[5] fixed\nint16[<=7] bounded\nstring<=10 short\nstring<=10[<=3] shorts\n"
      "wstring wide\nbyte b\nchar c\nbool flag true\nstring text \"a # b\"\nint8[2] both [1, 2]\n");
  const auto& fields = definitions.messages.at(0).fields;
  ASSERT_EQ(fields.size(), 12u);
  EXPECT_EQ(definitions.messages.at(0).name, "pkg/Root");
  EXPECT_EQ(fields[0].type, WireType::Int32);
  EXPECT_EQ(fields[1].array, Array::Sequence);
  EXPECT_EQ(fields[2].array, Array::Fixed);
  EXPECT_EQ(fields[2].length, 5u);
  EXPECT_EQ(fields[3].array, Array::Sequence);
  EXPECT_EQ(fields[4].type, WireType::String);
  EXPECT_EQ(fields[4].array, Array::None);
  EXPECT_EQ(fields[5].array, Array::Sequence);
  EXPECT_EQ(fields[6].type, WireType::WString);
  EXPECT_EQ(fields[7].type, WireType::Uint8);
  EXPECT_EQ(fields[10].name, "text");
  EXPECT_EQ(fields[11].array, Array::Fixed);
}

TEST(MessageDefinition, LeavesOutConstantsAndComments) {
  const auto definitions =
      parsed("# first\nint32 A=1\nstring B = \"x = y\"\n\n  uint8 real # = no constant\nint8 C =-4\r\n");
  ASSERT_EQ(definitions.messages.at(0).fields.size(), 1u);
  EXPECT_EQ(definitions.messages.at(0).fields[0].name, "real");
}

TEST(MessageDefinition, FindsTypesByFullOldShortAndSiblingName) {
  const auto definitions = parsed(
      "other/msg/A a\nother/B b\nSibling s\nHeader header\nbuiltin_interfaces/Time t\n"
      "===\nMSG: other/A\nint8 x\n===\nMSG: other/msg/B\nint8 x\n===\nMSG: pkg/Sibling\nint8 x\n"
      "===\nMSG: std_msgs/Header\nstring frame_id\n");
  const auto& fields = definitions.messages.at(0).fields;
  ASSERT_EQ(fields.size(), 5u);
  const char* expected[] = {"other/A", "other/B", "pkg/Sibling", "std_msgs/Header", "builtin_interfaces/Time"};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(definitions.messages[fields[i].message].name, expected[i]);
  }
}

TEST(MessageDefinition, KnowsTheTimesOfRos1) {
  const auto definitions = parsed("time stamp\nduration[] lasts\n", DefinitionLanguage::Ros1);
  EXPECT_EQ(definitions.messages.at(0).fields[0].type, WireType::Time);
  EXPECT_EQ(definitions.messages.at(0).fields[1].type, WireType::Duration);
}

TEST(MessageDefinition, NamesTheTypeThatIsMissing) {
  EXPECT_THAT(errorOf("other/Gone x\n"), testing::HasSubstr("other/Gone"));
}

TEST(MessageDefinition, RefusesRecursion) {
  EXPECT_THAT(errorOf("Root again\n"), testing::HasSubstr("holds itself"));
  EXPECT_THAT(errorOf("A a\n===\nMSG: pkg/A\nB[] b\n===\nMSG: pkg/B\nA a\n"), testing::HasSubstr("holds itself"));
}

TEST(MessageDefinition, RefusesDeepNesting) {
  std::string text = "T0 f\n";
  for (int i = 0; i < 200; ++i) {
    text += "===\nMSG: pkg/T" + std::to_string(i) + "\nT" + std::to_string(i + 1) + " f\n";
  }
  text += "===\nMSG: pkg/T200\nint8 x\n";
  EXPECT_THAT(errorOf(text), testing::HasSubstr("deep"));
}

TEST(MessageDefinition, RefusesWhatIsNoField) {
  for (const char* line : {"int32", "int32 9lives", "int32[x] a", "int32] a", "int32[99999999999] a", "a/ b", "/a b",
                           "THIS IS@ not", "---\n", "int32[-1] a", "<=3 a", "[] a"}) {
    EXPECT_NE(errorOf(line), "") << line;
  }
}

TEST(MessageDefinition, RefusesWStringInRos1AndEndlessText) {
  EXPECT_NE(errorOf("wstring x\n", DefinitionLanguage::Ros1), "");
  EXPECT_THAT(errorOf(std::string((1 << 20) + 1, '\n')), testing::HasSubstr("bytes"));
}

TEST(MessageDefinition, NormalizesBothStylesOfName) {
  EXPECT_EQ(normalizedTypeName("sensor_msgs/msg/PointCloud2"), "sensor_msgs/PointCloud2");
  EXPECT_EQ(normalizedTypeName("sensor_msgs/PointCloud2"), "sensor_msgs/PointCloud2");
  EXPECT_EQ(normalizedTypeName("foxglove.PointCloud"), "foxglove.PointCloud");
  EXPECT_EQ(normalizedTypeName("a/srv/B"), "a/srv/B");
}

}  // namespace
}  // namespace stillframe::ingest
