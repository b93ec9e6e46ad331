#include "nodes/occupancy_grid/grid_tiles.h"

#include <algorithm>
#include <cstring>
#include <osg/Texture2D>
#include <span>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/flat_order.h"
#include "nodes/osg_math.h"
#include "nodes/texel_formats.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace stillframe::nodes {
namespace {

constexpr int kBehindBin = -100;
constexpr std::uint32_t kMostBins = 8;  // between the opaque bin, 0, and the transparent one, 10

int schemeNumber(const std::string& name) { return name == "costmap" ? 1 : name == "raw" ? 2 : 0; }

osg::ref_ptr<osg::Texture2D> makeTexture(osg::Image* image) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
  texture->setResizeNonPowerOfTwoHint(false);
  texture->setInternalFormat(kR8);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  texture->setImage(image);
  return texture;
}

/// The tile's corners in metres and, as texture coordinates, in its own cells.
osg::ref_ptr<osg::Geometry> makeQuad(const GridHeader& header, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                                     std::uint32_t height) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec2Array> cells = new osg::Vec2Array;
  for (const auto& [i, j] : {std::pair{0U, 0U}, {width, 0U}, {0U, height}, {width, height}}) {
    // The same product for the tiles on both sides of an edge: no gap between them.
    vertices->push_back(osg::Vec3d(header.resolution_m * (x + i), header.resolution_m * (y + j), 0.0));
    cells->push_back({static_cast<float>(i), static_cast<float>(j)});
  }
  osg::ref_ptr<osg::Geometry> quad = scenegraph::makeGeometry();
  quad->setVertexArray(vertices);
  quad->setTexCoordArray(0, cells, osg::Array::BIND_PER_VERTEX);
  quad->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
  return quad;
}

/// A block as one side of a row of them.
struct BlockRows {
  const std::int8_t* row = nullptr;  ///< the next to write
  std::size_t step = 0;              ///< to the one after it; 0 where all are the same
  std::uint32_t width = 0;
  std::uint32_t left = 0;  ///< in the tile
};

/// Past the caches, where the processor can: the texels are next read for the upload, and a large grid has more of them
/// than caches hold. finishStores() makes them seen.
void storeRow(unsigned char* to, const std::int8_t* from, std::size_t bytes) {
#if defined(__SSE2__)
  if (reinterpret_cast<std::uintptr_t>(to) % sizeof(__m128i) == 0 && bytes % sizeof(__m128i) == 0) {
    for (std::size_t i = 0; i < bytes; i += sizeof(__m128i)) {
      _mm_stream_si128(reinterpret_cast<__m128i*>(to + i), _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + i)));
    }
    return;
  }
#endif
  std::memcpy(to, from, bytes);
}

void finishStores() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

/// Writes blocks that lie side by side, row by row across all of them: memory is written in the order of addresses,
/// which takes half the time of block by block. The rows of the image are `stride` bytes apart.
void writeBlocks(std::span<BlockRows> blocks, std::uint32_t rows, unsigned char* to, std::size_t stride) {
  for (std::uint32_t row = 0; row < rows; ++row, to += stride) {
    for (BlockRows& block : blocks) {
      storeRow(to + block.left, block.row, block.width);
      block.row += block.step;
    }
  }
}

}  // namespace

GridTiles::GridTiles(osg::MatrixTransform& node)
    : node_(&node),
      scheme_(new osg::Uniform("u_color_scheme", 0)),
      alpha_(new osg::Uniform("u_alpha", 1.0F)),
      step_(new osg::Uniform("u_depth_step", 1.0F)) {
  namespace shaders = shaders::stillframe_nodes;
  osg::StateSet& state = *node_->getOrCreateStateSet();
  state.setAttributeAndModes(
      scenegraph::makeProgram("occupancy_grid", shaders::k_occupancy_grid_vert, shaders::k_occupancy_grid_frag));
  for (const auto& uniform : {scheme_, alpha_, step_}) {
    state.addUniform(uniform);
  }
  state.addUniform(new osg::Uniform("u_cells", 0));
  setBin();
}

void GridTiles::setBin() {
  osg::StateSet& state = *node_->getStateSet();
  const bool is_blended = settings_.alpha < 1.0 || settings_.color_scheme == "costmap";
  const int order = static_cast<int>(std::min(order_, kMostBins));
  scenegraph::setBlended(state, is_blended);  // the bins below order grids among each other
  if (settings_.draw_behind) {
    // Neither tests nor writes depth, and comes first.
    state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    state.setRenderBinDetails(kBehindBin + order, "RenderBin");
  } else {
    state.removeMode(GL_DEPTH_TEST);
    if (is_blended) {
      state.setRenderBinDetails(1 + order, "RenderBin");
    } else {
      state.setRenderBinDetails(0, "RenderBin");
    }
  }
}

void GridTiles::apply(const OccupancyGridSettings& settings) {
  settings_ = settings;
  scheme_->set(schemeNumber(settings.color_scheme));
  alpha_->set(static_cast<float>(settings.alpha));
  setBin();
}

void GridTiles::setOrder(std::uint32_t order, std::uint32_t of_type) {
  step_->set(flatDepthStep(FlatKind::OccupancyGrid, order, of_type));
  if (order_ != order) {
    order_ = order;
    setBin();
  }
}

bool GridTiles::hasLayoutOf(const GridHeader& header) const {
  return shown_ != nullptr && shown_->header.width == header.width && shown_->header.height == header.height &&
         shown_->header.resolution_m == header.resolution_m;
}

void GridTiles::show(std::shared_ptr<const GridSnapshot> snapshot) {
  if (snapshot == shown_) {
    return;
  }
  if (snapshot == nullptr) {
    node_->removeChildren(0, node_->getNumChildren());
    tiles_.clear();
    shown_ = nullptr;
    return;
  }
  if (!hasLayoutOf(snapshot->header)) {
    build(snapshot->header, snapshot->state->cells);
  } else {
    for (Tile& tile : tiles_) {
      if (isChanged(tile, snapshot->state->cells)) {
        write(tile, snapshot->header, snapshot->state->cells);
      }
    }
  }
  node_->setMatrix(toOsg(snapshot->header.frame_from_grid));
  shown_ = std::move(snapshot);
}

bool GridTiles::isChanged(const Tile& tile, const GridCells& now) const {
  return std::ranges::any_of(tile.blocks, [&](std::size_t block) {
    const auto& is = now.blocks()[block];
    const auto& was = shown_->state->cells.blocks()[block];
    return is != was && is->cells != was->cells;
  });
}

void GridTiles::build(const GridHeader& header, const GridCells& cells) {
  node_->removeChildren(0, node_->getNumChildren());
  tiles_.clear();
  for (std::uint32_t y = 0; y < header.height && header.width > 0; y += header.tile_edge) {
    for (std::uint32_t x = 0; x < header.width; x += header.tile_edge) {
      Tile tile;
      tile.x = x;
      tile.y = y;
      tile.width = std::min(header.tile_edge, header.width - x);
      tile.height = std::min(header.tile_edge, header.height - y);
      for (std::uint32_t row = y; row < y + tile.height; row += header.block_edge) {
        for (std::uint32_t column = x; column < x + tile.width; column += header.block_edge) {
          tile.blocks.push_back(std::size_t{row / header.block_edge} * cells.blockColumns() +
                                column / header.block_edge);
        }
      }
      tile.geometry = makeQuad(header, x, y, tile.width, tile.height);
      write(tile, header, cells);
      node_->addChild(tile.geometry);
      tiles_.push_back(std::move(tile));
    }
  }
}

void GridTiles::write(Tile& tile, const GridHeader& header, const GridCells& cells) {
  const auto blockAt = [&](std::size_t i) -> const GridBlock& { return *cells.blocks()[tile.blocks[i]]; };
  const std::int8_t value = blockAt(0).cells.front();
  bool is_uniform = true;
  for (std::size_t i = 0; i < tile.blocks.size() && is_uniform; ++i) {
    is_uniform = blockAt(i).isUniform() && blockAt(i).cells.front() == value;
  }
  const int width = is_uniform ? 1 : static_cast<int>(tile.width);
  const int height = is_uniform ? 1 : static_cast<int>(tile.height);
  const bool is_kept = tile.image != nullptr && tile.image->s() == width && tile.image->t() == height;
  if (!is_kept) {
    tile.image = new osg::Image;
    tile.image->allocateImage(width, height, 1, GL_RED, GL_UNSIGNED_BYTE, 1);
    tile.image->setInternalTextureFormat(kR8);
    tile.geometry->getOrCreateStateSet()->setTextureAttributeAndModes(0, makeTexture(tile.image));
  }
  if (is_uniform) {
    *tile.image->data() = static_cast<unsigned char>(value);
  } else {
    const std::size_t columns = (tile.width + header.block_edge - 1) / header.block_edge;
    std::vector<std::int8_t> same(columns * header.block_edge);  // rows of the blocks of one value
    std::vector<BlockRows> changed;
    for (std::size_t first = 0; first < tile.blocks.size(); first += columns) {
      changed.clear();
      for (std::size_t i = first; i < first + columns; ++i) {
        const GridBlock& block = blockAt(i);
        if (is_kept && shown_->state->cells.blocks()[tile.blocks[i]].get() == &block) {
          continue;  // the texels are there
        }
        const auto left = static_cast<std::uint32_t>((i - first) * header.block_edge);
        if (block.isUniform()) {
          std::fill_n(same.begin() + left, block.width, block.cells.front());
          changed.push_back({&same[left], 0, block.width, left});
        } else {
          changed.push_back({block.cells.data(), block.width, block.width, left});
        }
      }
      const auto bottom = static_cast<unsigned>(first / columns * header.block_edge);
      writeBlocks(changed, blockAt(first).height, tile.image->data(0, bottom), tile.width);
    }
    finishStores();
  }
  tile.image->dirty();
  uploaded_bytes_ += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

}  // namespace stillframe::nodes
