#pragma once

#include <cstddef>
#include <expected>
#include <memory>
#include <osg/Array>
#include <osg/PrimitiveSet>
#include <osg/Texture2D>
#include <osg/ref_ptr>
#include <string_view>
#include <vector>

#include "nodes/grid_map/map_cells.h"
#include "nodes/points/value_range.h"
#include "scenegraph/objects/grid_map.h"

namespace stillframe::nodes {

/// A layer of a map as it is uploaded: one FLOAT32 texel a cell, kMissingValue for NaN.
struct MapLayer {
  osg::ref_ptr<osg::Texture2D> texture;
  ChannelValues limits;
};

/// A surface as it is uploaded.
struct MapMesh {
  osg::ref_ptr<osg::Vec3Array> positions;
  osg::ref_ptr<osg::Vec4bArray> normals;
  osg::ref_ptr<osg::DrawElementsUInt> triangles;
  double z_origin = 0.0;  ///< taken off the heights
  double low = 0.0;       ///< heights; meaningful when there are triangles
  double high = 0.0;
};

/// A grid map in the form that is drawn: checked now, layers and surfaces made when first asked for.
///
/// Made on a worker, cached, shared by all views. layer(), mesh(), colors() and percentiles() convert on first use and
/// remember; any thread may call them.
class GridSurface {
 public:
  [[nodiscard]] static std::expected<GridSurface, scenegraph::Status> make(
      std::shared_ptr<const scenegraph::GridMap> map);
  GridSurface(GridSurface&&) noexcept;
  GridSurface& operator=(GridSurface&&) noexcept;
  ~GridSurface();

  [[nodiscard]] const scenegraph::GridMap& source() const noexcept { return *map_; }
  [[nodiscard]] const MapCells& cells() const noexcept { return cells_; }
  [[nodiscard]] bool hasLayer(std::string_view name) const;

  /// nullptr when there is none of that name. Valid as long as this.
  [[nodiscard]] const MapLayer* layer(std::string_view name) const;
  /// nullptr when there is none of that name.
  [[nodiscard]] const MapMesh* mesh(std::string_view height_layer) const;
  /// nullptr without colours.
  [[nodiscard]] osg::Texture2D* colors() const;
  [[nodiscard]] ValueRange percentiles(std::string_view name, double low, double high) const;

  /// Frees what is on the GPU, in every context. GUI thread.
  void releaseGlObjects() const;
  /// Payload, a surface and a layer.
  [[nodiscard]] std::size_t byteSize() const noexcept;

 private:
  struct Lazy;
  GridSurface();
  [[nodiscard]] const MapLayer* layerLocked(std::string_view name) const;

  std::shared_ptr<const scenegraph::GridMap> map_;
  MapCells cells_;
  std::unique_ptr<Lazy> lazy_;
};

}  // namespace stillframe::nodes
