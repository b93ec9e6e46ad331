#include "nodes/grid_map/grid_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <osg/Image>
#include <string>
#include <tuple>

#include "nodes/texel_formats.h"

namespace stillframe::nodes {
namespace {

osg::ref_ptr<osg::Texture2D> makeTexture(const scenegraph::GridMap& map, GLint internal_format, GLenum format,
                                         GLenum type) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(static_cast<int>(map.column_count), static_cast<int>(map.row_count), 1, format, type);
  image->setInternalTextureFormat(internal_format);
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setInternalFormat(internal_format);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  texture->setResizeNonPowerOfTwoHint(false);
  texture->setUseHardwareMipMapGeneration(false);
  return texture;
}

std::span<float> texels(const osg::Texture2D& texture, std::size_t cells) {
  // allocateImage() gave storage aligned for any type.
  return {reinterpret_cast<float*>(const_cast<osg::Image*>(texture.getImage())->data()), cells};
}

}  // namespace

/// What has been made on demand so far.
struct GridSurface::Lazy {
  std::mutex mutex;  // guards everything below
  std::map<std::string, MapLayer, std::less<>> layers;
  std::map<std::string, MapMesh, std::less<>> meshes;
  std::map<std::tuple<std::string, double, double>, ValueRange> percentiles;
  osg::ref_ptr<osg::Texture2D> colors;
};

GridSurface::GridSurface() : lazy_(std::make_unique<Lazy>()) {}
GridSurface::GridSurface(GridSurface&&) noexcept = default;
GridSurface& GridSurface::operator=(GridSurface&&) noexcept = default;
GridSurface::~GridSurface() = default;

std::expected<GridSurface, scenegraph::Status> GridSurface::make(std::shared_ptr<const scenegraph::GridMap> map) {
  auto cells = readMapCells(*map);
  if (!cells) {
    return std::unexpected(std::move(cells.error()));
  }
  GridSurface surface;
  surface.cells_ = std::move(*cells);
  surface.map_ = std::move(map);
  return surface;
}

bool GridSurface::hasLayer(std::string_view name) const {
  return std::ranges::find(cells_.layers, name, &ChannelInfo::name) != cells_.layers.end();
}

const MapLayer* GridSurface::layer(std::string_view name) const {
  const std::scoped_lock lock(lazy_->mutex);
  return layerLocked(name);
}

const MapLayer* GridSurface::layerLocked(std::string_view name) const {
  const auto info = std::ranges::find(cells_.layers, name, &ChannelInfo::name);
  if (info == cells_.layers.end() || cells_.all.points == 0) {
    return nullptr;
  }
  const auto [found, is_new] = lazy_->layers.try_emplace(info->name);
  if (is_new) {
    found->second.texture = makeTexture(*map_, kR32f, GL_RED, GL_FLOAT);
    found->second.limits =
        convertChannel(cells_.records, cells_.all, *info, texels(*found->second.texture, cells_.all.points));
  }
  return &found->second;
}

const MapMesh* GridSurface::mesh(std::string_view height_layer) const {
  const std::scoped_lock lock(lazy_->mutex);
  const MapLayer* const heights = layerLocked(height_layer);
  if (heights == nullptr) {
    return nullptr;
  }
  const auto [found, is_new] = lazy_->meshes.try_emplace(std::string(height_layer));
  MapMesh& mesh = found->second;
  if (is_new) {
    const ChannelValues& limits = heights->limits;
    const double middle = limits.low / 2 + limits.high / 2;
    if (limits.finite > 0) {
      mesh.z_origin =
          std::abs(middle) > ConvertedCloud::kNearby && std::abs(middle) < ConvertedCloud::kReach ? middle : 0.0;
      mesh.low = std::clamp<double>(limits.low, -ConvertedCloud::kReach, ConvertedCloud::kReach);
      mesh.high = std::clamp<double>(limits.high, -ConvertedCloud::kReach, ConvertedCloud::kReach);
    }
    mesh.positions = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX, static_cast<unsigned>(cells_.all.points));
    mesh.positions->setVertexBufferObject(new osg::VertexBufferObject);
    mesh.normals = new osg::Vec4bArray(osg::Array::BIND_PER_VERTEX, static_cast<unsigned>(cells_.all.points));
    mesh.normals->setNormalize(true);
    mesh.normals->setVertexBufferObject(new osg::VertexBufferObject);
    mesh.triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    mesh.triangles->setElementBufferObject(new osg::ElementBufferObject);
    buildSurface(*map_, texels(*heights->texture, cells_.all.points), limits.offset, mesh.z_origin,
                 {.positions = {mesh.positions->front().ptr(), 3 * cells_.all.points},
                  .normals = {mesh.normals->front().ptr(), 4 * cells_.all.points},
                  .triangles = mesh.triangles->asVector()});
  }
  return &mesh;
}

osg::Texture2D* GridSurface::colors() const {
  if (!cells_.colors || cells_.all.points == 0) {
    return nullptr;
  }
  const std::scoped_lock lock(lazy_->mutex);
  if (!lazy_->colors.valid()) {
    lazy_->colors = makeTexture(*map_, kRgba8, GL_RGBA, GL_UNSIGNED_BYTE);
    convertCellColors(cells_, {lazy_->colors->getImage()->data(), 4 * cells_.all.points});
  }
  return lazy_->colors.get();
}

ValueRange GridSurface::percentiles(std::string_view name, double low, double high) const {
  const std::scoped_lock lock(lazy_->mutex);
  const MapLayer* const values = layerLocked(name);
  if (values == nullptr) {
    return {0.0, 0.0};
  }
  const auto [found, is_new] = lazy_->percentiles.try_emplace({std::string(name), low, high});
  if (is_new) {
    found->second = percentileRange(texels(*values->texture, cells_.all.points), values->limits.offset, low, high);
  }
  return found->second;
}

void GridSurface::releaseGlObjects() const {
  const std::scoped_lock lock(lazy_->mutex);
  if (lazy_->colors.valid()) {
    lazy_->colors->releaseGLObjects();
  }
  for (const auto& [name, layer] : lazy_->layers) {
    layer.texture->releaseGLObjects();
  }
  for (const auto& [name, mesh] : lazy_->meshes) {
    mesh.positions->releaseGLObjects();
    mesh.normals->releaseGLObjects();
    mesh.triangles->releaseGLObjects();
  }
}

std::size_t GridSurface::byteSize() const noexcept {
  constexpr std::size_t kCell = sizeof(osg::Vec3) + 4 + 6 * sizeof(std::uint32_t) + 2 * sizeof(float);
  return sizeof(*this) + map_->byteSize() + cells_.all.points * kCell;
}

}  // namespace stillframe::nodes
