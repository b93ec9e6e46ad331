#include "tools/ingest/wire_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/point_cloud.h"
#include "tests/tools/ingest/ros_samples.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest {
namespace {

using scenegraph::ObjectType;

SchemaRecord schema(std::string name, std::string_view text, std::string encoding = "ros2msg") {
  return {1, std::move(name), std::move(encoding), std::string(text)};
}

MessageView view(const std::vector<std::byte>& bytes) { return {bytes, nullptr, bytes.size(), {0}}; }

ChannelDecoder decoderFor(const SchemaRecord& record, std::string_view encoding = "cdr") {
  auto decoder = makeDecoder(&record, encoding, "/topic");
  EXPECT_EQ(decoder.unsupported_reason, "");
  return decoder;
}

class WireOrder : public testing::TestWithParam<ByteOrder> {};

TEST_P(WireOrder, DecodesTransforms) {
  const auto decoder = decoderFor(schema("tf2_msgs/msg/TFMessage", test::tfDefinition()));
  const auto bytes = test::tfMessage(-1'500'000'000, "//map", "base", 1.25, GetParam());
  const auto object = decoder.decoder->decode(view(bytes));
  ASSERT_TRUE(object) << object.error().message;
  const auto transforms = object->get<scenegraph::FrameTransforms>();
  ASSERT_NE(transforms, nullptr);
  ASSERT_EQ(transforms->transforms.size(), 1u);
  const auto& transform = transforms->transforms[0];
  EXPECT_EQ(transform.stamp.ns, -1'500'000'000);
  EXPECT_EQ(transform.parent_frame_id, "map");
  EXPECT_EQ(transform.child_frame_id, "base");
  EXPECT_EQ(transform.parent_from_child.translation, glm::dvec3(1.25, 2.0, 3.0));
  EXPECT_EQ(transform.parent_from_child.rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

TEST_P(WireOrder, DecodesCloudsWithoutCopying) {
  const auto decoder = decoderFor(schema("sensor_msgs/msg/PointCloud2", test::kCloudDefinition));
  const auto bytes = test::cloudMessage(7, 5, GetParam());
  const auto object = decoder.decoder->decode(view(bytes));
  ASSERT_TRUE(object) << object.error().message;
  const auto cloud = object->get<scenegraph::PointCloud>();
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->stamp.ns, 7);
  EXPECT_EQ(cloud->frame_id, "lidar");
  EXPECT_EQ(cloud->width, 5u);
  EXPECT_EQ(cloud->height, 1u);
  EXPECT_EQ(cloud->point_step, 12u);
  EXPECT_EQ(cloud->row_step, 60u);
  EXPECT_TRUE(cloud->is_dense);
  ASSERT_EQ(cloud->fields.size(), 3u);
  EXPECT_EQ(cloud->fields[2].name, "z");
  EXPECT_EQ(cloud->fields[2].offset, 8u);
  EXPECT_EQ(cloud->fields[2].type, scenegraph::FieldType::Float32);
  ASSERT_EQ(cloud->data.bytes.size(), 60u);
  EXPECT_EQ(cloud->data.bytes[59], std::byte{59});
  EXPECT_GE(cloud->data.bytes.data(), bytes.data());
  EXPECT_LE(cloud->data.bytes.data() + 60, bytes.data() + bytes.size());
}

TEST_P(WireOrder, DecodesCloudsOfWhichOnlyWhatLiesBeforeThePointsIsThere) {
  const auto decoder = decoderFor(schema("sensor_msgs/msg/PointCloud2", test::kCloudDefinition));
  ASSERT_TRUE(decoder.decoder->decodesEarly());
  const auto bytes = test::cloudMessage(7, 5, GetParam());
  const auto whole = decoder.decoder->decode(view(bytes))->get<scenegraph::PointCloud>();
  const auto points_at = static_cast<std::size_t>(whole->data.bytes.data() - bytes.data());
  auto rubbish = bytes;  // in the place of what has not come
  std::fill(rubbish.begin() + static_cast<std::ptrdiff_t>(points_at), rubbish.end(), std::byte{0xFF});
  MessageView arriving = view(rubbish);
  arriving.arrival = std::make_shared<scenegraph::Arrival>();
  arriving.place = 1000;
  const auto object = decoder.decoder->decodeEarly(arriving, points_at);
  ASSERT_TRUE(object);
  const auto cloud = object->get<scenegraph::PointCloud>();
  EXPECT_EQ(cloud->frame_id, whole->frame_id);
  EXPECT_EQ(cloud->width, whole->width);
  EXPECT_EQ(cloud->row_step, whole->row_step);
  ASSERT_EQ(cloud->fields.size(), 3u);
  EXPECT_EQ(cloud->fields[2].name, "z");
  EXPECT_EQ(cloud->data.bytes.size(), whole->data.bytes.size());
  EXPECT_EQ(cloud->data.place, 1000 + points_at);
  EXPECT_EQ(cloud->data.arrival, arriving.arrival);
  for (std::size_t there = 0; there < points_at; ++there) {
    EXPECT_FALSE(decoder.decoder->decodeEarly(arriving, there)) << there << " bytes of " << points_at;
  }
}

TEST_P(WireOrder, EveryCutIsTypedAndNamesBytes) {
  const auto decoder = decoderFor(schema("sensor_msgs/msg/PointCloud2", test::kCloudDefinition));
  const auto bytes = test::cloudMessage(7, 5, GetParam());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const auto object = decoder.decoder->decode(view(cut));
    ASSERT_FALSE(object) << size;
    EXPECT_EQ(object.error().code, "TruncatedMessage");
    EXPECT_THAT(object.error().message, testing::HasSubstr(std::to_string(size < 4 ? size : size - 4) + " bytes"));
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, WireOrder, testing::Values(ByteOrder::Little, ByteOrder::Big));

TEST(WirePlan, StepsOverFieldsThatOneDistributionAdds) {
  std::string text = test::tfDefinition();
  text.insert(text.find("string child_frame_id"),
              "uint8 a\nEmpty e\nfloat64[] none\nstring[] names\nInner[2] two\nInner[] more\nwstring w\nuint16 b\n");
  text += "===\nMSG: geometry_msgs/Empty\n===\nMSG: geometry_msgs/Inner\nint8 x\nint64 y\n";
  CdrWriter cdr;
  cdr.length(1).header(5, "map").number(std::uint8_t{1}).number(std::uint8_t{0}).length(0);
  cdr.length(2).string("one").string("");
  for (int i = 0; i < 2; ++i) {
    cdr.number(std::int8_t{1}).number(std::int64_t{2});
  }
  cdr.length(1).number(std::int8_t{1}).number(std::int64_t{2});
  cdr.length(2).number(std::uint32_t{'h'}).number(std::uint32_t{'i'}).number(std::uint16_t{3});
  cdr.string("base");
  for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0}) {
    cdr.number(value);
  }
  const auto decoder = decoderFor(schema("tf2_msgs/TFMessage", text));
  const auto object = decoder.decoder->decode(view(cdr.bytes()));
  ASSERT_TRUE(object) << object.error().message;
  const auto transforms = object->get<scenegraph::FrameTransforms>();
  EXPECT_EQ(transforms->transforms.at(0).child_frame_id, "base");
  EXPECT_EQ(transforms->transforms.at(0).parent_from_child.translation, glm::dvec3(1.0, 2.0, 3.0));
}

TEST(WirePlan, DecodesRos1WithoutPaddingOrTerminators) {
  const std::string text =
      "Header header\nstring child_frame_id\nTransform transform\n===\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\n"
      "string frame_id\n" +
      std::string(
          test::kTransformDefinition.substr(test::kTransformDefinition.find("====\nMSG: geometry_msgs/Transform")));
  std::vector<std::byte> bytes;
  const auto put = [&](const auto& value) {
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  };
  const auto string = [&](std::string_view value) {
    put(static_cast<std::uint32_t>(value.size()));
    for (const char c : value) {
      put(c);
    }
  };
  put(std::uint32_t{9});
  put(std::uint32_t{4'000'000'000u});  // beyond int32: unsigned in ROS 1
  put(std::uint32_t{5});
  string("/odom");
  string("b");
  for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0}) {
    put(value);
  }
  const auto decoder = decoderFor(schema("geometry_msgs/TransformStamped", text, "ros1msg"), "ros1");
  const auto object = decoder.decoder->decode(view(bytes));
  ASSERT_TRUE(object) << object.error().message;
  const auto& transform = object->get<scenegraph::FrameTransforms>()->transforms.at(0);
  EXPECT_EQ(transform.stamp.ns, 4'000'000'000'000'000'005);
  EXPECT_EQ(transform.parent_frame_id, "odom");
  EXPECT_EQ(transform.parent_from_child.translation.z, 3.0);
}

TEST(WirePlan, AcceptsNanosecondsBeyondOneSecond) {
  CdrWriter cdr;
  cdr.length(1).number(std::int32_t{10}).number(std::uint32_t{2'500'000'000u}).string("a").string("b");
  for (int i = 0; i < 7; ++i) {
    cdr.number(1.0);
  }
  const auto decoder = decoderFor(schema("tf2_msgs/TFMessage", test::tfDefinition()));
  const auto object = decoder.decoder->decode(view(cdr.bytes()));
  ASSERT_TRUE(object);
  EXPECT_EQ(object->get<scenegraph::FrameTransforms>()->transforms.at(0).stamp.ns, 12'500'000'000);
}

TEST(WirePlan, RefusesACountThatTheBytesCannotHold) {
  const auto decoder = decoderFor(schema("tf2_msgs/TFMessage", test::tfDefinition()));
  CdrWriter cdr;
  cdr.length(0xFFFFFFFFu).header(1, "a");
  const auto object = decoder.decoder->decode(view(cdr.bytes()));
  ASSERT_FALSE(object);
  EXPECT_EQ(object.error().code, "TruncatedMessage");
  EXPECT_THAT(object.error().message, testing::HasSubstr("transforms"));
}

TEST(WirePlan, EndsAtOnceOnASchemaOfNothingButNothing) {
  // ROS 1: an empty message has no bytes, so that no count of them can run out.
  std::string text = "A[4294967295] a\nstring child_frame_id\n";
  text += "===\nMSG: p/A\nB[4294967295] b\nB[] s\n===\nMSG: p/B\nC[4294967295] c\n===\nMSG: p/C\n";
  const auto definitions = parseDefinitions(DefinitionLanguage::Ros1, "p/Root", text);
  ASSERT_TRUE(definitions) << definitions.error();
  struct Row {
    std::string_view child;
  } row;
  Shape shape;
  shape.field<&Row::child>("child_frame_id");
  const auto plan = WirePlan::compile(*definitions, shape);
  ASSERT_TRUE(plan) << plan.error();
  const std::vector<std::byte> bytes(64);
  EXPECT_FALSE(plan->decode(bytes, &row));
}

TEST(WirePlan, RefusesOtherEncapsulations) {
  auto bytes = test::tfMessage(1, "a", "b", 1.0);
  bytes[1] = std::byte{7};
  const auto decoder = decoderFor(schema("tf2_msgs/TFMessage", test::tfDefinition()));
  const auto object = decoder.decoder->decode(view(bytes));
  ASSERT_FALSE(object);
  EXPECT_EQ(object.error().code, "BadEncapsulation");
}

TEST(MakeDecoder, SaysWhyATopicIsNotDrawn) {
  const auto reason = [](const SchemaRecord& record, std::string_view encoding) {
    return makeDecoder(&record, encoding, "/topic").unsupported_reason;
  };
  using testing::HasSubstr;
  EXPECT_EQ(makeDecoder(nullptr, "cdr", "/topic").unsupported_reason, "it has no schema");
  EXPECT_EQ(reason(schema("std_msgs/msg/Odd", "garbage ("), "cdr"), "schema 'std_msgs/msg/Odd' is not drawable");
  EXPECT_EQ(reason(schema("tf2_msgs/TFMessage", test::tfDefinition()), "wrong_format"),
            "encoding 'wrong_format' is not supported");
  EXPECT_THAT(reason(schema("tf2_msgs/TFMessage", "no(", "ros2msg"), "cdr"), HasSubstr("definition cannot be parsed"));
  EXPECT_THAT(reason(schema("tf2_msgs/TFMessage", "int32 transforms\n"), "cdr"), HasSubstr("'transforms'"));
  EXPECT_THAT(reason(schema("sensor_msgs/PointCloud2", "uint32 width\n"), "cdr"), HasSubstr("header.stamp"));
  EXPECT_THAT(reason(schema("tf2_msgs/TFMessage", test::tfDefinition(), "ros2idl"), "cdr"), HasSubstr("ros2idl"));
}

}  // namespace
}  // namespace stillframe::ingest
