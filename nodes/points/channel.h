#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/points/convert_cloud.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// A number that every point of a cloud carries and that can colour it.
struct ChannelInfo {
  std::string name;  ///< of the field; "name[i]" when the field has several values
  std::uint32_t offset = 0;
  scenegraph::FieldType type = scenegraph::FieldType::Unknown;
};

/// What a cloud can be coloured by besides its position: every numeric field in order, except x, y, z, the colour
/// fields, the time of a point (`t`, `time`, `timestamp`, `offset_time`, ...), and repeated names. Of a field with
/// several values the first kMaxValues are listed.
[[nodiscard]] std::vector<ChannelInfo> listChannels(const scenegraph::PointCloud& cloud);
inline constexpr std::uint32_t kMaxChannelValues = 256;

[[nodiscard]] bool isTimeField(std::string_view name);

/// What stands in the array for NaN; finite, because text formats and some drivers do not keep NaN.
inline constexpr float kMissingValue = -3.0e38F;
/// Infinities and doubles beyond this become this; the shader's clamp makes them the ends of the colormap.
inline constexpr float kValueReach = 1.0e37F;

/// One channel of the points of a ConvertedCloud.
struct ChannelValues {
  double offset = 0.0;  ///< value = array + offset; non-zero when values exceed 2^24, so that large integers stay apart
  double low = 0.0;     ///< of the finite values; meaningful when finite > 0
  double high = 0.0;
  std::size_t finite = 0;
};

/// Writes `converted.points` values of `channel` to `values`. The cloud is the one that was converted. Any thread.
ChannelValues convertChannel(const scenegraph::PointCloud& cloud, const ConvertedCloud& converted,
                             const ChannelInfo& channel, std::span<float> values);

/// The same made in one pass with the positions: given to convertCloud(), whose cloud it is, and finished after that.
class ChannelAlong final : public AlongPositions {
 public:
  /// Called once at most: room for the values of so many points.
  using Room = std::function<float*(std::size_t points)>;
  /// `cloud` outlives it.
  ChannelAlong(const scenegraph::PointCloud& cloud, ChannelInfo channel, Room room);

  void begin(std::size_t points) override;
  void add(std::span<const PointRun> runs, std::size_t place) override;
  void move(std::size_t from, std::size_t count, std::size_t to) override;
  [[nodiscard]] ChannelValues finish(const ConvertedCloud& converted);

 private:
  const scenegraph::PointCloud& cloud_;
  ChannelInfo channel_;
  Room room_;
  float* values_ = nullptr;
  std::mutex mutex_;  // guards found_
  ChannelValues found_;
};

}  // namespace stillframe::nodes
