#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "scenegraph/raster/point_raster.h"

namespace stillframe::scenegraph {

/// What the points of a batch take their colours from: what the uniforms and arrays of the points' shader say.
///
/// All colours are sRGB-encoded, as there.
struct PointColors {
  enum class Mode : std::uint8_t { Flat = 0, Rgb = 1, Value = 2, Axis = 3 };
  Mode mode = Mode::Flat;
  std::span<const std::uint8_t> rgba;  ///< Rgb: four bytes a point
  std::span<const float> values;       ///< Value: one a point; at most -2.9e38 where there is none
  glm::vec2 value_map{};               ///< Value: t = value * x + y
  glm::vec4 axis_map{};                ///< Axis: t = dot(xyz, position) + w
  std::vector<glm::vec3> colormap;     ///< Value, Axis: evenly spaced over t of 0..1
  glm::vec3 flat{};
  glm::vec3 missing{};

  /// The same choices about the same arrays, at the same place in memory.
  [[nodiscard]] bool isSame(const PointColors& other) const noexcept {
    return mode == other.mode && rgba.data() == other.rgba.data() && rgba.size() == other.rgba.size() &&
           values.data() == other.values.data() && values.size() == other.values.size() &&
           value_map == other.value_map && axis_map == other.axis_map && colormap == other.colormap &&
           flat == other.flat && missing == other.missing;
  }
};

/// Colours of what a raster holds, as the points' shader computes them, decoded to linear light: only for points that
/// are seen, at most one a pixel. Tables stand for the power function: within 1e-6 of it, a sixth of a half's rounding.
class PointShading {
 public:
  PointShading(std::span<const PointBatch> batches, std::span<const PointColors> colors);

  /// Linear red, green, blue of a point by its number in the raster; and in alpha what the shader writes there, the
  /// share of it that tone mapping leaves alone: 0 of the points' own colours, 1 of colours that a legend explains.
  [[nodiscard]] glm::vec4 linearColor(std::uint32_t number) const;

  /// What the colours of a batch are made of, for who computes them elsewhere.
  struct Batch {
    std::uint32_t first = 0;
    std::span<const float> positions;
    PointColors colors;
    std::vector<glm::vec3> table;  ///< linear light over t of 0..1
    glm::vec3 flat{};              ///< linear
    glm::vec3 missing{};           ///< linear
  };
  [[nodiscard]] const std::vector<Batch>& batches() const noexcept { return batches_; }
  /// Linear light of an sRGB byte.
  [[nodiscard]] static const std::array<float, 256>& linearOfBytes();

 private:
  [[nodiscard]] static glm::vec3 fromTable(const Batch& batch, float t);

  std::vector<Batch> batches_;
};

}  // namespace stillframe::scenegraph
