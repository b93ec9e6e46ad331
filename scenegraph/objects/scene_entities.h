#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// sRGB-encoded colour with linear alpha, 0..1; out of range or NaN as sent.
struct EntityColor {
  float r = 1.0F;
  float g = 1.0F;
  float b = 1.0F;
  float a = 1.0F;
};

/// Tail at `pose`, along its +x.
struct ArrowPrimitive {
  tf::RigidTransform pose;
  double shaft_length = 0.0, shaft_diameter = 0.0, head_length = 0.0, head_diameter = 0.0;
  EntityColor color;
  double height_ratio = 1.0;  ///< extent along z against that along y: ROS scales them apart
};
/// `pose` is the centre. Sphere: size = three diameters.
struct CubePrimitive {
  tf::RigidTransform pose;
  glm::dvec3 size{0.0};
  EntityColor color;
};
struct SpherePrimitive {
  tf::RigidTransform pose;
  glm::dvec3 size{0.0};
  EntityColor color;
};
/// size: x, y diameters and height along z; scales shrink the ends (0: a cone).
struct CylinderPrimitive {
  tf::RigidTransform pose;
  glm::dvec3 size{0.0};
  double bottom_scale = 1.0, top_scale = 1.0;
  EntityColor color;
};
enum class LineType : std::uint8_t { Strip, Loop, List };
struct LinePrimitive {
  LineType type = LineType::Strip;
  tf::RigidTransform pose;
  double thickness = 0.0;  ///< metres, or pixels when scale_invariant
  bool is_scale_invariant = false;
  std::vector<glm::dvec3> points;
  EntityColor color;
  std::vector<EntityColor> colors;  ///< one a vertex, or empty
  std::vector<std::uint32_t> indices;
};
struct TrianglePrimitive {
  tf::RigidTransform pose;
  std::vector<glm::dvec3> points;
  EntityColor color;
  std::vector<EntityColor> colors;
  std::vector<std::uint32_t> indices;  ///< triples; empty: every three points
  std::vector<glm::vec2> uvs = {};     ///< ROS: one a point, (0, 0) is the picture's upper left; empty: no texture
  std::string texture_url = {};        ///< where the picture is, unless it comes along
  Payload texture = {};                ///< PNG or JPEG
};
/// ROS POINTS: squares of width_m x height_m that face the viewer.
struct PointsPrimitive {
  tf::RigidTransform pose;
  double width_m = 0.0, height_m = 0.0;
  std::vector<glm::dvec3> points;
  EntityColor color;
  std::vector<EntityColor> colors;
};
struct TextPrimitive {
  tf::RigidTransform pose;
  bool is_billboard = false;
  double font_size = 0.0;  ///< metres, or pixels when scale_invariant
  bool is_scale_invariant = false;
  EntityColor color;
  std::string text;  ///< UTF-8, may hold newlines
};
struct ModelPrimitive {
  tf::RigidTransform pose;
  glm::dvec3 scale{1.0};
  EntityColor color;
  bool is_color_override = false;
  std::string url;
  std::string media_type;
  Payload data;
};
struct AxesPrimitive {
  tf::RigidTransform pose;
  double length = 0.0, thickness = 0.0;
  bool is_scale_invariant = false;
};

/// Everything drawn under one id. Identity is (topic, id); a later entity replaces the earlier in full.
struct SceneEntity {
  tf::TimePoint stamp;  ///< header stamp; lifetimes run on the log time of the message instead
  std::string frame_id;
  std::string id;                ///< from ROS markers: "<length of ns>:<ns>:<id>"
  std::string marker_namespace;  ///< ROS ns, for switching; "" elsewhere
  std::int64_t lifetime_ns = 0;  ///< 0: for ever
  bool is_frame_locked = false;
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<ArrowPrimitive> arrows;
  std::vector<CubePrimitive> cubes;
  std::vector<SpherePrimitive> spheres;
  std::vector<CylinderPrimitive> cylinders;
  std::vector<LinePrimitive> lines;
  std::vector<TrianglePrimitive> triangles;
  std::vector<PointsPrimitive> points;
  std::vector<TextPrimitive> texts;
  std::vector<ModelPrimitive> models;
  std::vector<AxesPrimitive> axes;
};

struct SceneEntityDeletion {
  enum class Type : std::uint8_t { MatchingId, All };
  Type type = Type::MatchingId;
  tf::TimePoint stamp;           ///< Foxglove: only entities stamped at or before; ROS: the end of time
  std::string id;                ///< MatchingId
  std::string marker_namespace;  ///< All, from ROS: "" for every namespace of the topic
};

/// visualization_msgs/Marker(Array), foxglove.SceneUpdate. Steps apply in order: deletions and entities as the message
/// lists them (Foxglove: deletions first).
struct SceneEntities {
  static constexpr ObjectType kType = ObjectType::SceneEntities;
  struct Step {
    bool is_deletion = false;
    std::size_t index = 0;  ///< into deletions or entities
  };
  std::vector<SceneEntity> entities;
  std::vector<SceneEntityDeletion> deletions;
  std::vector<Step> steps;
  std::vector<std::string> faults;  ///< markers left out and why, one sentence each
  std::size_t payload_bytes = 0;    ///< serialised size, as a measure of what it keeps
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + 4 * payload_bytes; }
};

}  // namespace stillframe::scenegraph
