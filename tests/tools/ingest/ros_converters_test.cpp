// What converters of ROS messages do beyond copying fields.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/image.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/objects/voxel_grid.h"
#include "tools/ingest/cdr_writer.h"
#include "tools/ingest/converters/marker.h"
#include "tools/ingest/converters/robot_text.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest {
namespace {

using scenegraph::AnyObject;
using testing::HasSubstr;

const std::string kHeader = "===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";
const std::string kPose =
    "===\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n"
    "===\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "===\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";

std::expected<AnyObject, scenegraph::DecodeError> decoded(const std::string& name, const std::string& definition,
                                                          const CdrWriter& cdr) {
  const SchemaRecord schema{1, name, "ros2msg", definition};
  const auto decoder = makeDecoder(&schema, "cdr", "/topic");
  EXPECT_EQ(decoder.unsupported_reason, "");
  return decoder.decoder->decode({cdr.bytes(), nullptr, 1, {0}});
}

const std::string kGridMap =
    "std_msgs/Header header\nInfo info\nstring[] layers\nArray[] data\nuint16 outer_start_index\nuint16 "
    "inner_start_index\n===\nMSG: p/Info\nfloat64 resolution\ngeometry_msgs/Pose pose\n===\nMSG: p/Array\nLayout "
    "layout\n"
    "float32[] data\n===\nMSG: p/Layout\nDim[] dim\nuint32 data_offset\n===\nMSG: p/Dim\nstring label\nuint32 size\n"
    "uint32 stride\n" +
    kHeader + kPose;

/// One layer of 3 x 2 cells (x, y) whose buffer begins at (outer, inner); values as they lie in the message.
CdrWriter gridMap(std::uint16_t outer, std::uint16_t inner, std::uint32_t rows, const std::vector<float>& values) {
  CdrWriter cdr;
  cdr.header(1, "map").number(0.5);
  for (const double value : {10.0, 20.0, 0.0, 0.0, 0.0, 0.0, 1.0}) {
    cdr.number(value);
  }
  cdr.length(1).string("elevation").length(1);
  cdr.length(2).string("column_index").number(2u).number(6u).string("row_index").number(rows).number(rows).number(0u);
  cdr.length(values.size());
  for (const float value : values) {
    cdr.number(value);
  }
  cdr.number(outer).number(inner);
  return cdr;
}

std::vector<float> cellsOf(const scenegraph::GridMap& map) {
  std::vector<float> cells(map.data.bytes.size() / sizeof(float));
  std::memcpy(cells.data(), map.data.bytes.data(), map.data.bytes.size());
  return cells;
}

TEST(RosGridMap, TurnsAxesAndUnrollsTheRing) {
  // Column-major: column 0 (largest y) holds rows 0..2 (largest x first).
  const auto plain = decoded("grid_map_msgs/GridMap", kGridMap, gridMap(0, 0, 3, {0, 1, 2, 10, 11, 12}));
  ASSERT_TRUE(plain) << plain.error().message;
  const auto map = plain->get<scenegraph::GridMap>();
  EXPECT_EQ(map->column_count, 3u);
  EXPECT_EQ(map->row_count, 2u);
  EXPECT_EQ(map->origin.translation, glm::dvec3(10.0 - 0.75, 20.0 - 0.5, 0.0)) << "corner, not centre";
  EXPECT_THAT(cellsOf(*map), testing::ElementsAre(12, 11, 10, 2, 1, 0)) << "smallest x and y first";
  // The same map with its ring begun elsewhere: buffer index = (index + start) % size.
  const auto rolled = decoded("grid_map_msgs/GridMap", kGridMap, gridMap(1, 1, 3, {12, 10, 11, 2, 0, 1}));
  ASSERT_TRUE(rolled) << rolled.error().message;
  EXPECT_THAT(cellsOf(*rolled->get<scenegraph::GridMap>()), testing::ElementsAre(12, 11, 10, 2, 1, 0));
}

TEST(RosGridMap, RefusesSizesThatTheValuesDoNotHold) {
  for (const auto& cdr : {gridMap(0, 0, 4'000'000'000u, {0, 1}), gridMap(0, 0, 4, {0, 1, 2, 3, 4, 5}),
                          gridMap(3, 0, 3, {0, 1, 2, 10, 11, 12}), gridMap(0, 2, 3, {0, 1, 2, 10, 11, 12})}) {
    const auto object = decoded("grid_map_msgs/GridMap", kGridMap, cdr);
    ASSERT_FALSE(object);
    EXPECT_EQ(object.error().code, "BadGridMap");
  }
}

const std::string kBitGrid =
    "std_msgs/Header header\nuint32[] data\ngeometry_msgs/Point origin\ngeometry_msgs/Point resolutions\nuint32 "
    "size_x\n"
    "uint32 size_y\nuint32 size_z\n" +
    kHeader + kPose;

CdrWriter bitGrid(std::uint32_t size_x, std::uint32_t size_z, const std::vector<std::uint32_t>& columns) {
  CdrWriter cdr;
  cdr.header(1, "map").length(columns.size());
  for (const std::uint32_t column : columns) {
    cdr.number(column);
  }
  for (const double value : {1.0, 2.0, 3.0, 0.1, 0.2, 0.3}) {
    cdr.number(value);
  }
  return cdr.number(size_x).number(1u).number(size_z);
}

TEST(RosVoxelGrid, UnpacksMarkedAndUnknownBits) {
  const auto object = decoded("nav2_msgs/VoxelGrid", kBitGrid, bitGrid(2, 2, {0x00010001u, 0x00000002u}));
  ASSERT_TRUE(object) << object.error().message;
  const auto grid = object->get<scenegraph::VoxelGrid>();
  std::vector<int> bytes;
  for (const std::byte byte : grid->data.bytes) {
    bytes.push_back(std::to_integer<int>(byte));
  }
  // (marked, unknown) of slice 0: column 0 marked, column 1 free; slice 1: column 0 free, column 1 unknown.
  EXPECT_THAT(bytes, testing::ElementsAre(1, 0, 0, 0, 0, 0, 0, 1));
  EXPECT_EQ(grid->slice_stride, 4u);
  EXPECT_EQ(grid->origin.translation, glm::dvec3(1.0, 2.0, 3.0));
}

TEST(RosVoxelGrid, RefusesMoreCellsThanItsColumnsHold) {
  for (const auto& cdr : {bitGrid(2, 17, {1, 2}), bitGrid(3, 2, {1, 2}), bitGrid(0xFFFFFFFFu, 16, {1})}) {
    const auto object = decoded("nav2_msgs/VoxelGrid", kBitGrid, cdr);
    ASSERT_FALSE(object);
    EXPECT_EQ(object.error().code, "BadVoxelGrid");
  }
}

TEST(RosCompressedImage, ReadsTheFormat) {
  const auto image = [](std::string_view format) {
    CdrWriter cdr;
    cdr.header(1, "c").string(format).byteSequence(std::vector<std::byte>(3));
    return decoded("sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n" + kHeader,
                   cdr)
        ->get<scenegraph::Image>();
  };
  EXPECT_EQ(image("jpeg")->encoding, "jpeg");
  EXPECT_EQ(image("rgb8; jpeg compressed bgr8")->encoding, "jpeg");
  EXPECT_EQ(image("rgb8; jpeg compressed bgr8")->compressed_encoding, "rgb8");
  EXPECT_EQ(image("16UC1; compressedDepth png")->encoding, "compressedDepth");
  EXPECT_EQ(image("16UC1; compressedDepth png")->compressed_encoding, "16UC1");
  EXPECT_EQ(image("32FC1; compressedDepth rvl")->encoding, "compressedDepth");
}

scenegraph::SceneEntities sceneOf(converters::MarkerRow marker) {
  scenegraph::SceneEntities scene;
  converters::appendMarker(marker, {{}, nullptr, 1, {0}}, scene);
  return scene;
}

TEST(RosMarker, ArrowsOfTwoPointsGoFromTailToTip) {
  converters::MarkerRow marker;
  marker.ns = "arms";
  marker.id = -5;
  marker.points = {{1.0, 0.0, 0.0}, {1.0, 2.0, 0.0}};
  marker.scale = {0.1, 0.2, 0.0};
  marker.pose.translation = {0.0, 0.0, 7.0};
  const auto scene = sceneOf(marker);
  ASSERT_EQ(scene.entities.size(), 1u);
  EXPECT_EQ(scene.entities[0].id, "4:arms:-5");
  ASSERT_EQ(scene.entities[0].arrows.size(), 1u);
  const auto& arrow = scene.entities[0].arrows[0];
  EXPECT_EQ(arrow.pose.translation, glm::dvec3(1.0, 0.0, 7.0));
  EXPECT_NEAR(glm::distance(arrow.pose.rotation * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(arrow.head_length, 0.23 * 2.0, 1e-12);
  EXPECT_NEAR(arrow.shaft_length, 0.77 * 2.0, 1e-12);
  EXPECT_EQ(arrow.shaft_diameter, 0.1);
  EXPECT_EQ(arrow.head_diameter, 0.2);
  marker.points[1] = {-1.0, 0.0, 0.0};  // against +x
  const auto back = sceneOf(marker);
  EXPECT_NEAR((back.entities[0].arrows[0].pose.rotation * glm::dvec3(1.0, 0.0, 0.0)).x, -1.0, 1e-12);
}

TEST(RosMarker, FaultyOnesReplaceTheEarlierAndDrawNothing) {
  converters::MarkerRow marker;
  marker.points = {{1.0, 0.0, 0.0}};
  auto scene = sceneOf(marker);
  ASSERT_EQ(scene.entities.size(), 1u);
  EXPECT_TRUE(scene.entities[0].arrows.empty());
  EXPECT_THAT(scene.faults, testing::ElementsAre(HasSubstr("exactly one point")));
  marker.action = 1;
  scene = sceneOf(marker);
  EXPECT_TRUE(scene.steps.empty());
  EXPECT_THAT(scene.faults, testing::ElementsAre(HasSubstr("unknown action 1")));
}

TEST(RosMarker, ListsTurnOffsetsWithTheirPoseAndKeepTheQuaternionAsSent) {
  converters::MarkerRow marker;
  marker.type = 6;                                        // CUBE_LIST
  marker.pose.rotation = glm::dquat(0.0, 0.0, 0.0, 2.0);  // half a turn about z, not normalised
  marker.points = {{1.0, 0.0, 0.0}};
  const auto scene = sceneOf(marker);
  ASSERT_EQ(scene.entities[0].cubes.size(), 1u);
  EXPECT_NEAR(scene.entities[0].cubes[0].pose.translation.x, -1.0, 1e-12);
  EXPECT_EQ(scene.entities[0].cubes[0].pose.rotation.z, 2.0);
}

TEST(RosMarker, TrianglesAreScaledAndColoursByTriangleSpread) {
  converters::MarkerRow marker;
  marker.type = 11;
  marker.scale = {2.0, 1.0, 1.0};
  marker.points = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  marker.colors = {{1.0F, 0.0F, 0.0F, 1.0F}};
  const auto scene = sceneOf(marker);
  ASSERT_EQ(scene.entities[0].triangles.size(), 1u);
  EXPECT_EQ(scene.entities[0].triangles[0].points[0].x, 2.0);
  EXPECT_EQ(scene.entities[0].triangles[0].colors.size(), 3u);
}

TEST(RosMarker, TexturesNeedACoordinateForEachPointAndBytesComeWithEmbeddedOnes) {
  converters::MarkerRow marker;
  marker.type = 11;
  marker.points = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  marker.uvs = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
  const std::vector<std::byte> picture(8, std::byte{1});
  marker.texture_data = picture;
  EXPECT_TRUE(sceneOf(marker).entities[0].triangles[0].uvs.empty()) << "no resource: no texture";
  marker.texture_resource = "embedded://poster";
  const auto embedded = sceneOf(marker).entities[0].triangles[0];
  EXPECT_EQ(embedded.uvs.size(), 3u);
  EXPECT_EQ(embedded.texture.bytes.size(), 8u);
  marker.texture_resource = "package://posters/poster.png";
  const auto named = sceneOf(marker).entities[0].triangles[0];
  EXPECT_EQ(named.texture_url, "package://posters/poster.png");
  EXPECT_TRUE(named.texture.bytes.empty());
  marker.uvs.pop_back();
  EXPECT_TRUE(sceneOf(marker).entities[0].triangles[0].uvs.empty());
}

TEST(RosMarker, EmbeddedMeshesTellTheirFormatByTheNameOfTheirFile) {
  converters::MarkerRow marker;
  marker.type = 10;
  const std::vector<std::byte> mesh(8, std::byte{1});
  marker.mesh_resource = "embedded://chair";
  marker.mesh_filename = "chair.v2.obj";
  marker.mesh_data = mesh;
  const auto scene = sceneOf(marker);
  ASSERT_EQ(scene.entities[0].models.size(), 1u);
  EXPECT_EQ(scene.entities[0].models[0].media_type, "obj");
  EXPECT_EQ(scene.entities[0].models[0].data.bytes.size(), 8u);
}

TEST(RosString, IsARobotOnlyWhereTheTopicSaysSo) {
  const SchemaRecord schema{1, "std_msgs/msg/String", "ros2msg", "string data\n"};
  const auto type = [&](std::string_view topic) { return makeDecoder(&schema, "cdr", topic).type; };
  EXPECT_EQ(type("/robot_description"), scenegraph::ObjectType::RobotDescription);
  EXPECT_EQ(type("robot_description"), scenegraph::ObjectType::RobotDescription);
  EXPECT_EQ(type("/a/robot_description"), scenegraph::ObjectType::RobotDescription);
  EXPECT_EQ(type("/chatter"), scenegraph::ObjectType::None);
  EXPECT_EQ(type("/not_robot_description"), scenegraph::ObjectType::None);
  EXPECT_THAT(makeDecoder(&schema, "cdr", "/chatter").unsupported_reason, HasSubstr("robot_description"));
}

TEST(RobotFormat, IsThatOfTheRootElement) {
  using converters::robotFormat;
  EXPECT_EQ(robotFormat("<?xml version='1.0'?>\n<!-- <sdf> -->\n<robot name='r'/>"), "urdf");
  EXPECT_EQ(robotFormat("<sdf version='1.6'>"), "sdf");
  EXPECT_EQ(robotFormat("<!DOCTYPE x><mujoco>"), "mjcf");
  EXPECT_EQ(robotFormat("<robots>"), "");
  EXPECT_EQ(robotFormat("<!-- never closed"), "");
  EXPECT_EQ(robotFormat("hello"), "");
  EXPECT_EQ(robotFormat(""), "");
}

}  // namespace
}  // namespace stillframe::ingest
