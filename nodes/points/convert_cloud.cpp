#include "nodes/points/convert_cloud.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "nodes/points/copy_points.h"
#include "nodes/points/point_pieces.h"
#include "nodes/points/read_value.h"
#include "scenegraph/raster/background_tasks.h"

namespace stillframe::nodes {
namespace {

using scenegraph::FieldType;
using scenegraph::kPassesOfSample;
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

/// Points that one thread converts: some rows, or a piece of the only one.
struct Part {
  std::size_t first_row = 0;
  std::size_t rows = 1;
  std::size_t first = 0;  // in its rows
  std::size_t count = 0;  // a row

  /// Points before it.
  [[nodiscard]] std::size_t place(const CloudLayout& layout) const { return first_row * layout.points_per_row + first; }
};

/// The same whatever the number of threads. A part takes half a millisecond.
std::vector<Part> partsOf(const CloudLayout& layout) {
  constexpr std::size_t kPoints = std::size_t{1} << 18U;
  std::vector<Part> parts;
  if (layout.rows == 1) {
    for (std::size_t first = 0; first < layout.points_per_row; first += kPoints) {
      parts.push_back({.first = first, .count = std::min(kPoints, layout.points_per_row - first)});
    }
  } else {
    const std::size_t rows = std::max<std::size_t>(kPoints / layout.points_per_row, 1);
    for (std::size_t row = 0; row < layout.rows; row += rows) {
      parts.push_back(
          {.first_row = row, .rows = std::min(rows, layout.rows - row), .first = 0, .count = layout.points_per_row});
    }
  }
  return parts;
}

/// What one part came to; its positions begin where they would if nothing had been dropped anywhere.
struct PartResult {
  ConvertedCloud cloud;
  glm::dvec3 low{kInfinity};
  glm::dvec3 high{-kInfinity};
};

/// Where points go.
struct Room {
  float* out;  // positions
  AlongPositions* along;
};

/// Puts the results of parts behind each other, as if one thread had gone through all. Run by run it is nearly nothing;
/// positions move where points were dropped before them, and their groups are others then.
class Joiner {
 public:
  Joiner(const CloudLayout& layout, const Room& room) : layout_(layout), room_(room) {
    joined_.cloud.point_step = layout.point_step;
  }

  /// The parts in their order.
  void add(const Part& part, const PartResult& result) {
    ConvertedCloud& all = joined_.cloud;
    const ConvertedCloud& cloud = result.cloud;
    if (const std::size_t from = part.place(layout_); from != all.points && cloud.points > 0) {
      std::memmove(room_.out + 3 * all.points, room_.out + 3 * from, 3 * cloud.points * sizeof(float));
      if (room_.along != nullptr) {
        room_.along->move(from, cloud.points, all.points);
      }
    }
    for (const PointRun& run : cloud.runs) {
      if (!all.runs.empty() && all.runs.back().offset + all.runs.back().count * all.point_step == run.offset) {
        all.runs.back().count += run.count;
      } else {
        all.runs.push_back(run);
      }
    }
    const std::size_t groups_before = all.points / kPassesOfSample;
    const bool begins_group = all.points % kPassesOfSample == 0;
    all.points += cloud.points;
    all.not_finite += cloud.not_finite;
    all.out_of_reach += cloud.out_of_reach;
    joined_.low = glm::min(joined_.low, result.low);
    joined_.high = glm::max(joined_.high, result.high);
    if (begins_group && !cloud.boxes.empty()) {
      all.boxes.insert(all.boxes.end(), cloud.boxes.begin(), cloud.boxes.end());
    } else if (cloud.points > 0) {
      const std::size_t first = groups_before * kPassesOfSample;
      const auto boxes = scenegraph::boxesOf({room_.out + 3 * first, 3 * (all.points - first)});
      all.boxes.resize(groups_before);  // without one of a part of a group
      all.boxes.insert(all.boxes.end(), boxes.begin(), boxes.end());
    }
  }
  [[nodiscard]] PartResult take() { return std::move(joined_); }

 private:
  const CloudLayout& layout_;
  Room room_;
  PartResult joined_;
};

/// `work(first, end)` of all parts: of those whose data is there, and then of the next. False when it comes to no good
/// end.
template <typename Work>
bool asTheyCome(const std::vector<Part>& parts, const CloudLayout& layout, const scenegraph::Payload& data,
                const Work& work) {
  if (data.arrival == nullptr) {
    work(0, parts.size());
    return true;
  }
  constexpr std::size_t kReadPast = 4 * sizeof(float);  // a block's last point
  const auto endOf = [&](const Part& part) {
    const std::size_t end =
        (part.first_row + part.rows - 1) * layout.row_step + (part.first + part.count) * layout.point_step + kReadPast;
    return data.place + std::min(end, data.bytes.size());
  };
  for (std::size_t done = 0; done < parts.size();) {
    const auto there = data.arrival->wait(endOf(parts[done]));
    if (!there) {
      return false;
    }
    std::size_t next = done + 1;
    while (next < parts.size() && endOf(parts[next]) <= *there) {
      ++next;
    }
    work(done, next);
    done = next;
  }
  return data.arrival->waitForAll();
}

/// `convert(row, count, progress)` of all parts; nullopt when their data does not come.
template <typename Convert>
std::optional<PartResult> convertParts(const CloudLayout& layout, const scenegraph::Payload& payload, const Room& room,
                                       const Convert& convert) {
  const std::span<const std::byte> data = payload.bytes;
  const std::vector<Part> parts = partsOf(layout);
  std::vector<PartResult> results(parts.size());
  const auto convertPart = [&](std::size_t number) {
    const Part& part = parts[number];
    PartResult& result = results[number];
    result.cloud.point_step = layout.point_step;
    float* const place = room.out + 3 * part.place(layout);
    Progress progress{result.cloud, data.data(), data.data() + data.size(), place, place + 3 * part.rows * part.count};
    for (std::size_t row = part.first_row; row < part.first_row + part.rows; ++row) {
      // A run may cross a row border only when there is no padding, and then there is just one row.
      progress.run_open = false;
      convert(data.data() + row * layout.row_step + part.first * layout.point_step, part.count, progress);
    }
    result.low = progress.low;
    result.high = progress.high;
    if (layout.rows == 1) {
      result.cloud.boxes = scenegraph::boxesOf({place, 3 * result.cloud.points});  // while they are in the cache
    }
    if (room.along != nullptr) {
      room.along->add(result.cloud.runs, part.place(layout));
    }
  };
  Joiner joiner(layout, room);
  const bool is_whole = asTheyCome(parts, layout, payload, [&](std::size_t first, std::size_t end) {
    scenegraph::runInBackground(end - first, [&](std::size_t number) { convertPart(first + number); });
    for (; first < end; ++first) {
      joiner.add(parts[first], results[first]);
    }
  });
  return is_whole ? std::optional(joiner.take()) : std::nullopt;
}

/// Second pass: the kept points again, in double, relative to the origin.
void writeRelative(const MixedReader& read, const ConvertedCloud& cloud, const std::byte* data, float* out) {
  const auto write = [&](std::size_t /*piece*/, std::size_t offset, std::size_t count, std::size_t first) {
    const std::byte* at = data + offset;
    float* to = out + 3 * first;
    for (std::size_t i = 0; i < count; ++i, at += cloud.point_step) {
      const glm::dvec3 p = read(at) - cloud.origin;
      *to++ = static_cast<float>(p.x);
      *to++ = static_cast<float>(p.y);
      *to++ = static_cast<float>(p.z);
    }
  };
  forPieces(cloud, piecesOf(cloud), write);
}

}  // namespace

std::expected<ConvertedCloud, CloudError> convertCloud(const PointCloud& cloud, const FloatSink& positions,
                                                       AlongPositions* along) {
  const auto checked = checkLayout(cloud);
  if (!checked) {
    return std::unexpected(checked.error());
  }
  const CloudLayout& layout = *checked;
  const CloudError no_end{CloudErrorCode::MalformedCloud, "its data does not come to a good end"};
  if (layout.points() == 0) {
    if (cloud.data.arrival != nullptr && !cloud.data.arrival->waitForAll()) {
      return std::unexpected(no_end);
    }
    ConvertedCloud nothing;
    nothing.point_step = layout.point_step;
    return nothing;
  }
  const auto& [x, y, z] = layout.xyz;
  const std::array<std::size_t, 3> offsets{x->offset, y->offset, z->offset};
  const Room room{positions(3 * layout.points()), along};
  if (along != nullptr) {
    along->begin(layout.points());
  }
  const MixedReader mixed{{valueReader(x->type, cloud.is_bigendian), valueReader(y->type, cloud.is_bigendian),
                           valueReader(z->type, cloud.is_bigendian)},
                          offsets};
  const std::size_t step = layout.point_step;
  const bool is_uniform = x->type == y->type && y->type == z->type;
  const bool is_native = cloud.is_bigendian == (std::endian::native == std::endian::big);
  std::optional<PartResult> joined;
  if (is_uniform && x->type == FieldType::Float32 && is_native && offsets[1] == offsets[0] + 4 &&
      offsets[2] == offsets[0] + 8) {
    joined = convertParts(layout, cloud.data, room, [&](const std::byte* row, std::size_t count, Progress& progress) {
      convertRowFloat3(row, count, step, offsets[0], progress);
    });
  } else if (is_uniform) {
    withFieldType(x->type, cloud.is_bigendian, [&]<typename T, bool kSwapped>() {
      const UniformReader<T, kSwapped> read{offsets};
      joined = convertParts(layout, cloud.data, room, [&](const std::byte* row, std::size_t count, Progress& progress) {
        convertRow(row, count, step, read, progress);
      });
    });
  } else {
    joined = convertParts(layout, cloud.data, room, [&](const std::byte* row, std::size_t count, Progress& progress) {
      convertRow(row, count, step, mixed, progress);
    });
  }
  if (!joined) {
    return std::unexpected(no_end);
  }
  ConvertedCloud converted = std::move(joined->cloud);
  if (converted.points == 0) {
    return converted;
  }
  converted.box_min = joined->low;
  converted.box_max = joined->high;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = joined->low[axis];
    const double high = joined->high[axis];
    if (std::max(std::abs(low), std::abs(high)) > ConvertedCloud::kNearby) {
      converted.origin[axis] = std::rint(low / 2 + high / 2);
    }
  }
  if (converted.origin != glm::dvec3(0.0)) {
    writeRelative(mixed, converted, cloud.data.bytes.data(), room.out);
    converted.boxes = scenegraph::boxesOf({room.out, 3 * converted.points});
  }
  return converted;
}

}  // namespace stillframe::nodes
