#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/objects/scene_entities.h"
#include "tools/ingest/message_decoder.h"
#include "tools/ingest/wire_shape.h"

/// What Foxglove's scene updates and the host's scene entities have in common: everything but the numbers of line
/// types.
namespace stillframe::ingest::converters {

using scenegraph::LineType;

/// A primitive whose line type or bytes are not yet what the object holds.
struct LineRow {
  std::uint32_t type = 0;
  scenegraph::LinePrimitive line;
};
struct ModelRow {
  scenegraph::ModelPrimitive model;
  std::span<const std::byte> data;
};
struct KeyValueRow {
  std::string key, value;
};
struct EntityRow {
  scenegraph::SceneEntity entity;
  tf::TimePoint lifetime;
  std::vector<KeyValueRow> metadata;
  std::vector<LineRow> lines;
  std::vector<ModelRow> models;
};
struct DeletionRow {
  std::uint32_t type = 0;
  scenegraph::SceneEntityDeletion deletion;
};
struct SceneRow {
  std::vector<DeletionRow> deletions;
  std::vector<EntityRow> entities;
};

[[nodiscard]] Shape entityShape();
[[nodiscard]] Shape deletionShape();

/// Deletions first, then entities; `line_types` by the number on the wire. A line or deletion of an unknown type is a
/// fault.
[[nodiscard]] scenegraph::AnyObject sceneFromRow(SceneRow& row, const std::vector<LineType>& line_types,
                                                 const MessageView& payloads);

}  // namespace stillframe::ingest::converters
