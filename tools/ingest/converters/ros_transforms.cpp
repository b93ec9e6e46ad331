// tf2_msgs/TFMessage, tf/tfMessage and geometry_msgs/TransformStamped.
#include "scenegraph/objects/frame_transforms.h"
#include "tf/transform_buffer.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

struct TransformRow {
  tf::TimePoint stamp;
  std::string_view parent;
  std::string_view child;
  tf::RigidTransform parent_from_child;
};

struct TransformsRow {
  std::vector<TransformRow> transforms;
};

Shape transformShape() {
  Shape transform;
  transform.row<&tf::RigidTransform::translation>("translation", vectorShape())
      .row<&tf::RigidTransform::rotation>("rotation", quaternionShape());
  Shape shape;
  shape.field<&TransformRow::stamp>("header.stamp")
      .field<&TransformRow::parent>("header.frame_id")
      .field<&TransformRow::child>("child_frame_id")
      .row<&TransformRow::parent_from_child>("transform", std::move(transform));
  return shape;
}

void append(const TransformRow& row, scenegraph::FrameTransforms& out) {
  scenegraph::FrameTransform& transform = out.transforms.emplace_back();
  transform.stamp = row.stamp;
  transform.parent_frame_id = tf::stripLeadingSlashes(row.parent);
  transform.child_frame_id = tf::stripLeadingSlashes(row.child);
  transform.parent_from_child = row.parent_from_child;
}

}  // namespace

Created rosTransforms(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.rows<&TransformsRow::transforms>("transforms", transformShape());
  return RowDecoder<TransformsRow>::create(
      schema, message_encoding, shape, [](TransformsRow& row, const MessageView&) -> RowDecoder<TransformsRow>::Result {
        scenegraph::FrameTransforms object;
        object.transforms.reserve(row.transforms.size());
        for (const TransformRow& transform : row.transforms) {
          append(transform, object);
        }
        return scenegraph::AnyObject::make(std::move(object));
      });
}

Created rosTransform(const SchemaRecord& schema, std::string_view message_encoding) {
  return RowDecoder<TransformRow>::create(
      schema, message_encoding, transformShape(),
      [](TransformRow& row, const MessageView&) -> RowDecoder<TransformRow>::Result {
        scenegraph::FrameTransforms object;
        append(row, object);
        return scenegraph::AnyObject::make(std::move(object));
      });
}

}  // namespace stillframe::ingest::converters
