// geometry_msgs/PoseArray, PoseStamped, PoseWithCovarianceStamped, PointStamped, PolygonStamped, nav_msgs/Path and
// nav_msgs/Odometry.
#include <algorithm>

#include "scenegraph/objects/poses.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::PosesInFrame;
using scenegraph::PosesKind;
using tf::RigidTransform;

struct StampedPoseRow {
  tf::TimePoint stamp;
  RigidTransform pose;
};

/// What any of these messages holds; most of it stays empty.
struct PosesRow {
  PosesInFrame object;
  std::vector<StampedPoseRow> path;
  std::vector<glm::dvec3> points;
  RigidTransform pose;
  std::vector<double> covariance;
};

Shape headerShape() {
  Shape shape;
  shape.field<&PosesRow::object, &PosesInFrame::stamp>("header.stamp")
      .field<&PosesRow::object, &PosesInFrame::frame_id>("header.frame_id");
  return shape;
}

template <PosesKind Kind>
RowDecoder<PosesRow>::Result convert(PosesRow& row, const MessageView&) {
  PosesInFrame& object = row.object;
  object.kind = Kind;
  if constexpr (Kind == PosesKind::Path) {
    object.poses.reserve(row.path.size());
    object.stamps.reserve(row.path.size());
    for (const StampedPoseRow& pose : row.path) {
      object.poses.push_back(pose.pose);
      object.stamps.push_back(pose.stamp);
    }
  } else if constexpr (Kind == PosesKind::Polygon) {
    object.poses.resize(row.points.size());
    std::ranges::transform(row.points, object.poses.begin(),
                           [](const glm::dvec3& point) { return RigidTransform{{1.0, 0.0, 0.0, 0.0}, point}; });
  } else if constexpr (Kind != PosesKind::Array) {
    object.poses = {row.pose};
    if (!row.covariance.empty()) {
      std::ranges::copy_n(row.covariance.begin(),
                          static_cast<std::ptrdiff_t>(std::min<std::size_t>(row.covariance.size(), 36)),
                          object.covariance.emplace().begin());
    }
  }
  object.child_frame_id = std::string(tf::stripLeadingSlashes(object.child_frame_id));
  return finished(std::move(object));
}

}  // namespace

Created rosPoseArray(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape = headerShape();
  shape.rows<&PosesRow::object, &PosesInFrame::poses>("poses", poseShape());
  return RowDecoder<PosesRow>::create(schema, message_encoding, shape, convert<PosesKind::Array>);
}

Created rosPath(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape pose;
  pose.field<&StampedPoseRow::stamp>("header.stamp").row<&StampedPoseRow::pose>("pose", poseShape());
  Shape shape = headerShape();
  shape.rows<&PosesRow::path>("poses", std::move(pose));
  return RowDecoder<PosesRow>::create(schema, message_encoding, shape, convert<PosesKind::Path>);
}

Created rosPose(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape = headerShape();
  shape.row<&PosesRow::pose>("pose", poseShape());
  return RowDecoder<PosesRow>::create(schema, message_encoding, shape, convert<PosesKind::Single>);
}

Created rosPoseWithCovariance(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape = headerShape();
  shape.row<&PosesRow::pose>("pose.pose", poseShape())
      .field<&PosesRow::covariance>("pose.covariance")
      .field<&PosesRow::object, &PosesInFrame::child_frame_id>("child_frame_id")  // of nav_msgs/Odometry
      .optional();
  return RowDecoder<PosesRow>::create(schema, message_encoding, shape, convert<PosesKind::Single>);
}

Created rosPoint(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape = headerShape();
  shape.row<&PosesRow::pose, &RigidTransform::translation>("point", vectorShape());
  return RowDecoder<PosesRow>::create(schema, message_encoding, shape, convert<PosesKind::Point>);
}

Created rosPolygon(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape = headerShape();
  shape.rows<&PosesRow::points>("polygon.points", vectorShape());
  return RowDecoder<PosesRow>::create(schema, message_encoding, shape, convert<PosesKind::Polygon>);
}

}  // namespace stillframe::ingest::converters
