#include "nodes/markers/textured_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <expected>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nodes/images/jpeg_reader.h"
#include "nodes/images/png_reader.h"
#include "nodes/markers/entity_shapes.h"
#include "nodes/primitives/triangle_area.h"

namespace stillframe::nodes {
namespace {

using scenegraph::EntityColor;
using scenegraph::Status;
using scenegraph::StatusLevel;
using scenegraph::TrianglePrimitive;

std::expected<MeshTexture, Status> readTexture(const TrianglePrimitive& triangles, const MeshLoader& loader) {
  const bool is_in_message = !triangles.texture.bytes.empty();
  std::span<const std::byte> bytes = triangles.texture.bytes;
  std::vector<std::byte> read;
  if (!is_in_message) {
    auto file = loader.read(triangles.texture_url);
    if (!file) {
      return std::unexpected(Status{StatusLevel::Warn, "TextureMissing", "its texture: " + file.error().message});
    }
    read = std::move(*file);
    bytes = read;
  }
  const auto textureOf = [&](auto picture) -> std::expected<MeshTexture, Status> {
    if (picture) {
      return MeshTexture{picture->width, picture->height, std::move(picture->rgba)};
    }
    return std::unexpected(Status{
        StatusLevel::Warn, "TextureUnreadable",
        (is_in_message ? std::string("its texture, in the message") : "its texture '" + triangles.texture_url + "'") +
            ", cannot be read as PNG or JPEG: " + picture.error().message});
  };
  return isPng(bytes) ? textureOf(readRgbaPng(bytes)) : textureOf(readJpeg(bytes));
}

std::array<std::uint8_t, 4> bytesOf(const EntityColor& color) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(value >= 0.0F ? std::lround(255.0F * std::min(value, 1.0F)) : 0L);
  };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

bool isInReach(const glm::dvec3& point) {
  return std::abs(point.x) < kReach_m && std::abs(point.y) < kReach_m && std::abs(point.z) < kReach_m;
}

}  // namespace

TexturedTriangles texturedTriangles(const TrianglePrimitive& triangles, const MeshLoader& loader) {
  TexturedTriangles result;
  MeshData& mesh = result.mesh;
  const std::size_t count = std::min(triangles.points.size(), triangles.uvs.size());
  const auto first = std::ranges::find_if(triangles.points, isInReach);
  result.origin = first != triangles.points.end() ? *first : glm::dvec3(0.0);
  bool has_area = false;
  for (std::size_t i = 0; i + 2 < count; i += 3) {
    const std::array corners{triangles.points[i], triangles.points[i + 1], triangles.points[i + 2]};
    if (!std::ranges::all_of(corners, isInReach)) {
      continue;
    }
    has_area = has_area || hasArea(corners[0], corners[1], corners[2]);
    const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = glm::length(across);
    const bool is_lit = triangles.colors.empty() && area > 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(corners[k] - result.origin);
      mesh.normals.push_back(is_lit ? glm::vec3(across / area) : glm::vec3(0.0F));
      const glm::vec2& uv = triangles.uvs[i + k];
      const bool is_placed = std::isfinite(uv.x) && std::isfinite(uv.y);
      mesh.uvs.push_back(is_placed ? uv : glm::vec2(0.0F));
      mesh.colors.push_back(bytesOf(i + k < triangles.colors.size() ? triangles.colors[i + k] : triangles.color));
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
    }
  }
  MeshMaterial material{.name = "triangles", .is_from_file = true, .is_double_sided = true};
  if (auto texture = readTexture(triangles, loader)) {
    mesh.textures.push_back(std::move(*texture));
    material.texture = 0;
  } else {
    result.failure = texture.error();
  }
  if (const std::size_t all = count / 3; !has_area && all > 0) {
    result.failure = Status{StatusLevel::Warn, "MeshIncomplete",
                            "none of its " + std::to_string(all) +
                                " triangles can be seen: their corners are not finite, beyond reach or on one line"};
  }
  mesh.materials.push_back(std::move(material));
  mesh.submeshes.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
  updateBox(mesh);
  return result;
}

}  // namespace stillframe::nodes
