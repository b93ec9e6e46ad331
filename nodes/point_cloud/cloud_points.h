#pragma once

#include <array>
#include <cstddef>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <osg/Array>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/points/channel.h"
#include "nodes/points/convert_cloud.h"
#include "nodes/points/point_colors.h"
#include "nodes/points/value_range.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// A channel as it is uploaded, with what its colours need.
struct CloudChannel {
  osg::ref_ptr<osg::FloatArray> values;
  ChannelValues limits;
};

/// What a message said that its cloud does not.
struct CloudSupplement {
  std::size_t left_out = 0;  ///< points of the message that did not get into the cloud
  double duration_s = 0.0;   ///< from its first to its last point, those left out too; 0: all at once
};

/// A cloud in the form that is drawn: positions now, channels and colours when first asked for.
///
/// Made on a worker, cached, shared by all views; the arrays are uploaded once per context and never written again.
/// channel(), colors() and the percentiles convert on first use (some milliseconds per million points) and remember;
/// any thread may call them.
///
/// The bytes of the message, as many as all of this and more, need not stay: settle() lets them go, and what asks for
/// them later has them read again (message()).
class CloudPoints {
 public:
  using ReadMessage = std::function<std::shared_ptr<const scenegraph::PointCloud>()>;
  /// Which channel of a cloud will be asked for, if any, by what it could have: its points are not there yet.
  using WantedChannel = std::function<std::optional<std::string>(const CloudPoints&)>;
  /// The wanted channel is made in the same pass over the data.
  [[nodiscard]] static std::expected<CloudPoints, scenegraph::Status> make(
      std::shared_ptr<const scenegraph::PointCloud> cloud, const CloudSupplement& supplement = {},
      const WantedChannel& wanted = nullptr);
  CloudPoints(CloudPoints&&) noexcept;
  CloudPoints& operator=(CloudPoints&&) noexcept;
  ~CloudPoints();

  /// Lets go of the message's bytes where they are more than kSmallBytes; `read` brings them again, or nullptr.
  void settle(ReadMessage read);
  static constexpr std::size_t kSmallBytes = std::size_t{1} << 20;

  /// The message, all but its bytes.
  [[nodiscard]] const scenegraph::PointCloud& source() const noexcept { return *cloud_; }
  /// The message as it came; nullptr when it cannot be read any longer. Where it was let go of, reading takes some
  /// milliseconds per million points.
  [[nodiscard]] std::shared_ptr<const scenegraph::PointCloud> message() const;
  /// The same for who will ask again: it stays until the cloud is no longer shown (releaseGlObjects()).
  [[nodiscard]] std::shared_ptr<const scenegraph::PointCloud> holdMessage() const;
  [[nodiscard]] std::size_t messageBytes() const noexcept { return message_bytes_; }
  [[nodiscard]] const CloudSupplement& supplement() const noexcept { return supplement_; }
  [[nodiscard]] const ConvertedCloud& converted() const noexcept { return converted_; }
  [[nodiscard]] osg::Vec3Array* positions() const noexcept { return positions_.get(); }
  [[nodiscard]] const std::vector<ChannelInfo>& channels() const noexcept { return channels_; }
  [[nodiscard]] bool hasColors() const noexcept { return color_source_.has_value(); }

  /// nullptr when there is no channel of that name. Valid as long as this.
  [[nodiscard]] const CloudChannel* channel(std::string_view name) const;
  /// nullptr without per-point colour.
  [[nodiscard]] osg::Vec4ubArray* colors() const;
  /// Percentiles of a channel; {0, 0} when there is none of that name.
  [[nodiscard]] ValueRange channelPercentiles(std::string_view name, double low, double high) const;
  /// Percentiles of x (0), y (1) or z (2) in the cloud's own coordinates.
  [[nodiscard]] ValueRange axisPercentiles(int axis, double low, double high) const;
  /// The same of all three axes, of a fair sample of the points, in some milliseconds: exact where they are few.
  [[nodiscard]] std::array<ValueRange, 3> sampledPercentiles(double low, double high) const;

  /// Remembers that some work upon this is done, by a name of its own.
  void notePrepared(const std::string& work) const;
  [[nodiscard]] bool isPrepared(const std::string& work) const;

  /// Frees the arrays on the GPU, in every context; the next draw uploads them again. GUI thread.
  void releaseGlObjects() const;

  /// Of what has been made so far, and the message where it stays.
  [[nodiscard]] std::size_t byteSize() const;

 private:
  struct Lazy;
  CloudPoints();
  [[nodiscard]] const ChannelInfo* findChannel(std::string_view name) const;

  std::shared_ptr<const scenegraph::PointCloud> cloud_;  // without its bytes once `read_` brings them
  std::size_t message_bytes_ = 0;
  ReadMessage read_;
  CloudSupplement supplement_;
  ConvertedCloud converted_;
  osg::ref_ptr<osg::Vec3Array> positions_;
  std::vector<ChannelInfo> channels_;
  std::optional<ColorSource> color_source_;
  std::unique_ptr<Lazy> lazy_;
};

}  // namespace stillframe::nodes
