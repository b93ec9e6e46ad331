#include "tools/ingest/converters/marker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "tf/transform_buffer.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::ArrowPrimitive;
using scenegraph::EntityColor;
using scenegraph::LinePrimitive;
using scenegraph::LineType;
using scenegraph::SceneEntity;
using tf::RigidTransform;

/// visualization_msgs/Marker's numbers.
enum MarkerType : std::int32_t {
  Arrow,
  Cube,
  Sphere,
  Cylinder,
  LineStrip,
  LineList,
  CubeList,
  SphereList,
  Points,
  Text,
  Mesh,
  TriangleList,
  ArrowStrip,
};
enum MarkerAction : std::int32_t { Add = 0, Delete = 2, DeleteAll = 3 };

// Proportions of an arrow with a pose (RViz): its shaft and head along x, the head's width against the shaft's.
constexpr double kShaftShare = 0.77;
constexpr double kHeadShare = 0.23;
constexpr double kHeadWidths = 2.0;

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// pose * point with the rotation normalised; all zero stands for none, as RViz reads it.
glm::dvec3 placed(const RigidTransform& pose, const glm::dvec3& point) {
  const double norm = glm::length(pose.rotation);
  return pose.translation + (norm > 0.0 ? (pose.rotation / norm) * point : point);
}

/// The rotation that turns +x into `direction`, which is a unit vector.
glm::dquat rotationFromX(const glm::dvec3& direction) {
  const glm::dvec3 axis(0.0, -direction.z, direction.y);  // x cross direction
  const double w = 1.0 + direction.x;
  if (w < 1e-12) {
    return {0.0, 0.0, 0.0, 1.0};  // half a turn about z
  }
  return glm::normalize(glm::dquat(w, axis.x, axis.y, axis.z));
}

ArrowPrimitive arrowBetween(const MarkerRow& marker, const glm::dvec3& tail, const glm::dvec3& tip,
                            const EntityColor& color) {
  const glm::dvec3 along = tip - tail;
  const double distance = glm::length(along);
  ArrowPrimitive arrow;
  arrow.pose.translation = placed(marker.pose, tail);
  arrow.pose.rotation = distance > 0.0 ? marker.pose.rotation * rotationFromX(along / distance) : marker.pose.rotation;
  arrow.head_length = marker.scale.z == 0.0 ? kHeadShare * distance : std::clamp(marker.scale.z, 0.0, distance);
  arrow.shaft_length = distance - arrow.head_length;
  arrow.shaft_diameter = marker.scale.x;
  arrow.head_diameter = marker.scale.y;
  arrow.color = color;
  return arrow;
}

const EntityColor& colorOf(const MarkerRow& marker, std::size_t point) {
  return marker.colors.empty() ? marker.color : marker.colors[point];
}

/// Why a marker cannot be drawn, half a sentence.
std::optional<std::string> faultOf(const MarkerRow& marker) {
  if (marker.type < Arrow || marker.type > ArrowStrip) {
    return sentence("has the unknown type ", marker.type);
  }
  if (!tf::isFinite(marker.pose) || !isFinite(marker.scale)) {
    return "has a pose or scale that is not finite";
  }
  const auto bad = std::ranges::find_if_not(marker.points, isFinite);
  if (bad != marker.points.end()) {
    return sentence("has a point that is not finite: number ", bad - marker.points.begin());
  }
  const std::size_t points = marker.points.size();
  const auto isOf = [&](auto... types) { return ((marker.type == types) || ...); };
  if (isOf(Arrow, ArrowStrip) && points == 1) {
    return "is an arrow with exactly one point";
  }
  if (isOf(LineList) && points % 2 != 0) {
    return sentence("is a list of lines with ", points, " points, an odd number");
  }
  if (isOf(TriangleList) && points % 3 != 0) {
    return sentence("is a list of triangles with ", points, " points, not a multiple of 3");
  }
  const bool has_colors = isOf(LineStrip, LineList, CubeList, SphereList, Points, TriangleList, ArrowStrip);
  const bool is_by_triangle = isOf(TriangleList) && marker.colors.size() * 3 == points;
  if (has_colors && !marker.colors.empty() && marker.colors.size() != points && !is_by_triangle) {
    return sentence("has ", marker.colors.size(), " colors for ", points, " points");
  }
  if (isOf(Mesh) && marker.mesh_resource.empty() && marker.mesh_data.empty()) {
    return "is a mesh without a resource";
  }
  return std::nullopt;
}

void addArrows(const MarkerRow& marker, SceneEntity& out) {
  if (marker.type == ArrowStrip) {
    for (std::size_t i = 1; i < marker.points.size(); ++i) {
      out.arrows.push_back(arrowBetween(marker, marker.points[i - 1], marker.points[i], colorOf(marker, i - 1)));
    }
  } else if (!marker.points.empty()) {
    out.arrows.push_back(arrowBetween(marker, marker.points[0], marker.points[1], marker.color));
  } else {
    const glm::dvec3& scale = marker.scale;
    const bool is_round = scale.y == scale.z || scale.y == 0.0;
    out.arrows.push_back({marker.pose, kShaftShare * scale.x, scale.y, kHeadShare * scale.x, kHeadWidths * scale.y,
                          marker.color, is_round ? 1.0 : scale.z / scale.y});
  }
}

/// The ending of a file's name, which tells the format of its bytes.
std::string endingOf(std::string_view file) {
  const std::size_t dot = file.rfind('.');
  return dot == std::string_view::npos ? std::string() : std::string(file.substr(dot + 1));
}

void addTriangles(MarkerRow& marker, const MessageView& payloads, SceneEntity& out) {
  scenegraph::TrianglePrimitive& triangles = out.triangles.emplace_back();
  triangles.pose = marker.pose;
  triangles.color = marker.color;
  triangles.points = std::move(marker.points);
  for (glm::dvec3& point : triangles.points) {
    point *= marker.scale;  // RViz scales the vertices
  }
  // As RViz: without as many coordinates as points there is no texture.
  if (!marker.texture_resource.empty() && marker.uvs.size() == triangles.points.size()) {
    triangles.uvs = std::move(marker.uvs);
    triangles.texture_url = marker.texture_resource;
    if (!marker.texture_data.empty() && marker.texture_resource.starts_with("embedded://")) {
      triangles.texture = payloadOf(marker.texture_data, payloads);
    }
  }
  if (marker.colors.size() == triangles.points.size()) {
    triangles.colors = std::move(marker.colors);
  } else {
    for (const EntityColor& color : marker.colors) {
      triangles.colors.insert(triangles.colors.end(), 3, color);
    }
  }
}

template <typename Primitive>
void addList(const MarkerRow& marker, std::vector<Primitive>& out) {
  out.reserve(marker.points.size());
  for (std::size_t i = 0; i < marker.points.size(); ++i) {
    out.push_back({{marker.pose.rotation, placed(marker.pose, marker.points[i])}, marker.scale, colorOf(marker, i)});
  }
}

void addPrimitives(MarkerRow& marker, const MessageView& payloads, SceneEntity& out) {
  switch (marker.type) {
    case Arrow:
    case ArrowStrip:
      addArrows(marker, out);
      break;
    case Cube:
      out.cubes.push_back({marker.pose, marker.scale, marker.color});
      break;
    case Sphere:
      out.spheres.push_back({marker.pose, marker.scale, marker.color});
      break;
    case Cylinder:
      out.cylinders.push_back({marker.pose, marker.scale, 1.0, 1.0, marker.color});
      break;
    case LineStrip:
    case LineList:
      out.lines.push_back({marker.type == LineStrip ? LineType::Strip : LineType::List,
                           marker.pose,
                           marker.scale.x,
                           false,
                           std::move(marker.points),
                           marker.color,
                           std::move(marker.colors),
                           {}});
      break;
    case CubeList:
      addList(marker, out.cubes);
      break;
    case SphereList:
      addList(marker, out.spheres);
      break;
    case Points:
      out.points.push_back({marker.pose, marker.scale.x, marker.scale.y, std::move(marker.points), marker.color,
                            std::move(marker.colors)});
      break;
    case Text:
      out.texts.push_back({marker.pose, true, marker.scale.z, false, marker.color, std::string(marker.text)});
      break;
    case Mesh:
      out.models.push_back({marker.pose, marker.scale, marker.color, !marker.has_embedded_materials,
                            std::string(marker.mesh_resource),
                            marker.mesh_data.empty() ? "" : endingOf(marker.mesh_filename),
                            marker.mesh_data.empty() ? scenegraph::Payload{} : payloadOf(marker.mesh_data, payloads)});
      break;
    case TriangleList:
      addTriangles(marker, payloads, out);
      break;
    default:
      break;
  }
}

}  // namespace

void appendMarker(MarkerRow& marker, const MessageView& payloads, scenegraph::SceneEntities& out) {
  const auto named = [&](const std::string& fault) {
    return sentence("the marker '", marker.ns, "' ", marker.id, " ", fault);
  };
  std::string id = std::to_string(marker.ns.size());
  id.append(1, ':').append(marker.ns).append(1, ':').append(std::to_string(marker.id));
  switch (marker.action) {
    case Add: {
      SceneEntity& entity = out.entities.emplace_back();
      entity.stamp = marker.stamp;
      entity.frame_id = tf::stripLeadingSlashes(marker.frame_id);
      entity.id = std::move(id);
      entity.marker_namespace = marker.ns;
      entity.lifetime_ns = marker.lifetime.ns;
      entity.is_frame_locked = marker.is_frame_locked;
      if (const auto fault = faultOf(marker)) {
        out.faults.push_back(named(*fault));
      } else {
        addPrimitives(marker, payloads, entity);
      }
      out.steps.push_back({false, out.entities.size() - 1});
      return;
    }
    case Delete:
    case DeleteAll: {
      scenegraph::SceneEntityDeletion& deletion = out.deletions.emplace_back();
      const bool is_all = marker.action == DeleteAll;
      deletion.type =
          is_all ? scenegraph::SceneEntityDeletion::Type::All : scenegraph::SceneEntityDeletion::Type::MatchingId;
      deletion.stamp = {std::numeric_limits<std::int64_t>::max()};
      deletion.id = is_all ? "" : std::move(id);  // all means the topic, whatever namespace is named
      out.steps.push_back({true, out.deletions.size() - 1});
      return;
    }
    default:
      out.faults.push_back(named(sentence("has the unknown action ", marker.action)));
  }
}

}  // namespace stillframe::ingest::converters
