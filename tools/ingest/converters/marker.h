#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scenegraph/objects/scene_entities.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest::converters {

/// visualization_msgs/Marker as sent.
struct MarkerRow {
  tf::TimePoint stamp;
  std::string_view frame_id;
  std::string_view ns;
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  tf::RigidTransform pose;
  glm::dvec3 scale{1.0};
  scenegraph::EntityColor color;
  tf::TimePoint lifetime;
  bool is_frame_locked = false;
  std::vector<glm::dvec3> points;
  std::vector<scenegraph::EntityColor> colors;
  std::vector<glm::vec2> uvs;
  std::string_view texture_resource;
  std::span<const std::byte> texture_data;
  std::string_view text;
  std::string_view mesh_resource;
  std::span<const std::byte> mesh_data;
  std::string_view mesh_filename;
  bool has_embedded_materials = false;
};

/// Appends what a marker does: an entity or a deletion, as a step. One that cannot be drawn becomes an entity without
/// primitives, because it replaces the earlier of its identity all the same, and a fault. One of an unknown action is
/// a fault only.
void appendMarker(MarkerRow& marker, const MessageView& payloads, scenegraph::SceneEntities& out);

}  // namespace stillframe::ingest::converters
