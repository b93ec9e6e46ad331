// visualization_msgs/Marker and visualization_msgs/MarkerArray.
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/marker.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

struct MarkersRow {
  std::vector<MarkerRow> markers;
};

Shape uvShape() {
  Shape shape;
  shape.field<&glm::vec2::x>("u").field<&glm::vec2::y>("v");
  return shape;
}

Shape markerShape() {
  Shape shape;
  shape.field<&MarkerRow::stamp>("header.stamp")
      .field<&MarkerRow::frame_id>("header.frame_id")
      .field<&MarkerRow::ns>("ns")
      .field<&MarkerRow::id>("id")
      .field<&MarkerRow::type>("type")
      .field<&MarkerRow::action>("action")
      .row<&MarkerRow::pose>("pose", poseShape())
      .row<&MarkerRow::scale>("scale", vectorShape())
      .row<&MarkerRow::color>("color", colorShape())
      .field<&MarkerRow::lifetime>("lifetime")
      .field<&MarkerRow::is_frame_locked>("frame_locked")
      .optional()
      .rows<&MarkerRow::points>("points", vectorShape())
      .rows<&MarkerRow::colors>("colors", colorShape())
      .field<&MarkerRow::texture_resource>("texture_resource")  // since ROS 2 Humble, as uv_coordinates and mesh_file
      .optional()
      .field<&MarkerRow::texture_data>("texture.data")
      .optional()
      .rows<&MarkerRow::uvs>("uv_coordinates", uvShape())
      .optional()
      .field<&MarkerRow::text>("text")
      .field<&MarkerRow::mesh_resource>("mesh_resource")
      .field<&MarkerRow::mesh_filename>("mesh_file.filename")
      .optional()
      .field<&MarkerRow::mesh_data>("mesh_file.data")
      .optional()
      .field<&MarkerRow::has_embedded_materials>("mesh_use_embedded_materials")
      .optional();
  return shape;
}

}  // namespace

Created rosMarkers(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.rows<&MarkersRow::markers>("markers", markerShape());
  using Decoder = RowDecoder<MarkersRow>;
  return Decoder::create(schema, message_encoding, shape,
                         [](MarkersRow& row, const MessageView& payloads) -> Decoder::Result {
                           scenegraph::SceneEntities scene;
                           scene.payload_bytes = payloads.data.size();
                           scene.entities.reserve(row.markers.size());
                           scene.steps.reserve(row.markers.size());
                           for (MarkerRow& marker : row.markers) {
                             appendMarker(marker, payloads, scene);
                           }
                           return scenegraph::AnyObject::make(std::move(scene));
                         });
}

Created rosMarker(const SchemaRecord& schema, std::string_view message_encoding) {
  using Decoder = RowDecoder<MarkerRow>;
  return Decoder::create(schema, message_encoding, markerShape(),
                         [](MarkerRow& marker, const MessageView& payloads) -> Decoder::Result {
                           scenegraph::SceneEntities scene;
                           scene.payload_bytes = payloads.data.size();
                           appendMarker(marker, payloads, scene);
                           return scenegraph::AnyObject::make(std::move(scene));
                         });
}

}  // namespace stillframe::ingest::converters
