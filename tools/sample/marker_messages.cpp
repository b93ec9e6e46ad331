#include "tools/sample/marker_messages.h"

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kMarkerArray = "visualization_msgs/Marker[] markers\n" STILLFRAME_SEPARATOR
                                          "MSG: visualization_msgs/Marker\n"
                                          "std_msgs/Header header\n"
                                          "string ns\n"
                                          "int32 id\n"
                                          "int32 type\n"
                                          "int32 action\n"
                                          "geometry_msgs/Pose pose\n"
                                          "geometry_msgs/Vector3 scale\n"
                                          "std_msgs/ColorRGBA color\n"
                                          "builtin_interfaces/Duration lifetime\n"
                                          "bool frame_locked\n"
                                          "geometry_msgs/Point[] points\n"
                                          "std_msgs/ColorRGBA[] colors\n"
                                          "string texture_resource\n"
                                          "sensor_msgs/CompressedImage texture\n"
                                          "visualization_msgs/UVCoordinate[] uv_coordinates\n"
                                          "string text\n"
                                          "string mesh_resource\n"
                                          "visualization_msgs/MeshFile mesh_file\n"
                                          "bool mesh_use_embedded_materials\n" STILLFRAME_SEPARATOR
                                          "MSG: geometry_msgs/Vector3\n"
                                          "float64 x\n"
                                          "float64 y\n"
                                          "float64 z\n" STILLFRAME_SEPARATOR
                                          "MSG: std_msgs/ColorRGBA\n"
                                          "float32 r\n"
                                          "float32 g\n"
                                          "float32 b\n"
                                          "float32 a\n" STILLFRAME_SEPARATOR
                                          "MSG: builtin_interfaces/Duration\n"
                                          "int32 sec\n"
                                          "uint32 nanosec\n" STILLFRAME_SEPARATOR
                                          "MSG: sensor_msgs/CompressedImage\n"
                                          "std_msgs/Header header\n"
                                          "string format\n"
                                          "uint8[] data\n" STILLFRAME_SEPARATOR
                                          "MSG: visualization_msgs/UVCoordinate\n"
                                          "float32 u\n"
                                          "float32 v\n" STILLFRAME_SEPARATOR
                                          "MSG: visualization_msgs/MeshFile\n"
                                          "string filename\n"
                                          "uint8[] data\n" STILLFRAME_POSE STILLFRAME_HEADER;

void writeMarker(const Marker& marker, ingest::CdrWriter& cdr) {
  cdr.header(marker.stamp_ns, marker.frame_id).string(marker.ns).number(marker.id);
  cdr.number(static_cast<std::int32_t>(marker.type)).number(std::int32_t{marker.is_deletion ? 2 : 0});
  const auto& [rotation, translation] = marker.pose;
  for (const double value : {translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z,
                             rotation.w, marker.scale.x, marker.scale.y, marker.scale.z}) {
    cdr.number(value);
  }
  for (const float value : marker.rgba) {
    cdr.number(value);
  }
  cdr.stamp(marker.lifetime_ns).number(static_cast<std::uint8_t>(marker.is_frame_locked));
  cdr.length(marker.points.size());
  for (const glm::dvec3& point : marker.points) {
    cdr.number(point.x).number(point.y).number(point.z);
  }
  cdr.length(0).string(marker.texture_resource);  // no colours of points
  cdr.header(0, "").string(marker.texture_png.empty() ? "" : "png").byteSequence(marker.texture_png);
  cdr.length(marker.uvs.size());
  for (const glm::vec2& uv : marker.uvs) {
    cdr.number(uv.x).number(uv.y);
  }
  cdr.string(marker.text).string(marker.mesh_resource).string(marker.mesh_filename).byteSequence(marker.mesh_data);
  cdr.number(std::uint8_t{0});  // a mesh has the marker's colour
}

}  // namespace

Ros2Type markerArrayType() { return {"visualization_msgs/msg/MarkerArray", kMarkerArray}; }

std::vector<std::byte> serializeMarkerArray(std::span<const Marker> markers) {
  ingest::CdrWriter cdr;
  cdr.length(markers.size());
  for (const Marker& marker : markers) {
    writeMarker(marker, cdr);
  }
  return cdr.bytes();
}

}  // namespace stillframe::sample
