#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace stillframe::sample {

/// What a surface is made of: how it reflects the lidar and which colour the camera sees.
enum class Material : std::uint8_t { Floor, Wall, Steel, Board, Carton, Concrete, Ramp, Vehicle };

struct Appearance {
  float reflectivity = 0.5F;  ///< 0..1
  glm::vec3 rgb{0.5F};        ///< 0..1
};
[[nodiscard]] Appearance appearance(Material material) noexcept;

/// A solid standing upright in the map: a box turned about Z, its top level or sloped, or a cylinder.
struct Solid {
  enum class Shape : std::uint8_t { Box, Wedge, Cylinder };
  Shape shape = Shape::Box;
  Material material = Material::Carton;
  glm::dvec3 centre{0.0};
  glm::dvec3 half{0.5};  ///< half extents; a cylinder's radius is half.x; a wedge rises along its local +x
  double yaw_rad = 0.0;
  float tint = 1.0F;  ///< brightness of this one among its kind
};

/// Height of the solid's top over (x, y) in the map; nullopt where it does not stand.
[[nodiscard]] std::optional<double> heightOver(const Solid& solid, double x, double y);

/// Where a ray meets the world.
struct Hit {
  double range_m = 0.0;
  glm::dvec3 normal_in_map{0.0, 0.0, 1.0};
  Material material = Material::Floor;
  float tint = 1.0F;
};

/// The highest surface over a place, as a lidar from above would map it.
struct Top {
  double height_m = 0.0;
  Material material = Material::Floor;
};

/// A small warehouse, 30 m x 20 m, walls 7 m high: racks with cartons, pillars, a ramp and one vehicle that drives to
/// and fro. The floor is z = 0 and everything is closed in, so that a level lidar's every beam returns. Immutable.
class World {
 public:
  explicit World(std::uint64_t seed);
  [[nodiscard]] std::span<const Solid> solids() const noexcept { return solids_; }
  /// Of what does not move, over (x, y) in the map.
  [[nodiscard]] Top topAt(double x, double y) const;
  static constexpr double kHalfLength_m = 15.0;  ///< inside the walls, along x
  static constexpr double kHalfWidth_m = 10.0;   ///< along y
  /// The moving vehicle at `seconds` from the start.
  [[nodiscard]] static Solid vehicle(double seconds);

 private:
  std::vector<Solid> solids_;
};

/// Casts rays from one point at one instant. Setting it up sorts the solids into sectors of azimuth, nearest first, so
/// that a ray tests only those that it can meet: about 0.1 us a ray. Any thread once made.
class RayCaster {
 public:
  RayCaster(const World& world, double seconds, const glm::dvec3& origin_in_map);
  /// The first hit nearer than `max_range_m`. `direction_in_map` is of unit length.
  [[nodiscard]] std::optional<Hit> cast(const glm::dvec3& direction_in_map, double max_range_m) const;

 private:
  static constexpr std::size_t kSectors = 512;
  struct Candidate {
    double nearest_m;  ///< horizontal distance at which the solid may begin
    std::uint32_t solid;
  };
  struct Prepared {
    Solid solid;
    double cos_yaw = 1.0;
    double sin_yaw = 0.0;
    glm::dvec3 origin_in_solid{0.0};
  };
  [[nodiscard]] static std::optional<Hit> intersect(const Prepared& prepared, const glm::dvec3& direction_in_map,
                                                    double max_range_m);

  glm::dvec3 origin_;
  std::vector<Prepared> solids_;
  std::array<std::vector<Candidate>, kSectors> sectors_;
};

}  // namespace stillframe::sample
