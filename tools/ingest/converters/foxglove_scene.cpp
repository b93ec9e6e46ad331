// foxglove.SceneUpdate, in protobuf, JSON and ROS.
#include "scenegraph/objects/scene_entities.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/scene_rows.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

Created foxgloveScene(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.rows<&SceneRow::deletions>("deletions", deletionShape()).rows<&SceneRow::entities>("entities", entityShape());
  return RowDecoder<SceneRow>::create(
      schema, message_encoding, shape, [](SceneRow& row, const MessageView& payloads) -> RowDecoder<SceneRow>::Result {
        return sceneFromRow(row, {LineType::Strip, LineType::Loop, LineType::List}, payloads);
      });
}

}  // namespace stillframe::ingest::converters
