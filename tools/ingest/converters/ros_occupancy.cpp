// nav_msgs/OccupancyGrid and map_msgs/OccupancyGridUpdate.
#include "scenegraph/objects/occupancy_grid.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::OccupancyGrid;
using scenegraph::OccupancyGridUpdate;

template <typename Object>
struct OccupancyRow {
  Object object;
  std::span<const std::byte> data;
};

template <typename Object>
typename RowDecoder<OccupancyRow<Object>>::Result convert(OccupancyRow<Object>& row, const MessageView& payloads) {
  row.object.data = payloadOf(row.data, payloads);
  return finished(std::move(row.object));
}

}  // namespace

Created rosOccupancyGrid(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = OccupancyRow<OccupancyGrid>;
  Shape shape;
  shape.field<&Row::object, &OccupancyGrid::stamp>("header.stamp")
      .field<&Row::object, &OccupancyGrid::frame_id>("header.frame_id")
      .field<&Row::object, &OccupancyGrid::resolution_m>("info.resolution")
      .field<&Row::object, &OccupancyGrid::width>("info.width")
      .field<&Row::object, &OccupancyGrid::height>("info.height")
      .row<&Row::object, &OccupancyGrid::origin>("info.origin", poseShape())
      .field<&Row::data>("data");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<OccupancyGrid>);
}

Created rosOccupancyGridUpdate(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = OccupancyRow<OccupancyGridUpdate>;
  Shape shape;
  shape.field<&Row::object, &OccupancyGridUpdate::stamp>("header.stamp")
      .field<&Row::object, &OccupancyGridUpdate::frame_id>("header.frame_id")
      .field<&Row::object, &OccupancyGridUpdate::x>("x")
      .field<&Row::object, &OccupancyGridUpdate::y>("y")
      .field<&Row::object, &OccupancyGridUpdate::width>("width")
      .field<&Row::object, &OccupancyGridUpdate::height>("height")
      .field<&Row::data>("data");
  return RowDecoder<Row>::create(schema, message_encoding, shape, convert<OccupancyGridUpdate>);
}

}  // namespace stillframe::ingest::converters
