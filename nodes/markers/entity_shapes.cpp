#include "nodes/markers/entity_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stillframe::nodes {
namespace {

using scenegraph::EntityColor;
using tf::RigidTransform;

constexpr std::size_t kMostRuns = 64;  // of one entity; further cells share the frame's origin

constexpr EntityColor kAxisColors[] = {{235 / 255.0F, 52 / 255.0F, 52 / 255.0F, 1.0F},
                                       {52 / 255.0F, 200 / 255.0F, 68 / 255.0F, 1.0F},
                                       {64 / 255.0F, 110 / 255.0F, 1.0F, 1.0F}};

/// Collects the instances of one entity by batch.
class Collector {
 public:
  explicit Collector(bool use_cells) : use_cells_(use_cells) {}

  /// What is added from now on is of this primitive.
  void begin(const PrimitiveSource& source) {
    out_.sources.push_back(source);
    beginPart();
  }
  /// Copies of one part are judged as one.
  void beginPart() { is_judged_ = false; }
  void add(ShapeKind kind, const RigidTransform& pose, const glm::dvec3& scale, const EntityColor& color,
           float taper = 1.0F) {
    const glm::dvec3& at = pose.translation;
    const bool is_placed = std::abs(at.x) <= kReach_m && std::abs(at.y) <= kReach_m && std::abs(at.z) <= kReach_m;
    if (!is_placed) {
      judge(out_.unsound);
      return;
    }
    ShapeBatchKey key{kind, color.a < 1.0F, {}};
    if (use_cells_) {
      for (int axis = 0; axis < 3; ++axis) {
        key.cell[static_cast<std::size_t>(axis)] =
            static_cast<std::int32_t>(std::lround(at[axis] / ShapeBatchKey::kCell_m));
      }
    }
    Instance instance = makeInstance(pose, scale, key.origin(), {color.r, color.g, color.b, color.a});
    if (!(color.a > 0.0F)) {
      judge(out_.invisible);
      return;
    }
    if (!(instance.alpha > 0.0F)) {
      judge(out_.unsound);
      return;
    }
    if (scale.x == 0.0 || scale.y == 0.0 || (kind != ShapeKind::Square && scale.z == 0.0)) {
      judge(out_.flat);
    }
    instance.taper = taper;
    instance.id = static_cast<float>(out_.sources.size() - 1);  // exact below 2^24
    runOf(key, pose, scale, color, instance).instances.push_back(instance);
  }
  [[nodiscard]] EntityShapes take() { return std::move(out_); }

 private:
  void judge(std::uint32_t& count) {
    count += is_judged_ ? 0 : 1;
    is_judged_ = true;
  }
  ShapeRun& runOf(ShapeBatchKey key, const RigidTransform& pose, const glm::dvec3& scale, const EntityColor& color,
                  Instance& instance) {
    if (last_ < out_.runs.size() && out_.runs[last_].key == key) {
      return out_.runs[last_];
    }
    auto found = std::ranges::find(out_.runs, key, &ShapeRun::key);
    if (found == out_.runs.end() && out_.runs.size() >= kMostRuns && key.cell != ShapeBatchKey{}.cell) {
      const Instance before = instance;
      key.cell = {};
      instance = makeInstance(pose, scale, key.origin(), {color.r, color.g, color.b, color.a});
      instance.taper = before.taper;
      instance.id = before.id;
      found = std::ranges::find(out_.runs, key, &ShapeRun::key);
    }
    last_ = static_cast<std::size_t>(found - out_.runs.begin());
    return found != out_.runs.end() ? *found : out_.runs.push_back({key, 0, {}});
  }

  bool use_cells_;
  bool is_judged_ = false;
  EntityShapes out_;
  std::size_t last_ = 0;
};

RigidTransform moved(const RigidTransform& pose, const glm::dvec3& offset) {
  return {pose.rotation, pose.translation + pose.rotation * offset};
}

/// +z of the mesh along +x of the pose, +x of the mesh along its +y.
const glm::dquat kXFromZ{0.5, 0.5, 0.5, 0.5};

void addArrow(const scenegraph::ArrowPrimitive& arrow, Collector& out) {
  const RigidTransform pose = soundPose(arrow.pose);
  const auto part = [&](double from, double length, double diameter, float taper) {
    RigidTransform at = moved(pose, {from + 0.5 * length, 0.0, 0.0});
    at.rotation = at.rotation * kXFromZ;
    out.add(ShapeKind::Frustum, at, {diameter, diameter * arrow.height_ratio, length}, arrow.color, taper);
  };
  out.begin({PrimitiveSource::Kind::Arrow,
             arrow.pose,
             {arrow.shaft_length, arrow.shaft_diameter, arrow.head_length, arrow.head_diameter}});
  part(0.0, arrow.shaft_length, arrow.shaft_diameter, 1.0F);
  part(arrow.shaft_length, arrow.head_length, arrow.head_diameter, 0.0F);
}

/// The larger end is the mesh's own size; the taper shrinks the other.
void addCylinder(const scenegraph::CylinderPrimitive& cylinder, Collector& out) {
  const double bottom = std::abs(cylinder.bottom_scale);
  const double top = std::abs(cylinder.top_scale);
  const double larger = std::max(bottom, top);
  const double smaller = larger > 0.0 ? std::min(bottom, top) / larger : 1.0;
  const glm::dvec3 size{cylinder.size.x * larger, cylinder.size.y * larger, cylinder.size.z};
  out.begin({PrimitiveSource::Kind::Cylinder,
             cylinder.pose,
             {cylinder.size.x, cylinder.size.y, cylinder.size.z, cylinder.bottom_scale, cylinder.top_scale}});
  out.add(ShapeKind::Frustum, soundPose(cylinder.pose), size, cylinder.color,
          static_cast<float>(top < bottom ? smaller : 2.0 - smaller));
}

void addAxes(const scenegraph::AxesPrimitive& axes, Collector& out) {
  const RigidTransform pose = soundPose(axes.pose);
  const glm::dquat turns[] = {kXFromZ, glm::dquat(0.5, -0.5, -0.5, -0.5), glm::dquat(1.0, 0.0, 0.0, 0.0)};
  out.begin({PrimitiveSource::Kind::Axes, axes.pose, {axes.length, axes.thickness}});
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 middle(0.0);
    middle[axis] = 0.5 * axes.length;
    RigidTransform at = moved(pose, middle);
    at.rotation = at.rotation * turns[axis];
    out.add(ShapeKind::Frustum, at, {axes.thickness, axes.thickness, axes.length}, kAxisColors[axis]);
  }
}

}  // namespace

RigidTransform soundPose(const RigidTransform& pose) {
  // Scaled first: the squares of tiny and huge components stay in range.
  const glm::dquat& q = pose.rotation;
  const double largest = std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  if (largest == 0.0) {
    return {glm::dquat(1.0, 0.0, 0.0, 0.0), pose.translation};
  }
  return {glm::normalize(q / largest), pose.translation};
}

const char* toString(PrimitiveSource::Kind kind) noexcept {
  constexpr std::array kNames{"arrow", "cube", "sphere", "cylinder", "point", "axes"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::span<const char* const> sizeNames(PrimitiveSource::Kind kind) noexcept {
  using enum PrimitiveSource::Kind;
  static constexpr std::array kArrow{"shaft_length", "shaft_diameter", "head_length", "head_diameter"};
  static constexpr std::array kSize{"size_x", "size_y", "size_z", "bottom_scale", "top_scale"};
  static constexpr std::array kPoints{"width", "height"};
  static constexpr std::array kAxes{"length", "thickness"};
  switch (kind) {
    case Arrow:
      return kArrow;
    case Cube:
    case Sphere:
      return std::span(kSize).first(3);
    case Cylinder:
      return kSize;
    case Points:
      return kPoints;
    case Axes:
      break;
  }
  return kAxes;
}

EntityShapes shapesOf(const scenegraph::SceneEntity& entity, bool use_cells) {
  Collector out(use_cells);
  for (const auto& arrow : entity.arrows) {
    addArrow(arrow, out);
  }
  for (const auto& cube : entity.cubes) {
    out.begin({PrimitiveSource::Kind::Cube, cube.pose, {cube.size.x, cube.size.y, cube.size.z}});
    out.add(ShapeKind::Box, soundPose(cube.pose), cube.size, cube.color);
  }
  for (const auto& sphere : entity.spheres) {
    out.begin({PrimitiveSource::Kind::Sphere, sphere.pose, {sphere.size.x, sphere.size.y, sphere.size.z}});
    out.add(ShapeKind::Sphere, soundPose(sphere.pose), sphere.size, sphere.color);
  }
  for (const auto& cylinder : entity.cylinders) {
    addCylinder(cylinder, out);
  }
  for (const auto& points : entity.points) {
    const RigidTransform pose = soundPose(points.pose);
    out.begin({PrimitiveSource::Kind::Points, points.pose, {points.width_m, points.height_m}});
    for (std::size_t i = 0; i < points.points.size(); ++i) {
      out.beginPart();
      out.add(ShapeKind::Square, {glm::dquat(1.0, 0.0, 0.0, 0.0), moved(pose, points.points[i]).translation},
              {points.width_m, points.height_m, 1.0}, i < points.colors.size() ? points.colors[i] : points.color);
    }
  }
  for (const auto& axes : entity.axes) {
    if (!axes.is_scale_invariant) {
      addAxes(axes, out);
    }
  }
  return out.take();
}

}  // namespace stillframe::nodes
