// foxglove.PosesInFrame, PoseInFrame, Point3InFrame, FrameTransform and FrameTransforms, in protobuf, JSON and ROS.
#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/poses.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::FrameTransform;
using scenegraph::FrameTransforms;
using scenegraph::PosesInFrame;
using tf::RigidTransform;

struct FoxglovePoseRow {
  PosesInFrame object;
  RigidTransform pose;
};

Shape transformShape() {
  Shape shape;
  shape.field<&FrameTransform::stamp>("timestamp")
      .field<&FrameTransform::parent_frame_id>("parent_frame_id")
      .field<&FrameTransform::child_frame_id>("child_frame_id")
      .row<&FrameTransform::parent_from_child, &RigidTransform::translation>("translation", vectorShape())
      .row<&FrameTransform::parent_from_child, &RigidTransform::rotation>("rotation", quaternionShape());
  return shape;
}

RowDecoder<FrameTransforms>::Result convertTransforms(FrameTransforms& object, const MessageView&) {
  for (FrameTransform& transform : object.transforms) {
    transform.parent_frame_id = std::string(tf::stripLeadingSlashes(transform.parent_frame_id));
    transform.child_frame_id = std::string(tf::stripLeadingSlashes(transform.child_frame_id));
  }
  return scenegraph::AnyObject::make(std::move(object));
}

}  // namespace

Created foxglovePoses(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&PosesInFrame::stamp>("timestamp")
      .field<&PosesInFrame::frame_id>("frame_id")
      .rows<&PosesInFrame::poses>("poses", poseShape());
  using Decoder = RowDecoder<PosesInFrame>;
  return Decoder::create(
      schema, message_encoding, shape,
      [](PosesInFrame& object, const MessageView&) -> Decoder::Result { return finished(std::move(object)); });
}

Created foxglovePose(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&FoxglovePoseRow::object, &PosesInFrame::stamp>("timestamp")
      .field<&FoxglovePoseRow::object, &PosesInFrame::frame_id>("frame_id")
      .row<&FoxglovePoseRow::pose>("pose", poseShape());
  using Decoder = RowDecoder<FoxglovePoseRow>;
  return Decoder::create(schema, message_encoding, shape,
                         [](FoxglovePoseRow& row, const MessageView&) -> Decoder::Result {
                           row.object.kind = scenegraph::PosesKind::Single;
                           row.object.poses = {row.pose};
                           return finished(std::move(row.object));
                         });
}

Created foxglovePoint(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&FoxglovePoseRow::object, &PosesInFrame::stamp>("timestamp")
      .field<&FoxglovePoseRow::object, &PosesInFrame::frame_id>("frame_id")
      .row<&FoxglovePoseRow::pose, &RigidTransform::translation>("point", vectorShape());
  using Decoder = RowDecoder<FoxglovePoseRow>;
  return Decoder::create(schema, message_encoding, shape,
                         [](FoxglovePoseRow& row, const MessageView&) -> Decoder::Result {
                           row.object.kind = scenegraph::PosesKind::Point;
                           row.object.poses = {row.pose};
                           return finished(std::move(row.object));
                         });
}

Created foxgloveTransforms(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.rows<&FrameTransforms::transforms>("transforms", transformShape());
  return RowDecoder<FrameTransforms>::create(schema, message_encoding, shape, convertTransforms);
}

Created foxgloveTransform(const SchemaRecord& schema, std::string_view message_encoding) {
  using Decoder = RowDecoder<FrameTransform>;
  return Decoder::create(schema, message_encoding, transformShape(),
                         [](FrameTransform& transform, const MessageView& payloads) -> Decoder::Result {
                           FrameTransforms object;
                           object.transforms.push_back(std::move(transform));
                           return convertTransforms(object, payloads);
                         });
}

}  // namespace stillframe::ingest::converters
