#pragma once

#include <cstdint>
#include <optional>

#include "tf/time.h"
#include "viewer/time/time_text.h"

namespace stillframe::viewer {

/// How a recording is played.
struct PlaybackSettings {
  double speed = 1.0;
  bool loops = false;
  friend bool operator==(const PlaybackSettings&, const PlaybackSettings&) = default;
};

/// Tracker time from elapsed steady time: a late call skips ahead instead of falling behind, so ticks never pile up.
///
/// Pure: the caller brings the clock (nanoseconds of any steady clock). Any single thread.
class PlaybackClock {
 public:
  /// Starts, or goes on from another place; at or past the end it starts over from the beginning.
  void start(std::int64_t now_ns, tf::TimePoint from, const TimeRange& range, const PlaybackSettings& settings);

  struct Reading {
    tf::TimePoint time;
    bool ended = false;  ///< the end is reached and the clock does not loop
  };
  [[nodiscard]] Reading read(std::int64_t now_ns) const;

 private:
  std::int64_t started_ns_ = 0;
  tf::TimePoint from_;
  TimeRange range_;
  PlaybackSettings settings_;
};

}  // namespace stillframe::viewer
