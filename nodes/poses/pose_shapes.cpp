#include "nodes/poses/pose_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "nodes/axis_colors.h"
#include "nodes/osg_math.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Color;
using scenegraph::PosesKind;

/// A standard deviation beyond which a sender means "unknown": drivers write variances of 99999, 1e6 and 1e12.
constexpr double kUnboundedM = 300.0;
constexpr double kUnboundedRad = std::numbers::pi;
/// The widest cone.
constexpr double kWidestRad = 85.0 * std::numbers::pi / 180.0;
/// Thickness of a flat ellipsoid or cone against its width: without thickness it is not seen from the side.
constexpr double kFlat = 0.02;
/// Half widths that a line is drawn nearer by, for those that lie on the ground or on a map: less for lines in metres,
/// which can be wide, and would be seen through what stands before them.
constexpr double kDepthPull = 4.0;
constexpr double kDepthPullInMetres = 1.5;

/// What shape "auto" stands for.
std::string_view shapeOf(const PosesSettings& settings, PosesKind kind) {
  if (settings.shape != "auto") {
    return settings.shape;
  }
  return kind == PosesKind::Point                                ? "spheres"
         : kind == PosesKind::Path || kind == PosesKind::Polygon ? "none"
                                                                 : "triads";
}

Color withAlpha(Color color, double alpha) {
  color.a *= static_cast<float>(alpha);
  return color;
}

/// Turns the z axis of a frustum to each axis of a pose.
std::array<glm::dquat, 3> armRotations() {
  constexpr double kRoot = std::numbers::sqrt2 / 2.0;
  return {glm::dquat(kRoot, 0.0, kRoot, 0.0), glm::dquat(kRoot, -kRoot, 0.0, 0.0), glm::dquat(1.0, 0.0, 0.0, 0.0)};
}

}  // namespace

PoseShapes::~PoseShapes() { clear(); }

void PoseShapes::clear() {
  for (const Hung& hung : meshes_) {
    parent_.removeChild(&hung.mesh->node());
  }
  meshes_.clear();
  forgetAllButMeshes();
}

void PoseShapes::forgetAllButMeshes() {
  if (line_) {
    parent_.removeChild(line_place_);
    line_.reset();
    line_range_.reset();
    line_place_ = nullptr;
  }
  parent_.removeChild(label_);
  label_ = nullptr;
  box_.init();
  shapes_ = segments_ = 0;
  stride_ = 1;
  shows_rotations_ = is_fill_refused_ = false;
  texels_too_many_ = 0;
  covariance_ = {};
}

void PoseShapes::build(const PoseSet& shown, const PoseTrail* trail, const PosesSettings& settings,
                       std::uint64_t buffer_texels) {
  buffer_texels_ = buffer_texels;
  for (const Hung& hung : meshes_) {
    parent_.removeChild(&hung.mesh->node());
  }
  spare_ = std::exchange(meshes_, {});
  forgetAllButMeshes();
  const PosesKind kind = shown.source().kind;
  buildShapes(trail != nullptr && settings.trail_shapes ? trail->poses : shown, settings, kind);
  const bool is_line = kind == PosesKind::Path || kind == PosesKind::Polygon || trail != nullptr;
  if (settings.line == "on" || (settings.line == "auto" && is_line)) {
    buildLine(trail != nullptr ? trail->poses : shown, settings);
  }
  if (kind == PosesKind::Polygon && settings.fill) {
    buildFill(shown, settings);
  }
  if (settings.covariance && shown.source().covariance) {
    buildCovariance(shown, settings);
  }
  if (settings.child_label && !shown.source().child_frame_id.empty()) {
    buildLabel(shown, settings);
  }
  spare_.clear();
}

std::optional<PoseShapes::PoseHit> PoseShapes::poseAt(const scenegraph::PickHit& hit, const PoseSet& shown,
                                                      const PoseTrail* trail, const PosesSettings& settings) const {
  const auto nearest = [](const PoseSet& poses, const glm::dvec3& point) {
    std::size_t found = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < poses.source().poses.size(); ++i) {
      const auto at = poses.point(i);
      const double away = at ? glm::distance(*at, point) : least;
      if (away < least) {
        least = away;
        found = i;
      }
    }
    return found;
  };
  if (line_ && hit.isBeneath(*line_place_)) {
    const auto segment = line_->segmentAt(hit);
    return segment ? std::optional(PoseHit{trail != nullptr,
                                           nearest(trail != nullptr ? trail->poses : shown, segment->point_in_frame),
                                           "line"})
                   : std::nullopt;
  }
  for (const auto& [shape, mesh] : meshes_) {
    if (!hit.isBeneath(mesh->node()) || hit.instance >= mesh->size()) {
      continue;
    }
    const std::string& name = mesh->node().getName();
    if (name == "fill") {
      return PoseHit{false, nearest(shown, mesh->surfacePoint(hit)), name};
    }
    const bool is_shape = name == "poses" || name == "points";
    return PoseHit{is_shape && trail != nullptr && settings.trail_shapes,
                   is_shape ? static_cast<std::size_t>(mesh->at(hit.instance).id) : 0, is_shape ? "shape" : name};
  }
  return std::nullopt;
}

void PoseShapes::hang(const TriangleMesh& mesh, const char* name, std::string_view shape, const glm::dvec3& origin,
                      const Copies& copies) {
  if (copies.instances.empty()) {
    return;
  }
  const auto spare = shape.empty() ? spare_.end() : std::ranges::find(spare_, shape, &Hung::shape);
  if (spare != spare_.end()) {
    meshes_.push_back(std::move(*spare));
    spare_.erase(spare);
  } else {
    meshes_.push_back({std::string(shape), std::make_unique<InstancedMesh>(mesh, name)});
  }
  InstancedMesh& added = *meshes_.back().mesh;
  added.setOrigin(origin);
  added.resize(copies.instances.size());
  added.set(0, copies.instances);
  added.setBlended(copies.is_blended);
  added.setBufferTexels(buffer_texels_);
  added.commit();
  texels_too_many_ = std::max(texels_too_many_, added.texelsTooMany());
  parent_.addChild(&added.node());
  if (added.box().valid()) {
    const osg::Vec3d offset = toOsg(origin);
    box_.expandBy(added.box()._min + offset);
    box_.expandBy(added.box()._max + offset);
  }
}

void PoseShapes::buildShapes(const PoseSet& poses, const PosesSettings& settings, PosesKind kind) {
  const std::string_view shape = shapeOf(settings, kind);
  if (shape == "none") {
    return;
  }
  shows_rotations_ = shape != "spheres";
  const std::size_t count = poses.source().poses.size();
  const auto most = static_cast<std::size_t>(settings.max_shapes);
  stride_ = std::max<std::size_t>((count + most - 1) / most, 1);
  static const std::array<glm::dquat, 3> kArms = armRotations();
  const double length = settings.length_m;
  Copies copies{.instances = {}, .is_blended = settings.opacity < 1.0};
  copies.instances.reserve((count / stride_ + 1) * (shape == "triads" ? 3 : 1));
  const auto add = [&](const tf::RigidTransform& place, const glm::dvec3& scale, const Color& color, std::size_t id) {
    Instance instance = makeInstance(place, scale, poses.origin(), withAlpha(color, settings.opacity));
    instance.id = static_cast<float>(id);
    copies.instances.push_back(instance);
  };
  for (std::size_t i = 0; i < count; i += stride_) {
    if (shape == "spheres") {
      if (const auto point = poses.point(i)) {
        add({.translation = *point}, glm::dvec3(2.0 * settings.radius_m), settings.color, i);
        ++shapes_;
      }
      continue;
    }
    const auto pose = poses.pose(i);
    if (!pose) {
      continue;
    }
    ++shapes_;
    if (shape == "arrows") {
      add(*pose, {length, length / 14, length / 14}, settings.override_color ? settings.arm_color : kAxisColors[0], i);
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const glm::dvec3 middle = kArms[axis] * glm::dvec3(0.0, 0.0, length / 2);
      add({pose->rotation * kArms[axis], pose->translation + pose->rotation * middle},
          {length / 12, length / 12, length}, settings.override_color ? settings.arm_color : kAxisColors[axis], i);
    }
  }
  hang(shape == "spheres"  ? sphereMesh(16)
       : shape == "arrows" ? arrowMesh(10)
                           : frustumMesh(0.5F, 0.5F, 8),
       shape == "spheres" ? "points" : "poses", shape, poses.origin(), copies);
  shapes_ = texels_too_many_ > 0 ? 0 : shapes_;
}

void PoseShapes::buildLine(const PoseSet& poses, const PosesSettings& settings) {
  const PoseSet::Line& line = poses.line(poseValueOf(settings.color_field));
  segments_ = line.arrays.segments;
  if (segments_ == 0) {
    return;
  }
  line_.emplace();
  line_->setBufferTexels(buffer_texels_);
  line_->set(line.arrays);
  if (line_->texelsTooMany() > 0) {
    texels_too_many_ = std::max(texels_too_many_, line_->texelsTooMany());
    segments_ = 0;
    line_.reset();
    return;
  }
  line_->setStyle(0, {.width = settings.line_width, .in_metres = settings.line_unit == "m"});
  line_->setDepthPull(settings.line_unit == "m" ? kDepthPullInMetres : kDepthPull);
  line_->setColor(settings.color);
  line_->setOpacity(settings.opacity);
  if (line.arrays.values.valid()) {
    line_range_ =
        settings.range([&] { return line.limits; },
                       [&](double low, double high) {
                         const osg::FloatArray& values = *line.arrays.values;
                         return percentileRange({values.asVector().data(), values.size()}, line.offset, low, high);
                       });
    line_->setValueColors(settings.colormap, settings.map(*line_range_, line.offset), settings.missing_color);
  }
  line_place_ = new osg::MatrixTransform(osg::Matrixd::translate(toOsg(poses.origin())));
  line_place_->setName("line");
  line_place_->addChild(line_->geometry());
  parent_.addChild(line_place_);
  box_.expandBy(line.arrays.box._min + toOsg(poses.origin()));
  box_.expandBy(line.arrays.box._max + toOsg(poses.origin()));
}

void PoseShapes::buildFill(const PoseSet& polygon, const PosesSettings& settings) {
  const std::vector<std::uint32_t>* const triangles = polygon.fill();
  is_fill_refused_ = triangles == nullptr;
  if (triangles == nullptr || triangles->empty()) {
    return;
  }
  TriangleMesh mesh;
  mesh.triangles = *triangles;
  for (const tf::RigidTransform& corner : polygon.source().poses) {
    mesh.positions.emplace_back(corner.translation - polygon.origin());
  }
  const auto at = [&](std::size_t i) { return glm::dvec3(mesh.positions[(*triangles)[i]]); };
  const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
  const double size = glm::length(normal);
  mesh.normals.assign(mesh.positions.size(), size > 0.0 ? glm::vec3(normal / size) : glm::vec3(0.0F, 0.0F, 1.0F));
  const double alpha = settings.fill_opacity * settings.opacity;
  // Both faces: of what is translucent only the front is drawn.
  const std::size_t corners = mesh.positions.size();
  const std::size_t indices = mesh.triangles.size();
  for (std::size_t i = 0; i < corners; ++i) {
    mesh.positions.push_back(mesh.positions[i]);
    mesh.normals.push_back(-mesh.normals[i]);
  }
  for (std::size_t i = 0; i < indices; i += 3) {
    for (const std::size_t corner : {0U, 2U, 1U}) {
      mesh.triangles.push_back(mesh.triangles[i + corner] + static_cast<std::uint32_t>(corners));
    }
  }
  hang(mesh, "fill", "", polygon.origin(),
       {.instances = {makeInstance({.translation = polygon.origin()}, glm::dvec3(1.0), polygon.origin(),
                                   withAlpha(settings.color, alpha))},
        .is_blended = alpha < 1.0});
}

void PoseShapes::buildCovariance(const PoseSet& poses, const PosesSettings& settings) {
  const auto pose = poses.pose(0);
  if (!pose) {
    return;
  }
  const auto& matrix = *poses.source().covariance;
  const auto solid = [&](const TriangleMesh& mesh, const char* name, const tf::RigidTransform& place,
                         const glm::dvec3& scale, const Color& color) {
    const Color seen = withAlpha(color, settings.opacity);
    hang(mesh, name, name, poses.origin(),
         {.instances = {makeInstance(place, scale, poses.origin(), seen)}, .is_blended = seen.a < 1.0F});
  };
  const auto flattened = [](glm::dvec3 extent) {
    const double least = kFlat * std::max({extent.x, extent.y, extent.z});
    return glm::max(extent, glm::dvec3(least));
  };

  if (const auto spread = spreadOf(positionBlock(matrix))) {
    glm::dvec3 extent = 2.0 * settings.sigma * spread->sigma;
    for (int axis = 0; axis < 3; ++axis) {
      if (spread->sigma[axis] > kUnboundedM) {
        extent[axis] = 0.0;
        ++covariance_.unbounded_axes;
      }
    }
    if (std::max({extent.x, extent.y, extent.z}) > 0.0) {
      solid(sphereMesh(), "covariance", {glm::quat_cast(spread->axes), pose->translation}, flattened(extent),
            settings.covariance_color);
    }
  } else {
    covariance_.position = spread.error();
  }
  if (!settings.orientation_cone) {
    return;
  }
  const glm::dvec3 ahead = pose->rotation * glm::dvec3(1.0, 0.0, 0.0);
  if (const auto spread = directionSpreadOf(rotationBlock(matrix), ahead)) {
    glm::dvec3 extent(0.0);
    for (int axis = 0; axis < 2; ++axis) {
      const double angle = std::min(settings.sigma * spread->sigma[axis], kWidestRad);
      extent[axis] = spread->sigma[axis] > kUnboundedRad ? 0.0 : 2.0 * settings.length_m * std::tan(angle);
    }
    if (std::max(extent.x, extent.y) > 0.0) {
      extent = flattened({extent.x, extent.y, settings.length_m});
      // The frustum's point is its end z = 0.5: its z axis looks back to the pose.
      const glm::dmat3 axes(spread->axes[0], -spread->axes[1], -spread->axes[2]);
      solid(frustumMesh(0.5F, 0.0F), "orientation",
            {glm::quat_cast(axes), pose->translation + ahead * (settings.length_m / 2)}, extent, settings.cone_color);
    }
  } else {
    covariance_.rotation = spread.error();
  }
}

void PoseShapes::buildLabel(const PoseSet& poses, const PosesSettings& settings) {
  const auto at = poses.point(0);
  if (!at) {
    return;
  }
  Color color{.r = 1.0F, .g = 1.0F, .b = 1.0F, .a = 1.0F};
  color.a *= static_cast<float>(settings.opacity);
  label_ = new osg::MatrixTransform(osg::Matrixd::translate(toOsg(*at)));
  label_->addChild(texts_.make(poses.source().child_frame_id, {.height = 14.0, .color = color}));
  parent_.addChild(label_);
  box_.expandBy(toOsg(*at));
}

}  // namespace stillframe::nodes
