// foxglove.Grid and foxglove.VoxelGrid, in protobuf, JSON and ROS.
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/objects/voxel_grid.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::GridMap;
using scenegraph::VoxelGrid;

template <typename Object>
struct PackedCellsRow {
  Object object;
  std::vector<PackedFieldRow> fields;
  std::span<const std::byte> data;
};

template <typename Object>
typename RowDecoder<PackedCellsRow<Object>>::Result convert(PackedCellsRow<Object>& row, const MessageView& payloads) {
  if constexpr (std::is_same_v<Object, GridMap>) {
    row.object.row_count = countOf(row.data.size(), row.object.row_stride);
  } else {
    row.object.slice_count = countOf(row.data.size(), row.object.slice_stride);
  }
  row.object.fields = packedFields(row.fields);
  row.object.data = payloadOf(row.data, payloads);
  return finished(std::move(row.object));
}

}  // namespace

Created foxgloveGrid(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = PackedCellsRow<GridMap>;
  Shape shape;
  shape.field<&Row::object, &GridMap::stamp>("timestamp")
      .field<&Row::object, &GridMap::frame_id>("frame_id")
      .row<&Row::object, &GridMap::origin>("pose", poseShape())
      .field<&Row::object, &GridMap::column_count>("column_count")
      .row<&Row::object, &GridMap::cell_size_m>("cell_size", planarVectorShape())
      .field<&Row::object, &GridMap::row_stride>("row_stride")
      .field<&Row::object, &GridMap::cell_stride>("cell_stride")
      .rows<&Row::fields>("fields", packedFieldShape())
      .field<&Row::data>("data");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<GridMap>);
}

Created foxgloveVoxelGrid(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = PackedCellsRow<VoxelGrid>;
  Shape shape;
  shape.field<&Row::object, &VoxelGrid::stamp>("timestamp")
      .field<&Row::object, &VoxelGrid::frame_id>("frame_id")
      .row<&Row::object, &VoxelGrid::origin>("pose", poseShape())
      .field<&Row::object, &VoxelGrid::row_count>("row_count")
      .field<&Row::object, &VoxelGrid::column_count>("column_count")
      .row<&Row::object, &VoxelGrid::cell_size_m>("cell_size", vectorShape())
      .field<&Row::object, &VoxelGrid::slice_stride>("slice_stride")
      .field<&Row::object, &VoxelGrid::row_stride>("row_stride")
      .field<&Row::object, &VoxelGrid::cell_stride>("cell_stride")
      .rows<&Row::fields>("fields", packedFieldShape())
      .field<&Row::data>("data");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<VoxelGrid>);
}

}  // namespace stillframe::ingest::converters
