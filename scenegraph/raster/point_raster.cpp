#include "scenegraph/raster/point_raster.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "scenegraph/pipeline/half_float.h"
#include "scenegraph/raster/point_canvas.h"
#include "scenegraph/raster/point_shading.h"
#include "scenegraph/raster/points_in_view.h"

namespace stillframe::scenegraph {
namespace {

// Both ways compute bit for bit the same: AVX2 brings wider vectors, not fused operations. The thread sanitizer starts
// too late for what the choice between them needs.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define STILLFRAME_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define STILLFRAME_VECTOR_CLONES
#endif

constexpr std::size_t kBlock = 256;                     // points projected at a time: stays in the first cache
constexpr std::size_t kPiece = std::size_t{64} * 1024;  // points a task
constexpr float kMaxSizePx = 255.0F;                    // as in the shader of the points

/// A batch in the numbers that the inner loop needs.
struct Projection {
  std::array<float, 16> clip_from_points{};  // column by column
  float half_width = 0.0F;                   // in 1/256 of a pixel
  float half_height = 0.0F;
  float size = 1.0F;  // pixels, or pixels at w = 1
  bool is_size_in_metres = false;
  bool is_round = false;
  bool is_one_pixel = false;
  std::uint32_t first_number = 0;
};

/// Window coordinates in 1/256 of a pixel and depth of up to kBlock points; depth 0: not to be drawn.
struct Block {
  std::array<float, kBlock> x;
  std::array<float, kBlock> y;
  std::array<float, kBlock> z;
  std::array<std::int32_t, kBlock> window_x;
  std::array<std::int32_t, kBlock> window_y;
  std::array<float, kBlock> depth;
  std::array<float, kBlock> per_w;
};

STILLFRAME_VECTOR_CLONES
void project(Block& block, std::size_t count, const Projection& projection) {
  const std::array<float, 16> m = projection.clip_from_points;
  const float half_width = projection.half_width;
  const float half_height = projection.half_height;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = block.x[i];
    const float y = block.y[i];
    const float z = block.z[i];
    const float clip_x = m[0] * x + m[4] * y + m[8] * z + m[12];
    const float clip_y = m[1] * x + m[5] * y + m[9] * z + m[13];
    const float clip_z = m[2] * x + m[6] * y + m[10] * z + m[14];
    const float clip_w = m[3] * x + m[7] * y + m[11] * z + m[15];
    // Not-a-number fails every comparison. Bitwise, so that no branch keeps the loop from being vectorised.
    const bool is_inside = (int{clip_w > 0.0F} & int{std::fabs(clip_x) <= clip_w} & int{std::fabs(clip_y) <= clip_w} &
                            int{clip_z > 0.0F} & int{clip_z <= clip_w}) != 0;
    const float per_w = 1.0F / clip_w;
    const float window_x = is_inside ? clip_x * per_w * half_width + half_width : 0.0F;
    const float window_y = is_inside ? clip_y * per_w * half_height + half_height : 0.0F;
    block.window_x[i] = static_cast<std::int32_t>(window_x + 0.5F);
    block.window_y[i] = static_cast<std::int32_t>(window_y + 0.5F);
    block.depth[i] = is_inside ? clip_z * per_w : 0.0F;
    block.per_w[i] = per_w;
  }
}

/// Edge of a point's square in the picture, at this 1 / w.
float sizePx(const Projection& projection, float per_w) {
  const float scale = projection.is_size_in_metres ? std::min(per_w, 1e6F) : 1.0F;
  return std::clamp(projection.size * scale, 1.0F, kMaxSizePx);
}

void scatter(const Block& block, std::span<const std::uint32_t> numbers, const Projection& projection,
             const PointCanvas& canvas) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (block.depth[i] <= 0.0F) {
      continue;
    }
    const std::uint64_t key = std::uint64_t{std::bit_cast<std::uint32_t>(block.depth[i])} << 32U |
                              static_cast<std::uint32_t>(~(projection.first_number + numbers[i]));
    if (projection.is_one_pixel) {
      canvas.onePixel(block.window_x[i], block.window_y[i], key);
    } else {
      const float size_px = sizePx(projection, block.per_w[i]);
      if (projection.is_round) {
        canvas.disc(block.window_x[i], block.window_y[i], size_px, key);
      } else {
        canvas.square(block.window_x[i], block.window_y[i], size_px, key);
      }
    }
  }
}

/// Positions as they are.
struct PlainPoints {
  const float* positions;

  glm::vec3 operator()(std::uint32_t number) const noexcept {
    const float* const point = positions + std::size_t{3} * number;
    return {point[0], point[1], point[2]};
  }
};

/// Pixels of a depth image; what is not to be drawn is nowhere.
struct RayPoints {
  const float* rays;
  const float* depths;
  float unit;
  float farthest;

  glm::vec3 operator()(std::uint32_t number) const noexcept {
    const float* const ray = rays + std::size_t{3} * number;
    const float depth = depths[number];
    const bool is_drawn = depth > 0.0F && depth <= farthest && ray[2] > 0.0F;
    const float scale = is_drawn ? depth * unit : std::numeric_limits<float>::quiet_NaN();
    return {ray[0] * scale, ray[1] * scale, ray[2] * scale};
  }
};

/// Collects points into blocks and draws each block that is full.
template <typename Points>
class Feeder {
 public:
  Feeder(const Points& points, const Projection& projection, const PointCanvas& canvas)
      : points_(points), projection_(projection), canvas_(canvas) {}

  void add(std::uint32_t number) {
    const glm::vec3 point = points_(number);
    block_.x[filled_] = point.x;
    block_.y[filled_] = point.y;
    block_.z[filled_] = point.z;
    numbers_[filled_] = number;
    if (++filled_ == kBlock) {
      flush();
    }
  }

  void flush() {
    project(block_, filled_, projection_);
    scatter(block_, std::span(numbers_).first(filled_), projection_, canvas_);
    filled_ = 0;
  }

 private:
  const Points points_;
  const Projection& projection_;
  const PointCanvas& canvas_;
  std::size_t filled_ = 0;
  std::array<std::uint32_t, kBlock> numbers_;
  Block block_;
};

Projection projectionOf(const PointBatch& batch, int width_px, int height_px, std::uint32_t first_number) {
  Projection made;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto column = static_cast<glm::length_t>(i / 4);
    const auto row = static_cast<glm::length_t>(i % 4);
    made.clip_from_points[i] = static_cast<float>(batch.clip_from_points[column][row]);
  }
  made.half_width = 0.5F * static_cast<float>(width_px) * static_cast<float>(kSubpixels);
  made.half_height = 0.5F * static_cast<float>(height_px) * static_cast<float>(kSubpixels);
  made.size = batch.size;
  made.is_size_in_metres = batch.is_size_in_metres;
  made.is_round = batch.is_round;
  made.is_one_pixel = !batch.is_size_in_metres && !(batch.size > 1.0F);
  made.first_number = first_number;
  return made;
}

/// The points of one group that the passes take, in the order of memory: a third of the time of their own order.
template <typename Points>
void drawGroup(Feeder<Points>& feeder, const GroupTurns& turns, std::uint32_t first, std::uint32_t end) {
  std::array<std::uint64_t, kPassesOfSample / 64> taken{};
  for (const PassRange& passes : {turns.first_lap, turns.second_lap}) {
    for (std::uint32_t pass = passes.first; pass < passes.end; ++pass) {
      const std::uint32_t place = placeInGroup(first / kPassesOfSample, pass);
      taken[place / 64] |= std::uint64_t{1} << (place % 64);
    }
  }
  for (std::size_t word = 0; word < taken.size(); ++word) {
    for (std::uint64_t left = taken[word]; left != 0; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(word * 64) + static_cast<std::uint32_t>(std::countr_zero(left));
      if (first + place < end) {
        feeder.add(first + place);
      }
    }
  }
}

/// A piece of a batch: what all threads need of it.
struct Piece {
  const PointBatch& batch;
  const Projection& projection;
  const PointCanvas& canvas;
  const BoxCull& cull;
  const BoxProjector& projector;
  const PassRange& passes;
};

/// What is to be drawn of a group: nothing where nothing of it shows.
GroupTurns turnsOfGroup(const Piece& piece, std::size_t group) {
  if (group >= piece.batch.boxes.size()) {
    return turnsOf(piece.passes, kPassesOfSample);
  }
  const PointBox& box = piece.batch.boxes[group];
  if (!piece.cull.mayBeSeen(box)) {
    return {};
  }
  const std::optional<BoxOnScreen> place = piece.projector.project(box);
  const GroupTurns turns = turnsOf(piece.passes, pointsWorthDrawing(piece.batch, place));
  constexpr std::uint32_t kPixelsAPoint = 4;  // to look at a pixel costs a tenth of a point
  const bool is_hidden = place && turns.count() > 0 &&
                         piece.canvas.isHidden(*place, sizePx(piece.projection, static_cast<float>(place->most_per_w)),
                                               std::size_t{turns.count()} * kPixelsAPoint);
  return is_hidden ? GroupTurns{} : turns;
}

/// Returns how many points were drawn.
template <typename Points>
std::size_t drawPiece(const Points& points, const Piece& piece, std::uint32_t begin, std::uint32_t end) {
  Feeder<Points> feeder(points, piece.projection, piece.canvas);
  std::size_t drawn = 0;
  for (std::uint32_t first = begin; first < end; first += kPassesOfSample) {
    const GroupTurns turns = turnsOfGroup(piece, first / kPassesOfSample);
    drawn += turns.count();
    if (turns.count() == kPassesOfSample) {
      const std::uint32_t behind = std::min(first + kPassesOfSample, end);
      for (std::uint32_t number = first; number < behind; ++number) {
        feeder.add(number);
      }
    } else if (turns.count() > 0) {
      drawGroup(feeder, turns, first, end);
    }
  }
  feeder.flush();
  return drawn;
}

}  // namespace

struct PointRaster::Threads {
  explicit Threads(unsigned count)
      : arena(count == 0 ? tbb::task_arena::automatic : static_cast<int>(count), 1, tbb::task_arena::priority::high) {}
  tbb::task_arena arena;
};

float PointKey::depth(std::uint64_t key) noexcept {
  return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32U));
}

PointRaster::PointRaster(unsigned threads) : threads_(std::make_unique<Threads>(threads)) {}

PointRaster::~PointRaster() = default;

void PointRaster::begin(int width_px, int height_px) {
  width_px_ = std::max(width_px, 0);
  height_px_ = std::max(height_px, 0);
  keys_.assign(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_), 0);
}

std::size_t PointRaster::draw(std::span<const PointBatch> batches, const PassRange& passes) {
  if (keys_.empty()) {
    return 0;
  }
  std::atomic<std::size_t> drawn{0};
  const PointCanvas canvas(keys_.data(), width_px_, height_px_);
  std::uint32_t first_number = 0;
  for (const PointBatch& batch : batches) {
    const Projection projection = projectionOf(batch, width_px_, height_px_, first_number);
    const BoxCull cull(batch.clip_from_points);
    const BoxProjector projector(batch.clip_from_points, width_px_, height_px_);
    const Piece shared{batch, projection, canvas, cull, projector, passes};
    const bool has_depths = !batch.depths.empty();
    const std::size_t count = has_depths ? std::min(batch.count(), batch.depths.size()) : batch.count();
    threads_->arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, (count + kPiece - 1) / kPiece, [&](std::size_t piece) {
        const auto begin = static_cast<std::uint32_t>(piece * kPiece);
        const auto end = static_cast<std::uint32_t>(std::min(piece * kPiece + kPiece, count));
        if (has_depths) {
          const RayPoints points{batch.positions.data(), batch.depths.data(), batch.unit, batch.farthest};
          drawn += drawPiece(points, shared, begin, end);
        } else {
          drawn += drawPiece(PlainPoints{batch.positions.data()}, shared, begin, end);
        }
      });
    });
    first_number += static_cast<std::uint32_t>(batch.count());
  }
  return drawn;
}

void PointRaster::resolve(const PointShading& shading, std::span<std::uint16_t> rgba, std::span<float> depth,
                          const glm::vec4& background) const {
  constexpr std::uint16_t kOne = 0x3c00;
  constexpr std::size_t kPixels = 16384;
  const std::size_t count = std::min({keys_.size(), rgba.size() / 4, depth.size()});
  const std::array<std::uint16_t, 4> empty{halfFromFloat(background.r), halfFromFloat(background.g),
                                           halfFromFloat(background.b), halfFromFloat(background.a)};
  const auto resolvePixels = [&](const tbb::blocked_range<std::size_t>& pixels) {
    for (std::size_t pixel = pixels.begin(); pixel < pixels.end(); ++pixel) {
      const std::uint64_t key = keys_[pixel];
      depth[pixel] = PointKey::depth(key);
      std::uint16_t* const out = &rgba[4 * pixel];
      if (key == 0) {
        std::ranges::copy(empty, out);
        continue;
      }
      const glm::vec4 color = shading.linearColor(PointKey::point(key));
      out[0] = halfFromFloat(color.r);
      out[1] = halfFromFloat(color.g);
      out[2] = halfFromFloat(color.b);
      out[3] = color.a > 0.0F ? kOne : std::uint16_t{0};
    }
  };
  threads_->arena.execute(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kPixels), resolvePixels); });
}

}  // namespace stillframe::scenegraph
