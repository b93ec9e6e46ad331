#include "nodes/points/convert_cloud.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "nodes/points/copy_points.h"
#include "nodes/points/read_value.h"

namespace stillframe::nodes {
namespace {

using scenegraph::FieldType;
using scenegraph::PackedField;
using scenegraph::PointCloud;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What grows while points are read.
struct Progress {
  ConvertedCloud& cloud;
  const std::byte* data;
  const std::byte* data_end;
  float* out;
  const float* out_end;
  glm::dvec3 low{kInfinity};
  glm::dvec3 high{-kInfinity};
  bool run_open = false;

  void keep(const std::byte* point, std::size_t count) {
    if (!run_open) {
      cloud.runs.push_back({static_cast<std::size_t>(point - data), 0});
      run_open = true;
    }
    cloud.runs.back().count += count;
    cloud.points += count;
  }
  void drop(bool is_finite) {
    run_open = false;
    ++(is_finite ? cloud.out_of_reach : cloud.not_finite);
  }
  void point(const std::byte* at, const glm::dvec3& p) {
    constexpr double kReach = ConvertedCloud::kReach;
    if (!(std::abs(p.x) <= kReach && std::abs(p.y) <= kReach && std::abs(p.z) <= kReach)) {
      drop(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      return;
    }
    keep(at, 1);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
      *out++ = static_cast<float>(p[axis]);
    }
  }
};

/// Coordinates of any type each, one indirect call per value.
struct MixedReader {
  std::array<ValueReader, 3> read;
  std::array<std::size_t, 3> offset;

  glm::dvec3 operator()(const std::byte* at) const noexcept {
    return {read[0](at + offset[0]), read[1](at + offset[1]), read[2](at + offset[2])};
  }
};

/// Coordinates of one type, inlined.
template <typename T, bool kSwapped>
struct UniformReader {
  std::array<std::size_t, 3> offset;

  glm::dvec3 operator()(const std::byte* at) const noexcept {
    return {static_cast<double>(readValue<T, kSwapped>(at + offset[0])),
            static_cast<double>(readValue<T, kSwapped>(at + offset[1])),
            static_cast<double>(readValue<T, kSwapped>(at + offset[2]))};
  }
};

template <typename Reader>
void convertRow(const std::byte* row, std::size_t count, std::size_t step, const Reader& read, Progress& progress) {
  for (std::size_t i = 0; i < count; ++i, row += step) {
    progress.point(row, read(row));
  }
}

/// Blocks that can be copied from `at` without reading past the data or writing past the room.
std::size_t copyableBlocks(const std::byte* at, std::size_t points, std::size_t step, const Progress& progress) {
  constexpr std::size_t kRead = 4 * sizeof(float);  // a point
  const auto readable = static_cast<std::size_t>(progress.data_end - at);
  const auto writable = static_cast<std::size_t>(progress.out_end - progress.out);
  if (readable < kRead || writable == 0) {
    return 0;
  }
  const std::size_t readable_points = (readable - kRead) / step + 1;
  return std::min({points / kCopyBlock, readable_points / kCopyBlock, (writable - 1) / (3 * kCopyBlock)});
}

/// Native FLOAT32 x, y, z in a row at `offset`: block by block, and one by one where a block will not do.
void convertRowFloat3(const std::byte* row, std::size_t count, std::size_t step, std::size_t offset,
                      Progress& progress) {
  const UniformReader<float, false> read{{offset, offset + 4, offset + 8}};
  const float inf = std::numeric_limits<float>::infinity();
  FloatBox box{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (std::size_t i = 0; i < count;) {
    const std::byte* const at = row + i * step;
    const std::size_t wanted = copyableBlocks(at + offset, count - i, step, progress);
    const CopiedPoints copied = copyPoints(at + offset, step, wanted, ConvertedCloud::kReach, progress.out, box);
    if (copied.blocks > 0) {
      progress.keep(at, copied.blocks * kCopyBlock);
      progress.out += 3 * kCopyBlock * copied.blocks;
      i += copied.blocks * kCopyBlock;
    }
    // Where nothing can be copied, the rest one by one.
    const std::size_t doubtful = wanted == 0 ? kCopyBlock : copied.doubtful;
    for (const std::size_t end = std::min(i + doubtful, count); i < end; ++i) {
      progress.point(row + i * step, read(row + i * step));
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto lane = static_cast<std::size_t>(axis);
    progress.low[axis] = std::min(progress.low[axis], static_cast<double>(box.low[lane]));
    progress.high[axis] = std::max(progress.high[axis], static_cast<double>(box.high[lane]));
  }
}

template <typename Row>
void forEachRow(const CloudLayout& layout, Progress& progress, const Row& convert) {
  for (std::size_t row = 0; row < layout.rows; ++row) {
    // A run may cross a row border only when there is no padding, and then there is just one row.
    progress.run_open = false;
    convert(progress.data + row * layout.row_step);
  }
}

/// Second pass: the kept points again, in double, relative to the origin.
void writeRelative(const MixedReader& read, const ConvertedCloud& cloud, const std::byte* data, float* out) {
  for (const PointRun& run : cloud.runs) {
    const std::byte* at = data + run.offset;
    for (std::size_t i = 0; i < run.count; ++i, at += cloud.point_step) {
      const glm::dvec3 p = read(at) - cloud.origin;
      *out++ = static_cast<float>(p.x);
      *out++ = static_cast<float>(p.y);
      *out++ = static_cast<float>(p.z);
    }
  }
}

}  // namespace

std::expected<ConvertedCloud, CloudError> convertCloud(const PointCloud& cloud, const FloatSink& positions) {
  const auto checked = checkLayout(cloud);
  if (!checked) {
    return std::unexpected(checked.error());
  }
  const CloudLayout& layout = *checked;
  ConvertedCloud converted;
  converted.point_step = layout.point_step;
  if (layout.points() == 0) {
    return converted;
  }
  const auto& [x, y, z] = layout.xyz;
  const std::array<std::size_t, 3> offsets{x->offset, y->offset, z->offset};
  const std::byte* const data = cloud.data.bytes.data();
  float* const out = positions(3 * layout.points());
  Progress progress{converted, data, data + cloud.data.bytes.size(), out, out + 3 * layout.points()};
  const MixedReader mixed{{valueReader(x->type, cloud.is_bigendian), valueReader(y->type, cloud.is_bigendian),
                           valueReader(z->type, cloud.is_bigendian)},
                          offsets};
  const std::size_t step = layout.point_step;
  const std::size_t count = layout.points_per_row;
  const bool is_uniform = x->type == y->type && y->type == z->type;
  const bool is_native = cloud.is_bigendian == (std::endian::native == std::endian::big);
  if (is_uniform && x->type == FieldType::Float32 && is_native && offsets[1] == offsets[0] + 4 &&
      offsets[2] == offsets[0] + 8) {
    forEachRow(layout, progress,
               [&](const std::byte* row) { convertRowFloat3(row, count, step, offsets[0], progress); });
  } else if (is_uniform) {
    withFieldType(x->type, cloud.is_bigendian, [&]<typename T, bool kSwapped>() {
      const UniformReader<T, kSwapped> read{offsets};
      forEachRow(layout, progress, [&](const std::byte* row) { convertRow(row, count, step, read, progress); });
    });
  } else {
    forEachRow(layout, progress, [&](const std::byte* row) { convertRow(row, count, step, mixed, progress); });
  }
  if (converted.points == 0) {
    return converted;
  }
  converted.box_min = progress.low;
  converted.box_max = progress.high;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = progress.low[axis];
    const double high = progress.high[axis];
    if (std::max(std::abs(low), std::abs(high)) > ConvertedCloud::kNearby) {
      converted.origin[axis] = std::rint(low / 2 + high / 2);
    }
  }
  if (converted.origin != glm::dvec3(0.0)) {
    writeRelative(mixed, converted, data, out);
  }
  return converted;
}

}  // namespace stillframe::nodes
