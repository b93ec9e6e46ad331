// The host's own protobuf messages (package PJ). Their top-level fields go by number, which is what the host fixes.
#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/occupancy_grid.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/objects/voxel_grid.h"
#include "tools/ingest/converters/compressed_clouds.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/host_shapes.h"
#include "tools/ingest/converters/robot_text.h"
#include "tools/ingest/converters/scene_rows.h"

namespace stillframe::ingest::converters {

namespace {

using namespace scenegraph;  // NOLINT(google-build-using-namespace): every object by its name
using tf::RigidTransform;

struct HostFieldRow {
  PackedField field;
  std::uint32_t type = 0;
};
Shape hostField() {
  Shape shape;
  shape.field<&HostFieldRow::field, &PackedField::name>("1")
      .field<&HostFieldRow::field, &PackedField::offset>("2")
      .field<&HostFieldRow::type>("3")
      .field<&HostFieldRow::field, &PackedField::count>("4");
  return shape;
}

/// An object with packed fields (or none) and bytes.
template <typename Object>
struct HostRow {
  Object object;
  std::vector<HostFieldRow> fields;
  std::span<const std::byte> data;
};

template <typename Object>
typename RowDecoder<HostRow<Object>>::Result convert(HostRow<Object>& row, const MessageView& payloads) {
  if constexpr (requires { row.object.fields; }) {
    for (HostFieldRow& field : row.fields) {
      field.field.type = fieldType(field.type);
      row.object.fields.push_back(std::move(field.field));
    }
  }
  row.object.data = payloadOf(row.data, payloads);
  return finished(std::move(row.object));
}

}  // namespace

Created hostTransforms(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape transform;
  transform.field<&FrameTransform::stamp>("1")
      .field<&FrameTransform::parent_frame_id>("2")
      .field<&FrameTransform::child_frame_id>("3")
      .row<&FrameTransform::parent_from_child, &RigidTransform::translation>("4", hostVector())
      .row<&FrameTransform::parent_from_child, &RigidTransform::rotation>("5", hostQuaternion());
  Shape shape;
  shape.rows<&FrameTransforms::transforms>("1", std::move(transform));
  using Decoder = RowDecoder<FrameTransforms>;
  return Decoder::create(schema, message_encoding, shape,
                         [](FrameTransforms& object, const MessageView&) -> Decoder::Result {
                           for (FrameTransform& one : object.transforms) {
                             one.parent_frame_id = std::string(tf::stripLeadingSlashes(one.parent_frame_id));
                             one.child_frame_id = std::string(tf::stripLeadingSlashes(one.child_frame_id));
                           }
                           return AnyObject::make(std::move(object));
                         });
}

Created hostPointCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = HostRow<PointCloud>;
  Shape shape;
  shape.field<&Row::object, &PointCloud::stamp>("1")
      .field<&Row::object, &PointCloud::width>("2")
      .field<&Row::object, &PointCloud::height>("3")
      .field<&Row::object, &PointCloud::point_step>("4")
      .field<&Row::object, &PointCloud::row_step>("5")
      .field<&Row::object, &PointCloud::is_bigendian>("6")
      .field<&Row::object, &PointCloud::is_dense>("7")
      .rows<&Row::fields>("8", hostField())
      .field<&Row::data>("9")
      .field<&Row::object, &PointCloud::frame_id>("10");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<PointCloud>);
}

Created hostCompressedCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&CompressedCloudRow::cloud, &CompressedPointCloud::stamp>("1")
      .field<&CompressedCloudRow::cloud, &CompressedPointCloud::frame_id>("2")
      .field<&CompressedCloudRow::cloud, &CompressedPointCloud::format>("3")
      .field<&CompressedCloudRow::data>("4");
  return RowDecoder<CompressedCloudRow>::create(schema, message_encoding, shape, compressedCloud);
}

Created hostOccupancyGrid(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = HostRow<OccupancyGrid>;
  Shape shape;
  shape.field<&Row::object, &OccupancyGrid::stamp>("1")
      .field<&Row::object, &OccupancyGrid::frame_id>("2")
      .row<&Row::object, &OccupancyGrid::origin>("3", hostPose())
      .field<&Row::object, &OccupancyGrid::resolution_m>("4")
      .field<&Row::object, &OccupancyGrid::width>("5")
      .field<&Row::object, &OccupancyGrid::height>("6")
      .field<&Row::data>("7");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<OccupancyGrid>);
}

Created hostOccupancyGridUpdate(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = HostRow<OccupancyGridUpdate>;
  Shape shape;
  shape.field<&Row::object, &OccupancyGridUpdate::stamp>("1")
      .field<&Row::object, &OccupancyGridUpdate::frame_id>("2")
      .field<&Row::object, &OccupancyGridUpdate::x>("3")
      .field<&Row::object, &OccupancyGridUpdate::y>("4")
      .field<&Row::object, &OccupancyGridUpdate::width>("5")
      .field<&Row::object, &OccupancyGridUpdate::height>("6")
      .field<&Row::data>("7");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<OccupancyGridUpdate>);
}

Created hostVoxelGrid(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = HostRow<VoxelGrid>;
  Shape shape;
  shape.field<&Row::object, &VoxelGrid::stamp>("1")
      .field<&Row::object, &VoxelGrid::frame_id>("2")
      .row<&Row::object, &VoxelGrid::origin>("3", hostPose())
      .row<&Row::object, &VoxelGrid::cell_size_m>("4", hostVector())
      .field<&Row::object, &VoxelGrid::column_count>("5")
      .field<&Row::object, &VoxelGrid::row_count>("6")
      .field<&Row::object, &VoxelGrid::slice_count>("7")
      .field<&Row::object, &VoxelGrid::cell_stride>("8")
      .field<&Row::object, &VoxelGrid::row_stride>("9")
      .field<&Row::object, &VoxelGrid::slice_stride>("10")
      .rows<&Row::fields>("11", hostField())
      .field<&Row::data>("12");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<VoxelGrid>);
}

Created hostGridMap(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = HostRow<GridMap>;
  Shape shape;
  shape.field<&Row::object, &GridMap::stamp>("1")
      .field<&Row::object, &GridMap::frame_id>("2")
      .row<&Row::object, &GridMap::origin>("3", hostPose())
      .row<&Row::object, &GridMap::cell_size_m>("4", hostPlanarVector())
      .field<&Row::object, &GridMap::column_count>("5")
      .field<&Row::object, &GridMap::row_count>("6")
      .field<&Row::object, &GridMap::cell_stride>("7")
      .field<&Row::object, &GridMap::row_stride>("8")
      .rows<&Row::fields>("9", hostField())
      .field<&Row::data>("10");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<GridMap>);
}

Created hostPoses(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&PosesInFrame::stamp>("1").field<&PosesInFrame::frame_id>("2").rows<&PosesInFrame::poses>("3",
                                                                                                        hostPose());
  using Decoder = RowDecoder<PosesInFrame>;
  return Decoder::create(
      schema, message_encoding, shape,
      [](PosesInFrame& object, const MessageView&) -> Decoder::Result { return finished(std::move(object)); });
}

Created hostRobotDescription(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&RobotDescription::format>("3").field<&RobotDescription::text>("4");
  using Decoder = RowDecoder<RobotDescription>;
  return Decoder::create(schema, message_encoding, shape,
                         [](RobotDescription& robot, const MessageView&) -> Decoder::Result {
                           if (robot.format.empty()) {
                             robot.format = robotFormat(robot.text);
                           }
                           return AnyObject::make(std::move(robot));
                         });
}

Created hostScene(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.rows<&SceneRow::deletions>("1", deletionShape()).rows<&SceneRow::entities>("2", entityShape());
  return RowDecoder<SceneRow>::create(
      schema, message_encoding, shape, [](SceneRow& row, const MessageView& payloads) -> RowDecoder<SceneRow>::Result {
        // Unlike Foxglove the host begins with 0 for an unknown type, which is drawn as a strip.
        return sceneFromRow(row, {LineType::Strip, LineType::Strip, LineType::Loop, LineType::List}, payloads);
      });
}

}  // namespace stillframe::ingest::converters
