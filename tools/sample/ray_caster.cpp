#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tools/sample/world.h"

namespace stillframe::sample {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The part of a ray inside a convex solid, narrowed plane by plane, and the outward normal where it came in.
struct Interval {
  double enter = -kInfinity;
  double leave = kInfinity;
  glm::dvec3 normal{0.0, 0.0, 1.0};

  [[nodiscard]] bool isEmpty() const { return enter > leave; }
};

/// Keeps what lies between -half and half on one axis.
void clipSlab(Interval& inside, glm::length_t axis, double half, const glm::dvec3& origin,
              const glm::dvec3& direction) {
  if (direction[axis] == 0.0) {
    if (std::abs(origin[axis]) > half) {
      inside.leave = -kInfinity;
    }
    return;
  }
  const double sign = direction[axis] > 0.0 ? -1.0 : 1.0;  // of the face that looks at the ray
  const double inverse = 1.0 / direction[axis];
  if (const double t = (sign * half - origin[axis]) * inverse; t > inside.enter) {
    inside.enter = t;
    inside.normal = glm::dvec3{0.0};
    inside.normal[axis] = sign;
  }
  inside.leave = std::min(inside.leave, (-sign * half - origin[axis]) * inverse);
}

/// Keeps what lies below the slope of a wedge, which passes through the centre.
void clipSlope(Interval& inside, const Solid& solid, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3{-solid.half.z, 0.0, solid.half.x});
  const double speed = glm::dot(normal, direction);
  const double height = glm::dot(normal, origin);
  if (speed < 0.0) {
    if (const double t = -height / speed; t > inside.enter) {
      inside.enter = t;
      inside.normal = normal;
    }
  } else if (speed > 0.0) {
    inside.leave = std::min(inside.leave, -height / speed);
  } else if (height > 0.0) {
    inside.leave = -kInfinity;
  }
}

/// Keeps what lies within the radius of an upright cylinder.
void clipRound(Interval& inside, double radius, const glm::dvec3& origin, const glm::dvec3& direction) {
  const double a = direction.x * direction.x + direction.y * direction.y;
  const double b = origin.x * direction.x + origin.y * direction.y;
  const double c = origin.x * origin.x + origin.y * origin.y - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0 || (a <= 0.0 && c > 0.0)) {
    inside.leave = -kInfinity;
  } else if (a > 0.0) {
    const double root = std::sqrt(discriminant);
    if (const double t = (-b - root) / a; t > inside.enter) {
      inside.enter = t;
      inside.normal = glm::dvec3{origin.x + t * direction.x, origin.y + t * direction.y, 0.0} / radius;
    }
    inside.leave = std::min(inside.leave, (-b + root) / a);
  }
}

Interval intervalInside(const Solid& solid, const glm::dvec3& origin, const glm::dvec3& direction) {
  Interval inside;
  if (solid.shape == Solid::Shape::Cylinder) {
    clipRound(inside, solid.half.x, origin, direction);
  } else {
    clipSlab(inside, 0, solid.half.x, origin, direction);
    if (!inside.isEmpty()) {
      clipSlab(inside, 1, solid.half.y, origin, direction);
    }
  }
  if (!inside.isEmpty()) {
    clipSlab(inside, 2, solid.half.z, origin, direction);
  }
  if (solid.shape == Solid::Shape::Wedge && !inside.isEmpty()) {
    clipSlope(inside, solid, origin, direction);
  }
  return inside;
}

std::size_t sectorOf(double azimuth_rad, std::size_t sectors) {
  const double turns = azimuth_rad / (2.0 * std::numbers::pi);
  const double fraction = turns - std::floor(turns);
  return std::min(static_cast<std::size_t>(fraction * static_cast<double>(sectors)), sectors - 1);
}

}  // namespace

RayCaster::RayCaster(const World& world, double seconds, const glm::dvec3& origin_in_map) : origin_(origin_in_map) {
  std::vector<Solid> solids(world.solids().begin(), world.solids().end());
  solids.push_back(World::vehicle(seconds));
  for (const Solid& solid : solids) {
    const double cos_yaw = std::cos(solid.yaw_rad);
    const double sin_yaw = std::sin(solid.yaw_rad);
    const glm::dvec3 offset = origin_ - solid.centre;
    const auto index = static_cast<std::uint32_t>(solids_.size());
    solids_.push_back({solid,
                       cos_yaw,
                       sin_yaw,
                       {cos_yaw * offset.x + sin_yaw * offset.y, cos_yaw * offset.y - sin_yaw * offset.x, offset.z}});

    // The upright's corners bound the sectors it may be met in; all of them when the ray starts within its circle.
    const double radius = std::hypot(solid.half.x, solid.half.y);
    const double distance = std::hypot(offset.x, offset.y);
    std::size_t first = 0;
    std::size_t count = kSectors;
    if (distance > radius * 1.0001) {
      const double middle = std::atan2(-offset.y, -offset.x);
      double from = 0.0;
      double to = 0.0;
      if (solid.shape == Solid::Shape::Cylinder) {
        to = std::asin(std::min(1.0, solid.half.x / distance));
        from = -to;
      } else {
        for (const double x : {-solid.half.x, solid.half.x}) {
          for (const double y : {-solid.half.y, solid.half.y}) {
            const glm::dvec2 corner{cos_yaw * x - sin_yaw * y - offset.x, sin_yaw * x + cos_yaw * y - offset.y};
            const double turn = std::remainder(std::atan2(corner.y, corner.x) - middle, 2.0 * std::numbers::pi);
            from = std::min(from, turn);
            to = std::max(to, turn);
          }
        }
      }
      first = sectorOf(middle + from - 1e-9, kSectors);
      count = (sectorOf(middle + to + 1e-9, kSectors) + kSectors - first) % kSectors + 1;
    }
    const glm::dvec3& origin_in_solid = solids_.back().origin_in_solid;
    const double nearest = solid.shape == Solid::Shape::Cylinder
                               ? std::max(0.0, distance - solid.half.x)
                               : std::hypot(std::max(0.0, std::abs(origin_in_solid.x) - solid.half.x),
                                            std::max(0.0, std::abs(origin_in_solid.y) - solid.half.y));
    for (std::size_t i = 0; i < count; ++i) {
      sectors_[(first + i) % kSectors].push_back({nearest, index});
    }
  }
  for (auto& sector : sectors_) {
    std::ranges::sort(sector, {}, [](const Candidate& c) { return std::pair(c.nearest_m, c.solid); });
  }
}

std::optional<Hit> RayCaster::intersect(const Prepared& prepared, const glm::dvec3& direction_in_map,
                                        double max_range_m) {
  const double c = prepared.cos_yaw;
  const double s = prepared.sin_yaw;
  const glm::dvec3 direction{c * direction_in_map.x + s * direction_in_map.y,
                             c * direction_in_map.y - s * direction_in_map.x, direction_in_map.z};
  const Solid& solid = prepared.solid;
  const Interval inside = intervalInside(solid, prepared.origin_in_solid, direction);
  if (inside.isEmpty() || inside.enter <= 0.0 || inside.enter >= max_range_m) {
    return std::nullopt;
  }
  return Hit{inside.enter,
             {c * inside.normal.x - s * inside.normal.y, s * inside.normal.x + c * inside.normal.y, inside.normal.z},
             solid.material,
             solid.tint};
}

std::optional<Hit> RayCaster::cast(const glm::dvec3& direction_in_map, double max_range_m) const {
  std::optional<Hit> nearest;
  double limit_m = max_range_m;
  if (direction_in_map.z < 0.0) {
    if (const double t = -origin_.z / direction_in_map.z; t > 0.0 && t < limit_m) {
      nearest = Hit{.range_m = t};
      limit_m = t;
    }
  }
  const double horizontal =
      std::sqrt(direction_in_map.x * direction_in_map.x + direction_in_map.y * direction_in_map.y);
  const auto& sector = sectors_[sectorOf(std::atan2(direction_in_map.y, direction_in_map.x), kSectors)];
  for (const Candidate& candidate : sector) {
    if (candidate.nearest_m > limit_m * horizontal) {
      break;
    }
    if (const auto hit = intersect(solids_[candidate.solid], direction_in_map, limit_m)) {
      nearest = hit;
      limit_m = hit->range_m;
    }
  }
  return nearest;
}

}  // namespace stillframe::sample
