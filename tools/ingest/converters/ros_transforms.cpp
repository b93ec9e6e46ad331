// tf2_msgs/TFMessage, tf/tfMessage and geometry_msgs/TransformStamped.
#include "scenegraph/objects/frame_transforms.h"
#include "tf/transform_buffer.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/ros_decoder.h"

namespace stillframe::ingest::converters {

namespace {

struct TransformRow {
  tf::TimePoint stamp;
  std::string_view parent;
  std::string_view child;
  double tx = 0.0, ty = 0.0, tz = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

struct TransformsRow {
  std::vector<TransformRow> transforms;
};

Shape transformShape() {
  Shape shape;
  shape.field<&TransformRow::stamp>("header.stamp")
      .field<&TransformRow::parent>("header.frame_id")
      .field<&TransformRow::child>("child_frame_id")
      .field<&TransformRow::tx>("transform.translation.x")
      .field<&TransformRow::ty>("transform.translation.y")
      .field<&TransformRow::tz>("transform.translation.z")
      .field<&TransformRow::qx>("transform.rotation.x")
      .field<&TransformRow::qy>("transform.rotation.y")
      .field<&TransformRow::qz>("transform.rotation.z")
      .field<&TransformRow::qw>("transform.rotation.w");
  return shape;
}

void append(const TransformRow& row, scenegraph::FrameTransforms& out) {
  scenegraph::FrameTransform& transform = out.transforms.emplace_back();
  transform.stamp = row.stamp;
  transform.parent_frame_id = tf::stripLeadingSlashes(row.parent);
  transform.child_frame_id = tf::stripLeadingSlashes(row.child);
  transform.parent_from_child.translation = {row.tx, row.ty, row.tz};
  transform.parent_from_child.rotation = glm::dquat(row.qw, row.qx, row.qy, row.qz);
}

}  // namespace

Created rosTransforms(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.rows<&TransformsRow::transforms>("transforms", transformShape());
  return RosDecoder<TransformsRow>::create(schema, message_encoding, shape,
                                           [](const TransformsRow& row, const MessageView&) {
                                             scenegraph::FrameTransforms object;
                                             object.transforms.reserve(row.transforms.size());
                                             for (const TransformRow& transform : row.transforms) {
                                               append(transform, object);
                                             }
                                             return scenegraph::AnyObject::make(std::move(object));
                                           });
}

Created rosTransform(const SchemaRecord& schema, std::string_view message_encoding) {
  return RosDecoder<TransformRow>::create(schema, message_encoding, transformShape(),
                                          [](const TransformRow& row, const MessageView&) {
                                            scenegraph::FrameTransforms object;
                                            append(row, object);
                                            return scenegraph::AnyObject::make(std::move(object));
                                          });
}

}  // namespace stillframe::ingest::converters
