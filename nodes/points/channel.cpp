#include "nodes/points/channel.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "nodes/points/point_colors.h"
#include "nodes/points/point_pieces.h"
#include "nodes/points/read_value.h"

namespace stillframe::nodes {
namespace {

using scenegraph::PackedField;
using scenegraph::PointCloud;

/// Beyond this not every integer has its own float.
constexpr double kExactIntegers = 16'777'216.0;

float toArray(double value) noexcept {
  constexpr double kReach = kValueReach;
  return std::isnan(value) ? kMissingValue : static_cast<float>(std::clamp(value, -kReach, kReach));
}

/// What the values of some points come to.
template <typename T>
struct Reach {
  // Narrow integers and floats are exact in float, so their limits can be found there.
  using Limit =
      std::conditional_t<std::is_same_v<T, double> || (std::is_integral_v<T> && sizeof(T) == 4), double, float>;
  Limit low = std::numeric_limits<Limit>::infinity();
  Limit high = -std::numeric_limits<Limit>::infinity();
  std::size_t finite = 0;
};

template <typename T, bool kSwapped>
Reach<T> readValues(const std::byte* at, std::size_t count, std::size_t step, float* out, Reach<T> reach) {
  using Limit = typename Reach<T>::Limit;
  for (std::size_t i = 0; i < count; ++i, at += step) {
    const auto value = static_cast<Limit>(readValue<T, kSwapped>(at));
    bool is_finite = true;
    if constexpr (std::is_floating_point_v<T>) {
      is_finite = std::abs(value) <= std::numeric_limits<Limit>::max();
      constexpr Limit kReach = kValueReach;
      const auto clamped = static_cast<float>(value < -kReach ? -kReach : value > kReach ? kReach : value);
      *out++ = std::isnan(value) ? kMissingValue : clamped;
    } else {
      *out++ = static_cast<float>(value);
    }
    // Without a branch: what is not finite is no limit.
    reach.low = is_finite && value < reach.low ? value : reach.low;
    reach.high = is_finite && value > reach.high ? value : reach.high;
    reach.finite += is_finite ? 1 : 0;
  }
  return reach;
}

template <typename T>
Reach<T> joined(const Reach<T>& a, const Reach<T>& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high), a.finite + b.finite};
}

template <typename T>
ChannelValues valuesOf(const Reach<T>& reach) {
  if (reach.finite == 0) {
    return {};
  }
  return {.offset = 0.0,
          .low = static_cast<double>(reach.low),
          .high = static_cast<double>(reach.high),
          .finite = reach.finite};
}

template <typename T, bool kSwapped>
ChannelValues readChannel(const std::byte* data, const ConvertedCloud& converted, std::size_t field_offset,
                          std::span<float> values) {
  const std::vector<PointPiece> pieces = piecesOf(converted);
  std::vector<Reach<T>> reaches(pieces.size());
  forPieces(converted, pieces, [&](std::size_t piece, std::size_t offset, std::size_t count, std::size_t first) {
    reaches[piece] = readValues<T, kSwapped>(data + offset + field_offset, count, converted.point_step,
                                             values.data() + first, reaches[piece]);
  });
  Reach<T> all;
  for (const Reach<T>& reach : reaches) {
    all = joined(all, reach);
  }
  return valuesOf(all);
}

template <typename T, bool kSwapped>
void rewriteRelative(const std::byte* data, const ConvertedCloud& converted, std::size_t field_offset, double offset,
                     std::span<float> values) {
  const auto rewrite = [&](std::size_t /*piece*/, std::size_t place, std::size_t count, std::size_t first) {
    const std::byte* at = data + place + field_offset;
    for (std::size_t i = 0; i < count; ++i, at += converted.point_step) {
      values[first + i] = toArray(static_cast<double>(readValue<T, kSwapped>(at)) - offset);
    }
  };
  forPieces(converted, piecesOf(converted), rewrite);
}

/// `found` of values that were read as they are; where floats would not tell them apart, they are written anew.
ChannelValues toldApart(ChannelValues found, const PointCloud& cloud, const ConvertedCloud& converted,
                        const ChannelInfo& channel, std::span<float> values) {
  if (std::max(std::abs(found.low), std::abs(found.high)) > kExactIntegers) {
    found.offset = std::rint(found.low / 2 + found.high / 2);
    withFieldType(channel.type, cloud.is_bigendian, [&]<typename T, bool kSwapped>() {
      rewriteRelative<T, kSwapped>(cloud.data.bytes.data(), converted, channel.offset, found.offset, values);
    });
  }
  return found;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

bool isTimeField(std::string_view name) {
  static constexpr std::array<std::string_view, 19> kNames = {
      "t",        "ts",          "time",       "times",        "timestamp",     "timestamps",   "time_stamp",
      "stamp",    "t_ns",        "time_ns",    "timestamp_ns", "time_us",       "timestamp_us", "time_offset",
      "t_offset", "offset_time", "timeoffset", "offsettime",   "time_offset_ns"};
  return std::ranges::find(kNames, lowerCase(name)) != kNames.end();
}

std::vector<ChannelInfo> listChannels(const PointCloud& cloud) {
  const std::optional<ColorSource> colors = findColors(cloud);
  std::vector<ChannelInfo> channels;
  const auto add = [&](ChannelInfo channel) {
    const bool is_new = std::ranges::none_of(channels, [&](const ChannelInfo& c) { return c.name == channel.name; });
    if (is_new) {
      channels.push_back(std::move(channel));
    }
  };
  for (const PackedField& field : cloud.fields) {
    const bool is_position = field.name == "x" || field.name == "y" || field.name == "z";
    const std::uint32_t bytes = scenegraph::byteSize(field.type);
    if (is_position || bytes == 0 || isTimeField(field.name) || (colors && isColorField(*colors, field.name))) {
      continue;
    }
    if (field.count <= 1) {
      add({field.name, field.offset, field.type});
      continue;
    }
    for (std::uint32_t i = 0; i < std::min(field.count, kMaxChannelValues); ++i) {
      add({field.name + "[" + std::to_string(i) + "]", field.offset + i * bytes, field.type});
    }
  }
  return channels;
}

ChannelValues convertChannel(const PointCloud& cloud, const ConvertedCloud& converted, const ChannelInfo& channel,
                             std::span<float> values) {
  ChannelValues result;
  const std::byte* const data = cloud.data.bytes.data();
  withFieldType(channel.type, cloud.is_bigendian, [&]<typename T, bool kSwapped>() {
    result = readChannel<T, kSwapped>(data, converted, channel.offset, values);
  });
  return toldApart(result, cloud, converted, channel, values);
}

ChannelAlong::ChannelAlong(const PointCloud& cloud, ChannelInfo channel, Room room)
    : cloud_(cloud), channel_(std::move(channel)), room_(std::move(room)) {}

void ChannelAlong::begin(std::size_t points) { values_ = room_(points); }

void ChannelAlong::add(std::span<const PointRun> runs, std::size_t place) {
  ChannelValues found;
  withFieldType(channel_.type, cloud_.is_bigendian, [&]<typename T, bool kSwapped>() {
    const std::byte* const data = cloud_.data.bytes.data() + channel_.offset;
    float* to = values_ + place;
    Reach<T> reach;
    for (const PointRun& run : runs) {
      reach = readValues<T, kSwapped>(data + run.offset, run.count, cloud_.point_step, to, reach);
      to += run.count;
    }
    found = valuesOf(reach);
  });
  if (found.finite == 0) {
    return;
  }
  const std::scoped_lock lock(mutex_);
  const bool is_first = found_.finite == 0;
  found_.low = is_first ? found.low : std::min(found_.low, found.low);
  found_.high = is_first ? found.high : std::max(found_.high, found.high);
  found_.finite += found.finite;
}

void ChannelAlong::move(std::size_t from, std::size_t count, std::size_t to) {
  std::memmove(values_ + to, values_ + from, count * sizeof(float));
}

ChannelValues ChannelAlong::finish(const ConvertedCloud& converted) {
  return toldApart(found_, cloud_, converted, channel_, {values_, converted.points});
}

}  // namespace stillframe::nodes
