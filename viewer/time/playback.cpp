#include "viewer/time/playback.h"

#include <cmath>

namespace stillframe::viewer {

void PlaybackClock::start(std::int64_t now_ns, tf::TimePoint from, const TimeRange& range,
                          const PlaybackSettings& settings) {
  started_ns_ = now_ns;
  range_ = range;
  settings_ = settings;
  from_ = from >= range.last || from < range.first ? range.first : from;
}

PlaybackClock::Reading PlaybackClock::read(std::int64_t now_ns) const {
  const double played_ns = static_cast<double>(now_ns - started_ns_) * settings_.speed;
  const double left_ns = tf::secondsBetween(from_, range_.last) * 1e9;
  if (played_ns < left_ns) {
    return {shifted(from_, std::llround(played_ns), range_), false};
  }
  const double span_ns = tf::secondsBetween(range_.first, range_.last) * 1e9;
  if (!settings_.loops || span_ns <= 0.0) {
    return {range_.last, true};
  }
  const double in_loop_ns = std::fmod(played_ns - left_ns, span_ns);
  return {shifted(range_.first, std::llround(in_loop_ns), range_), false};
}

}  // namespace stillframe::viewer
