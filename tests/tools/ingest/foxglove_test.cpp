// Foxglove's schemas in protobuf and JSON.
#include <gmock/gmock.h>

#include <cmath>

#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/image.h"
#include "scenegraph/objects/laser_scan.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/objects/scene_entities.h"
#include "tests/tools/ingest/decoded.h"
#include "tests/tools/ingest/proto_writer.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest {
namespace {

using scenegraph::AnyObject;
using test::decoded;
using testing::HasSubstr;

// Numbers are shuffled against Foxglove's on purpose: fields go by name.
const std::string kFoxglove = R"(syntax = "proto3";
package foxglove;
import "google/protobuf/timestamp.proto";
message Vector3 { double x = 3; double y = 2; double z = 1; }
message Quaternion { double x = 1; double y = 2; double z = 3; double w = 4; }
message Pose { Vector3 position = 1; Quaternion orientation = 2; }
message Color { double r = 1; double g = 2; double b = 3; double a = 4; }
message PackedElementField { string name = 1; fixed32 offset = 2; NumericType type = 3;
  enum NumericType { UNKNOWN = 0; UINT8 = 1; INT8 = 2; UINT16 = 3; INT16 = 4; UINT32 = 5; INT32 = 6; FLOAT32 = 7; } }
message PointCloud { google.protobuf.Timestamp timestamp = 7; string frame_id = 2; Pose pose = 3;
  fixed32 point_stride = 4; repeated PackedElementField fields = 5; bytes data = 1; string news = 99; }
message LaserScan { google.protobuf.Timestamp timestamp = 1; string frame_id = 2; Pose pose = 3;
  double start_angle = 4; double end_angle = 5; repeated double ranges = 6; repeated double intensities = 7; }
message LinePrimitive { enum Type { STRIP = 0; LOOP = 1; LIST = 2; } Type type = 1; Pose pose = 2;
  double thickness = 3; bool scale_invariant = 4; repeated Vector3 points = 5; Color color = 6;
  repeated Color colors = 7; repeated fixed32 indices = 8; }
message Point3InFrame { google.protobuf.Timestamp timestamp = 1; string frame_id = 2; Vector3 point = 3; }
message Deletion { google.protobuf.Timestamp timestamp = 1; int32 type = 2; string id = 3; }
)";

const std::string kCloudText = R"(timestamp { seconds: -2 nanos: 5 } frame_id: "/lidar"
  pose { position { x: 1 y: 2 z: 3 } orientation { z: 1 } } point_stride: 3
  fields { name: "a" offset: 0 type: UINT8 } fields { name: "b" offset: 1 type: INT16 } data: "abcdef" news: "later")";

TEST(FoxgloveProtobuf, CloudsGoByNameAndAreViews) {
  test::ProtoWriter writer(kFoxglove);
  const auto bytes = writer.message("foxglove.PointCloud", kCloudText);
  const auto cloud = decoded(writer.schema("foxglove.PointCloud"), "protobuf", bytes).get<scenegraph::PointCloud>();
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->stamp.ns, -1'999'999'995);
  EXPECT_EQ(cloud->frame_id, "lidar");
  EXPECT_EQ(cloud->pose.translation, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(cloud->pose.rotation.w, 0.0) << "a number that is left out of a message that is there is 0";
  EXPECT_EQ(cloud->pose.rotation.z, 1.0);
  EXPECT_EQ(cloud->width, 2u);
  EXPECT_EQ(cloud->row_step, 6u);
  ASSERT_EQ(cloud->fields.size(), 2u);
  EXPECT_EQ(cloud->fields[0].type, scenegraph::FieldType::Uint8);
  EXPECT_EQ(cloud->fields[1].type, scenegraph::FieldType::Int16);
  EXPECT_EQ(cloud->color_packing, scenegraph::ColorPacking::RgbaBytes);
  EXPECT_GE(cloud->data.bytes.data(), bytes.data());
  EXPECT_LE(cloud->data.bytes.data() + 6, bytes.data() + bytes.size());
}

TEST(FoxgloveProtobuf, AbsentPosesAreIdentity) {
  test::ProtoWriter writer(kFoxglove);
  const auto bytes = writer.message("foxglove.PointCloud", "point_stride: 0 data: 'abc'");
  const auto cloud = decoded(writer.schema("foxglove.PointCloud"), "protobuf", bytes).get<scenegraph::PointCloud>();
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->pose.rotation.w, 1.0);
  EXPECT_EQ(cloud->width, 1u) << "data in points of no bytes: for the layout to refuse";
}

TEST(FoxgloveProtobuf, PointsInFramesArePosesWithoutARotation) {
  test::ProtoWriter writer(kFoxglove);
  const auto bytes =
      writer.message("foxglove.Point3InFrame", R"(timestamp { seconds: 2 } frame_id: "/tip" point { x: 1 y: 2 z: 3 })");
  const auto poses =
      decoded(writer.schema("foxglove.Point3InFrame"), "protobuf", bytes).get<scenegraph::PosesInFrame>();
  ASSERT_NE(poses, nullptr);
  EXPECT_EQ(poses->kind, scenegraph::PosesKind::Point);
  EXPECT_EQ(poses->frame_id, "tip");
  EXPECT_EQ(poses->stamp.ns, 2'000'000'000);
  ASSERT_EQ(poses->poses.size(), 1u);
  EXPECT_EQ(poses->poses[0].translation, glm::dvec3(1.0, 2.0, 3.0));
}

TEST(FoxgloveProtobuf, ScansGoEvenlyFromStartToEnd) {
  test::ProtoWriter writer(kFoxglove);
  const auto bytes =
      writer.message("foxglove.LaserScan", "start_angle: -1 end_angle: 1 ranges: [1, 2, inf] intensities: [1, 2]");
  const auto scan = decoded(writer.schema("foxglove.LaserScan"), "protobuf", bytes).get<scenegraph::LaserScan>();
  ASSERT_NE(scan, nullptr);
  EXPECT_DOUBLE_EQ(scan->angle_min_rad, -1.0);
  EXPECT_DOUBLE_EQ(scan->angle_increment_rad, 1.0);
  EXPECT_THAT(scan->ranges_m, testing::ElementsAre(1.0, 2.0, HUGE_VAL));
  EXPECT_TRUE(scan->intensities.empty()) << "not one for each range";
  EXPECT_EQ(scan->range_max_m, HUGE_VAL);
}

TEST(FoxgloveProtobuf, EveryCutAndWrongByteIsTypedOrHarmless) {
  test::ProtoWriter writer(kFoxglove);
  const auto schema = writer.schema("foxglove.PointCloud");
  const auto decoder = makeDecoder(&schema, "protobuf", "/topic");
  ASSERT_NE(decoder.decoder, nullptr);
  auto bytes = writer.message("foxglove.PointCloud", kCloudText);
  std::size_t refused = 0;
  const auto check = [&](std::span<const std::byte> view) {
    const auto object = decoder.decoder->decode({view, nullptr, view.size(), {0}});
    if (!object) {
      EXPECT_THAT(object.error().code, testing::AnyOf("TruncatedMessage", "BadMessage"));
      EXPECT_THAT(object.error().message, HasSubstr(std::to_string(view.size()) + " bytes"));
      ++refused;
    }
  };
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    check(std::span(bytes).first(size));
  }
  EXPECT_GT(refused, bytes.size() / 2);
  for (auto& byte : bytes) {
    for (const unsigned bit : {1u, 4u, 128u}) {
      byte ^= static_cast<std::byte>(bit);
      check(bytes);
      byte ^= static_cast<std::byte>(bit);
    }
  }
}

TEST(FoxgloveProtobuf, RefusesWrongDescriptors) {
  test::ProtoWriter writer(kFoxglove);
  const auto reason = [](SchemaRecord schema) { return makeDecoder(&schema, "protobuf", "/topic").unsupported_reason; };
  auto schema = writer.schema("foxglove.PointCloud");
  EXPECT_EQ(reason(schema), "");
  EXPECT_THAT(reason({1, "foxglove.PointCloud", "protobuf", "no descriptors"}), HasSubstr("FileDescriptorSet"));
  EXPECT_THAT(reason({1, "foxglove.Grid", "protobuf", schema.data}), HasSubstr("do not hold 'foxglove.Grid'"));
  EXPECT_THAT(reason({1, "foxglove.PointCloud", "jsonschema", "{}"}), HasSubstr("jsonschema"));
  test::ProtoWriter other("syntax = \"proto3\"; package foxglove; message PointCloud { string timestamp = 1; }");
  EXPECT_THAT(reason(other.schema("foxglove.PointCloud")), HasSubstr("foxglove.PointCloud.timestamp"));
  for (std::size_t size = 0; size < schema.data.size(); size += 7) {  // cuts: a reason or a decoder, never a crash
    static_cast<void>(reason({1, schema.name, "protobuf", schema.data.substr(0, size)}));
  }
}

TEST(FoxgloveProtobuf, BoundsWhatAMessageOfNothingCanBecome) {
  // A scene of entities without content: two bytes each, some hundred in memory.
  test::ProtoWriter writer(R"(syntax = "proto3"; package foxglove; import "google/protobuf/timestamp.proto";
    message Empty {} message Point3InFrame { google.protobuf.Timestamp timestamp = 1; string frame_id = 2; Vector3 point = 3; }
message Deletion { google.protobuf.Timestamp timestamp = 1; int32 type = 2; string id = 3; }
    message Vector3 { double x = 1; double y = 2; double z = 3; }
    message Quaternion { double x = 1; double y = 2; double z = 3; double w = 4; }
    message Pose { Vector3 position = 1; Quaternion orientation = 2; }
    message PosesInFrame { google.protobuf.Timestamp timestamp = 1; string frame_id = 2; repeated Pose poses = 3; })");
  const auto schema = writer.schema("foxglove.PosesInFrame");
  std::vector<std::byte> bytes;
  for (int i = 0; i < 4'000'000; ++i) {
    bytes.push_back(std::byte{0x1A});
    bytes.push_back(std::byte{0});
  }
  const auto decoder = makeDecoder(&schema, "protobuf", "/topic");
  ASSERT_NE(decoder.decoder, nullptr);
  const auto object = decoder.decoder->decode({bytes, nullptr, bytes.size(), {0}});
  ASSERT_FALSE(object);
  EXPECT_EQ(object.error().code, "TooManyElements");
}

/// JSON messages go by names alone: their schema is not read.
AnyObject decodedJson(const std::string& name, std::string_view text) {
  return decoded({1, name, "jsonschema", "{}"}, "json", std::as_bytes(std::span(text)));
}

TEST(FoxgloveJson, Clouds) {
  const auto cloud =
      decodedJson("foxglove.PointCloud",
                  R"({"timestamp":{"sec":3,"nsec":4},"frame_id":"lidar","pose":{"position":{"x":1,"y":0,"z":0},
      "orientation":{"x":0,"y":0,"z":0,"w":1}},"point_stride":3,"fields":[{"name":"a","offset":0,"type":7}],
      "data":"AQIDBAUG"})")
          .get<scenegraph::PointCloud>();
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->stamp.ns, 3'000'000'004);
  EXPECT_EQ(cloud->width, 2u);
  ASSERT_EQ(cloud->data.bytes.size(), 6u);
  EXPECT_EQ(cloud->data.bytes[5], std::byte{6});
  EXPECT_EQ(cloud->fields.at(0).type, scenegraph::FieldType::Float32);
}

TEST(FoxgloveJson, TimesNumbersAndLines) {
  const auto scan =
      decodedJson("foxglove.LaserScan", R"({"timestamp":"2024-02-29T12:00:00.25+01:00","ranges":[1,null,"Infinity"]})")
          .get<scenegraph::LaserScan>();
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(scan->stamp.ns, 1'709'204'400'250'000'000);
  ASSERT_EQ(scan->ranges_m.size(), 3u);
  EXPECT_TRUE(std::isnan(scan->ranges_m[1]));
  EXPECT_EQ(scan->ranges_m[2], HUGE_VAL);
  const auto scene = decodedJson("foxglove.SceneUpdate", R"({"deletions":[{"type":1}],"entities":[{"id":"a",
      "lifetime":{"sec":1,"nsec":5},"lines":[{"type":2,"points":[{"x":1,"y":2,"z":3}]},{"type":3}]}]})")
                         .get<scenegraph::SceneEntities>();
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(scene->steps.size(), 2u);
  EXPECT_TRUE(scene->steps[0].is_deletion) << "deletions come first";
  EXPECT_EQ(scene->entities.at(0).lifetime_ns, 1'000'000'005);
  ASSERT_EQ(scene->entities[0].lines.size(), 1u);
  EXPECT_EQ(scene->entities[0].lines[0].type, scenegraph::LineType::List);
  EXPECT_THAT(scene->faults, testing::ElementsAre(HasSubstr("unknown type 3")));
}

TEST(FoxgloveJson, DamageIsTyped) {
  const SchemaRecord schema{1, "foxglove.PointCloud", "jsonschema", ""};
  const auto decoder = makeDecoder(&schema, "json", "/topic");
  ASSERT_NE(decoder.decoder, nullptr);
  for (const std::string_view text :
       {"", "{", "[]", "nonsense", R"({"point_stride":-1.5})", R"({"point_stride":"3"})", R"({"data":"a"})",
        R"({"data":"@@@@"})", R"({"fields":{}})", R"({"timestamp":"yesterday"})", R"({"timestamp":{"sec":9e18}})",
        R"({"timestamp":{"sec":9223372036854775807}})", R"({"fields":[1]})", R"({"frame_id":7})"}) {
    const auto bytes = std::as_bytes(std::span(text));
    const auto object = decoder.decoder->decode({bytes, nullptr, bytes.size(), {0}});
    ASSERT_FALSE(object) << text;
    EXPECT_EQ(object.error().code, "BadJson") << text;
    EXPECT_THAT(object.error().message, HasSubstr(std::to_string(text.size()) + " bytes"));
  }
}

}  // namespace
}  // namespace stillframe::ingest
