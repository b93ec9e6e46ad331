#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <vector>

#include "nodes/occupancy_grid/grid_tracker.h"
#include "nodes/occupancy_grid/occupancy_grid_settings.h"

namespace stillframe::nodes {

/// A grid as textured quads, one a tile: the cells as they are in R8 textures, the colours in the shader.
///
/// Another state of the same size rewrites and uploads only the tiles that differ; a tile of one value is a texture of
/// one texel. Everything that settings change is a uniform or a mode.
///
/// Its depth is that of flat things (flat_depth.glsl), by its place among them (flat_order.h): it holds at any
/// distance, in our reverse-Z targets and in a stock viewer. GUI thread.
class GridTiles {
 public:
  /// Puts the grid's state on `node`, its matrix and its children.
  explicit GridTiles(osg::MatrixTransform& node);

  /// nullptr draws nothing.
  void show(std::shared_ptr<const GridSnapshot> snapshot);
  void apply(const OccupancyGridSettings& settings);
  void setOrder(std::uint32_t order, std::uint32_t of_type);

  /// Bytes of texture written by show(), ever.
  [[nodiscard]] std::uint64_t uploadedBytes() const noexcept { return uploaded_bytes_; }

 private:
  struct Tile {
    osg::ref_ptr<osg::Geometry> geometry;
    osg::ref_ptr<osg::Image> image;
    std::uint32_t x = 0;  ///< cells
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::size_t> blocks;  ///< in it, row-major
  };
  [[nodiscard]] bool hasLayoutOf(const GridHeader& header) const;
  void build(const GridHeader& header, const GridCells& cells);
  [[nodiscard]] bool isChanged(const Tile& tile, const GridCells& now) const;
  void write(Tile& tile, const GridHeader& header, const GridCells& cells);
  void setBin();

  osg::ref_ptr<osg::MatrixTransform> node_;
  osg::ref_ptr<osg::Uniform> scheme_;
  osg::ref_ptr<osg::Uniform> alpha_;
  osg::ref_ptr<osg::Uniform> step_;
  OccupancyGridSettings settings_;
  std::uint32_t order_ = 0;
  std::shared_ptr<const GridSnapshot> shown_;
  std::vector<Tile> tiles_;
  std::uint64_t uploaded_bytes_ = 0;
};

}  // namespace stillframe::nodes
