// The host's own protobuf messages (package PJ): top-level fields go by number, whatever they are called.
#include <gmock/gmock.h>

#include "scenegraph/objects/compressed_point_cloud.h"
#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/image.h"
#include "scenegraph/objects/occupancy_grid.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/objects/voxel_grid.h"
#include "tests/tools/ingest/decoded.h"
#include "tests/tools/ingest/proto_writer.h"

namespace stillframe::ingest {
namespace {

using scenegraph::FieldType;
using testing::ElementsAre;

const std::string kHost = R"(syntax = "proto3"; package PJ; import "google/protobuf/timestamp.proto";
message V { double x = 1; double y = 2; double z = 3; }
message V2 { double x = 1; double y = 2; }
message Q { double x = 1; double y = 2; double z = 3; double w = 4; }
message P { V p = 1; Q q = 2; }
message C { double r = 1; double g = 2; double b = 3; double a = 4; }
message F { string n = 1; uint32 o = 2; uint32 t = 3; uint32 c = 4; }
message T { google.protobuf.Timestamp t = 1; string p = 2; string c = 3; V v = 4; Q q = 5; }
message FrameTransforms { repeated T list = 1; }
message PointCloud { google.protobuf.Timestamp a = 1; uint32 b = 2; uint32 c = 3; uint32 d = 4; uint32 e = 5;
  bool f = 6; bool g = 7; repeated F h = 8; bytes i = 9; string j = 10; }
message CompressedPointCloud { google.protobuf.Timestamp a = 1; string b = 2; string c = 3; bytes d = 4; }
message OccupancyGrid { google.protobuf.Timestamp a = 1; string b = 2; P c = 3; double d = 4; uint32 e = 5;
  uint32 f = 6; bytes g = 7; }
message OccupancyGridUpdate { google.protobuf.Timestamp a = 1; string b = 2; sint32 c = 3; int32 d = 4; uint32 e = 5;
  uint32 f = 6; bytes g = 7; }
message VoxelGrid { google.protobuf.Timestamp a = 1; string b = 2; P c = 3; V d = 4; uint32 e = 5; uint32 f = 6;
  uint32 g = 7; uint32 h = 8; uint32 i = 9; uint32 j = 10; repeated F k = 11; bytes l = 12; }
message GridMap { google.protobuf.Timestamp a = 1; string b = 2; P c = 3; V2 d = 4; uint32 e = 5; uint32 f = 6;
  uint32 g = 7; uint32 h = 8; repeated F i = 9; bytes j = 10; }
message Image { google.protobuf.Timestamp a = 1; uint32 b = 2; uint32 c = 3; string d = 4; uint32 e = 5; bool f = 6;
  bytes g = 7; double h = 8; double i = 9; string j = 10; }
message DepthImage { google.protobuf.Timestamp a = 1; uint32 b = 2; uint32 c = 3; string d = 4; bytes e = 5;
  repeated double f = 6; string g = 7; repeated double h = 8; }
message CameraInfo { google.protobuf.Timestamp a = 1; string b = 2; uint32 c = 3; uint32 d = 4; string e = 5;
  repeated double f = 6; repeated double g = 7; repeated double h = 8; repeated double i = 9; }
message PosesInFrame { google.protobuf.Timestamp a = 1; string b = 2; repeated P c = 3; }
message RobotDescription { google.protobuf.Timestamp a = 1; string b = 2; string c = 3; string d = 4; }
message Mesh3D { google.protobuf.Timestamp a = 1; string b = 2; string c = 3; P d = 4; V e = 5; string f = 6;
  bytes g = 7; string h = 8; C i = 9; bool j = 10; }
message Vec { double x = 1; double y = 2; double z = 3; }
message Quat { double x = 1; double y = 2; double z = 3; double w = 4; }
message Pose { Vec position = 1; Quat orientation = 2; }
message Arrow { Pose pose = 1; double shaft_length = 2; double shaft_diameter = 3; double head_length = 4;
  double head_diameter = 5; C color = 6; }
message Box { Pose pose = 1; Vec size = 2; C color = 3; }
message Cylinder { Pose pose = 1; Vec size = 2; double bottom_scale = 3; double top_scale = 4; C color = 5; }
message Line { enum Type { UNKNOWN = 0; STRIP = 1; LOOP = 2; LIST = 3; } Type type = 1; Pose pose = 2;
  double thickness = 3; bool scale_invariant = 4; repeated Vec points = 5; C color = 6; repeated C colors = 7;
  repeated uint32 indices = 8; }
message Triangles { Pose pose = 1; repeated Vec points = 2; C color = 3; repeated C colors = 4;
  repeated uint32 indices = 5; }
message Text { Pose pose = 1; bool billboard = 2; double font_size = 3; bool scale_invariant = 4; C color = 5;
  string text = 6; }
message Axes { Pose pose = 1; double length = 2; double thickness = 3; bool scale_invariant = 4; }
message Entity { google.protobuf.Timestamp timestamp = 1; string frame_id = 2; string id = 3;
  google.protobuf.Timestamp lifetime = 4; bool frame_locked = 5; repeated Arrow arrows = 7; repeated Box cubes = 8;
  repeated Box spheres = 9; repeated Cylinder cylinders = 10; repeated Line lines = 11;
  repeated Triangles triangles = 12; repeated Text texts = 13; repeated Axes axes = 15; }
message Deletion { int32 type = 2; string id = 3; google.protobuf.Timestamp timestamp = 1; }
message SceneEntities { repeated Deletion d = 1; repeated Entity e = 2; }
)";

class HostProtobuf : public testing::Test {
 protected:
  template <typename Object>
  std::shared_ptr<const Object> read(const std::string& type, const std::string& text) {
    bytes_ = writer_.message("PJ." + type, text);
    auto object = test::decoded(writer_.schema("PJ." + type), "protobuf", bytes_).get<Object>();
    EXPECT_NE(object, nullptr) << type;
    return object != nullptr ? object : std::make_shared<const Object>();
  }
  static std::string text(const scenegraph::Payload& payload) {
    return {reinterpret_cast<const char*>(payload.bytes.data()), payload.bytes.size()};
  }
  test::ProtoWriter writer_{kHost};
  std::vector<std::byte> bytes_;
};

TEST_F(HostProtobuf, FrameTransforms) {
  const auto object = read<scenegraph::FrameTransforms>(
      "FrameTransforms",
      "list { t { seconds: 2 nanos: 7 } p: '/map' c: '/base' v { x: 1 y: 2 z: 3 } q { z: 1 } }"
      "list { p: 'base' c: 'arm' q { w: 1 } }");
  ASSERT_EQ(object->transforms.size(), 2u);
  EXPECT_EQ(object->transforms[0].stamp.ns, 2'000'000'007);
  EXPECT_EQ(object->transforms[0].parent_frame_id, "map");
  EXPECT_EQ(object->transforms[0].child_frame_id, "base");
  EXPECT_EQ(object->transforms[0].parent_from_child.translation, glm::dvec3(1, 2, 3));
  EXPECT_EQ(object->transforms[0].parent_from_child.rotation.z, 1.0);
  EXPECT_EQ(object->transforms[1].child_frame_id, "arm");
}

TEST_F(HostProtobuf, PointCloudWithNumbersOfTypesAsRosHasThem) {
  const auto object =
      read<scenegraph::PointCloud>("PointCloud",
                                   "a { seconds: 1 } b: 2 c: 1 d: 3 e: 6 f: true g: true h { n: 'x' o: 0 t: 7 c: 1 }"
                                   "h { n: 'rgba' o: 4 t: 6 c: 1 } i: 'abcdef' j: 'lidar'");
  EXPECT_EQ(object->stamp.ns, 1'000'000'000);
  EXPECT_EQ(object->frame_id, "lidar");
  EXPECT_EQ(object->width, 2u);
  EXPECT_EQ(object->height, 1u);
  EXPECT_EQ(object->point_step, 3u);
  EXPECT_EQ(object->row_step, 6u);
  EXPECT_TRUE(object->is_bigendian);
  EXPECT_TRUE(object->is_dense);
  ASSERT_EQ(object->fields.size(), 2u);
  EXPECT_EQ(object->fields[0].type, FieldType::Float32);
  EXPECT_EQ(object->fields[1].name, "rgba");
  EXPECT_EQ(object->fields[1].offset, 4u);
  EXPECT_EQ(object->fields[1].type, FieldType::Uint32);
  EXPECT_EQ(text(object->data), "abcdef");
}

TEST_F(HostProtobuf, CompressedPointCloud) {
  const auto object =
      read<scenegraph::CompressedPointCloud>("CompressedPointCloud", "a { nanos: 5 } b: '/f' c: 'Draco' d: 'blob'");
  EXPECT_EQ(object->stamp.ns, 5);
  EXPECT_EQ(object->frame_id, "f");
  EXPECT_EQ(object->format, "draco");
  EXPECT_EQ(text(object->data), "blob");
}

TEST_F(HostProtobuf, OccupancyGrid) {
  const auto object = read<scenegraph::OccupancyGrid>(
      "OccupancyGrid", "a { seconds: 3 } b: '/map' c { p { y: 2 } q { w: 1 } } d: 0.5 e: 2 f: 1 g: 'ab'");
  EXPECT_EQ(object->stamp.ns, 3'000'000'000);
  EXPECT_EQ(object->frame_id, "map");
  EXPECT_EQ(object->origin.translation.y, 2.0);
  EXPECT_EQ(object->resolution_m, 0.5);
  EXPECT_EQ(object->width, 2u);
  EXPECT_EQ(object->height, 1u);
  EXPECT_EQ(text(object->data), "ab");
}

TEST_F(HostProtobuf, OccupancyGridUpdateLeftOfTheGrid) {
  const auto object =
      read<scenegraph::OccupancyGridUpdate>("OccupancyGridUpdate", "b: 'map' c: -4 d: -7 e: 1 f: 2 g: 'xy'");
  EXPECT_EQ(object->x, -4);
  EXPECT_EQ(object->y, -7);
  EXPECT_EQ(object->width, 1u);
  EXPECT_EQ(object->height, 2u);
  EXPECT_EQ(text(object->data), "xy");
}

TEST_F(HostProtobuf, VoxelGrid) {
  const auto object = read<scenegraph::VoxelGrid>(
      "VoxelGrid",
      "b: 'map' c { p { x: 9 } q { w: 1 } } d { x: 0.1 y: 0.2 z: 0.3 } e: 2 f: 3 g: 4 h: 1 i: 2 j: 6 "
      "k { n: 'v' t: 2 c: 1 } l: 'twentyfour bytes of them'");
  EXPECT_EQ(object->origin.translation.x, 9.0);
  EXPECT_EQ(object->cell_size_m, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_THAT((std::vector{object->column_count, object->row_count, object->slice_count, object->cell_stride,
                           object->row_stride, object->slice_stride}),
              ElementsAre(2, 3, 4, 1, 2, 6));
  EXPECT_EQ(object->fields.at(0).type, FieldType::Uint8);
  EXPECT_EQ(object->data.bytes.size(), 24u);
}

TEST_F(HostProtobuf, GridMap) {
  const auto object =
      read<scenegraph::GridMap>("GridMap",
                                "b: 'map' c { p { z: 1 } q { w: 1 } } d { x: 0.5 y: 0.25 } e: 2 f: 1 g: 4 "
                                "h: 8 i { n: 'elevation' t: 7 c: 1 } j: 'eight by'");
  EXPECT_EQ(object->origin.translation.z, 1.0);
  EXPECT_EQ(object->cell_size_m, glm::dvec2(0.5, 0.25));
  EXPECT_THAT((std::vector{object->column_count, object->row_count, object->cell_stride, object->row_stride}),
              ElementsAre(2, 1, 4, 8));
  EXPECT_EQ(object->fields.at(0).name, "elevation");
  EXPECT_EQ(text(object->data), "eight by");
}

TEST_F(HostProtobuf, Image) {
  const auto object = read<scenegraph::Image>(
      "Image", "a { seconds: 1 } b: 2 c: 1 d: 'mono16' e: 6 f: true g: '123456' h: 0.1 i: 9 j: 'cam'");
  EXPECT_EQ(object->width, 2u);
  EXPECT_EQ(object->height, 1u);
  EXPECT_EQ(object->encoding, "mono16");
  EXPECT_EQ(object->row_step, 6u);
  EXPECT_TRUE(object->is_bigendian);
  EXPECT_EQ(object->frame_id, "cam");
  EXPECT_EQ(object->camera, nullptr);
  EXPECT_EQ(text(object->data), "123456");
}

TEST_F(HostProtobuf, DepthImageBringsItsCamera) {
  const auto object =
      read<scenegraph::Image>("DepthImage",
                              "a { seconds: 4 } b: 2 c: 1 d: '16UC1' e: 'abcd' f: [500, 0, 1, 0, 501, 2,"
                              "0, 0, 1] g: 'plumb_bob' h: [0.1, 0.2, 0, 0, 0]");
  EXPECT_EQ(object->stamp.ns, 4'000'000'000);
  EXPECT_EQ(object->encoding, "16UC1");
  EXPECT_EQ(object->frame_id, "");
  EXPECT_EQ(text(object->data), "abcd");
  ASSERT_NE(object->camera, nullptr);
  EXPECT_EQ(object->camera->width, 2u);
  EXPECT_EQ(object->camera->k[0], 500.0);
  EXPECT_EQ(object->camera->k[5], 2.0);
  EXPECT_EQ(object->camera->distortion_model, "plumb_bob");
  EXPECT_EQ(object->camera->distortion.size(), 5u);
}

TEST_F(HostProtobuf, DepthImageWithHalfAMatrixIsRefused) {
  const auto bytes = writer_.message("PJ.DepthImage", "b: 1 c: 1 d: '16UC1' e: 'ab' f: [500, 0, 1]");
  const SchemaRecord schema = writer_.schema("PJ.DepthImage");
  const auto decoder = makeDecoder(&schema, "protobuf", "/depth");
  ASSERT_NE(decoder.decoder, nullptr);
  const auto object = decoder.decoder->decode({bytes, nullptr, bytes.size(), {0}});
  ASSERT_FALSE(object);
  EXPECT_EQ(object.error().code, "BadCameraInfo");
}

TEST_F(HostProtobuf, CameraInfo) {
  const auto object = read<scenegraph::CameraInfo>(
      "CameraInfo",
      "b: 'cam' c: 640 d: 480 e: 'equidistant' f: [1, 2, 3, 4] g: [5, 0, 6, 0, 7, 8, 0, 0, 1]"
      "h: [1, 0, 0, 0, 1, 0, 0, 0, 1] i: [9, 0, 6, 0, 0, 7, 8, 0, 0, 0, 1, 0]");
  EXPECT_EQ(object->frame_id, "cam");
  EXPECT_EQ(object->width, 640u);
  EXPECT_EQ(object->height, 480u);
  EXPECT_EQ(object->distortion_model, "equidistant");
  EXPECT_THAT(object->distortion, ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(object->k[4], 7.0);
  EXPECT_EQ(object->r[8], 1.0);
  EXPECT_EQ(object->p[0], 9.0);
}

TEST_F(HostProtobuf, PosesInFrame) {
  const auto object = read<scenegraph::PosesInFrame>(
      "PosesInFrame", "a { seconds: 8 } b: '/odom' c { p { x: 1 } q { w: 1 } } c { p { x: 2 } q { z: 1 } }");
  EXPECT_EQ(object->frame_id, "odom");
  ASSERT_EQ(object->poses.size(), 2u);
  EXPECT_EQ(object->poses[1].translation.x, 2.0);
  EXPECT_EQ(object->poses[1].rotation.z, 1.0);
}

TEST_F(HostProtobuf, RobotDescriptionSaysItsFormatOrShowsIt) {
  EXPECT_EQ(read<scenegraph::RobotDescription>("RobotDescription", "b: '/r' c: 'sdf' d: '<sdf/>'")->format, "sdf");
  const auto object = read<scenegraph::RobotDescription>("RobotDescription", "d: '<robot name=\"a\"/>'");
  EXPECT_EQ(object->format, "urdf");
  EXPECT_EQ(object->text, "<robot name=\"a\"/>");
}

TEST_F(HostProtobuf, Mesh3DIsAnEntityWithAModel) {
  const auto scene = read<scenegraph::SceneEntities>(
      "Mesh3D",
      "a { seconds: 1 } b: '/map' c: 'shelf' d { p { z: 2 } q { w: 1 } } e { x: 1 y: 2 z: 3 } f: 'glb'"
      "g: 'data' h: 'package://a/b.glb' i { r: 1 g: 0.5 a: 1 } j: true");
  ASSERT_EQ(scene->entities.size(), 1u);
  ASSERT_EQ(scene->steps.size(), 1u);
  EXPECT_FALSE(scene->steps[0].is_deletion);
  const auto& entity = scene->entities[0];
  EXPECT_EQ(entity.stamp.ns, 1'000'000'000);
  EXPECT_EQ(entity.frame_id, "map");
  EXPECT_EQ(entity.id, "shelf");
  EXPECT_EQ(entity.lifetime_ns, 0);
  ASSERT_EQ(entity.models.size(), 1u);
  const auto& model = entity.models[0];
  EXPECT_EQ(model.pose.translation.z, 2.0);
  EXPECT_EQ(model.scale, glm::dvec3(1, 2, 3));
  EXPECT_EQ(model.media_type, "glb");
  EXPECT_EQ(text(model.data), "data");
  EXPECT_EQ(model.url, "package://a/b.glb");
  EXPECT_EQ(model.color.g, 0.5F);
  EXPECT_TRUE(model.is_color_override);
  EXPECT_EQ(read<scenegraph::SceneEntities>("Mesh3D", "c: 'a' h: 'b.stl'")->entities[0].models[0].scale,
            glm::dvec3(1.0))
      << "a scale that is not sent is one";
}

TEST_F(HostProtobuf, SceneEntitiesCountLineTypesFromOne) {
  const auto scene = read<scenegraph::SceneEntities>(
      "SceneEntities",
      "d { type: 1 id: 'old' } e { frame_id: '/map' id: 'a' lifetime { seconds: 2 }"
      "lines { type: STRIP points { x: 1 } } lines { type: LIST } lines { type: LOOP } lines { }"
      "axes { length: 3 thickness: 0.5 } cubes { size { y: 4 } color { g: 1 } } }");
  ASSERT_EQ(scene->steps.size(), 2u);
  EXPECT_TRUE(scene->steps[0].is_deletion);
  EXPECT_EQ(scene->deletions[0].type, scenegraph::SceneEntityDeletion::Type::All);
  const auto& entity = scene->entities.at(0);
  EXPECT_EQ(entity.frame_id, "map");
  EXPECT_EQ(entity.lifetime_ns, 2'000'000'000);
  std::vector<scenegraph::LineType> types;
  for (const auto& line : entity.lines) {
    types.push_back(line.type);
  }
  using scenegraph::LineType;
  EXPECT_THAT(types, ElementsAre(LineType::Strip, LineType::List, LineType::Loop, LineType::Strip));
  ASSERT_EQ(entity.axes.size(), 1u);
  EXPECT_EQ(entity.axes[0].length, 3.0);
  EXPECT_EQ(entity.cubes.at(0).size.y, 4.0);
}

}  // namespace
}  // namespace stillframe::ingest
