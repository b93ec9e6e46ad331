#include "scenegraph/raster/point_shading.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenegraph/srgb.h"

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kStepsAnInterval = 64;
constexpr float kLargestMissing = -2.9e38F;

std::vector<glm::vec3> tableOf(std::span<const glm::vec3> anchors) {
  std::vector<glm::vec3> table;
  if (anchors.size() < 2) {
    return table;
  }
  const std::size_t steps = (anchors.size() - 1) * kStepsAnInterval;
  table.reserve(steps + 1);
  for (std::size_t i = 0; i < steps; ++i) {
    const std::size_t below = i / kStepsAnInterval;
    const float part = static_cast<float>(i % kStepsAnInterval) / static_cast<float>(kStepsAnInterval);
    table.push_back(linearFromSrgb(glm::mix(anchors[below], anchors[below + 1], part)));
  }
  table.push_back(linearFromSrgb(anchors.back()));
  return table;
}

}  // namespace

PointShading::PointShading(std::span<const PointBatch> batches, std::span<const PointColors> colors) {
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    Batch& batch = batches_.emplace_back();
    batch.first = first;
    batch.positions = batches[i].positions;
    batch.colors = colors[i];
    batch.flat = linearFromSrgb(colors[i].flat);
    batch.missing = linearFromSrgb(colors[i].missing);
    const PointColors::Mode mode = colors[i].mode;
    if (mode == PointColors::Mode::Value || mode == PointColors::Mode::Axis) {
      batch.table = tableOf(colors[i].colormap);
    }
    // Arrays shorter than the cloud: what is not there has no colour, rather than the program no life.
    const std::size_t count = batches[i].count();
    const bool has_all = mode == PointColors::Mode::Rgb     ? colors[i].rgba.size() / 4 >= count
                         : mode == PointColors::Mode::Value ? colors[i].values.size() >= count && !batch.table.empty()
                         : mode == PointColors::Mode::Axis  ? !batch.table.empty()
                                                            : true;
    if (!has_all) {
      batch.colors.mode = PointColors::Mode::Flat;
    }
    first += static_cast<std::uint32_t>(count);
  }
}

const std::array<float, 256>& PointShading::linearOfBytes() {
  static const std::array<float, 256> kTable = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      table[i] = linearFromSrgb(static_cast<float>(i) / 255.0F);
    }
    return table;
  }();
  return kTable;
}

glm::vec3 PointShading::fromTable(const Batch& batch, float t) {
  const auto steps = static_cast<float>(batch.table.size() - 1);
  const float x = (t > 0.0F ? std::min(t, 1.0F) : 0.0F) * steps;  // NaN is 0
  const std::size_t below = std::min(static_cast<std::size_t>(x), batch.table.size() - 2);
  return glm::mix(batch.table[below], batch.table[below + 1], x - static_cast<float>(below));
}

glm::vec4 PointShading::linearColor(std::uint32_t number) const {
  const auto after = std::ranges::upper_bound(batches_, number, {}, &Batch::first);
  const Batch& batch = *std::prev(after);
  const std::size_t index = number - batch.first;
  switch (batch.colors.mode) {
    case PointColors::Mode::Flat:
      break;
    case PointColors::Mode::Rgb: {
      const std::uint8_t* const bytes = &batch.colors.rgba[4 * index];
      const std::array<float, 256>& linear = linearOfBytes();
      return {linear[bytes[0]], linear[bytes[1]], linear[bytes[2]], 0.0F};
    }
    case PointColors::Mode::Value: {
      const float value = batch.colors.values[index];
      return {value < kLargestMissing ? batch.missing
                                      : fromTable(batch, value * batch.colors.value_map.x + batch.colors.value_map.y),
              1.0F};
    }
    case PointColors::Mode::Axis: {
      const float* const point = &batch.positions[3 * index];
      const glm::vec4& axis = batch.colors.axis_map;
      return {fromTable(batch, axis.x * point[0] + axis.y * point[1] + axis.z * point[2] + axis.w), 1.0F};
    }
  }
  return {batch.flat, 1.0F};
}

}  // namespace stillframe::scenegraph
