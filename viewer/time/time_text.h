#pragma once

#include <QString>
#include <cstdint>
#include <optional>

#include "tf/time.h"

namespace stillframe::viewer {

/// The time range of a dataset; first <= last.
struct TimeRange {
  tf::TimePoint first;
  tf::TimePoint last;
  friend bool operator==(const TimeRange&, const TimeRange&) = default;
};

/// `ns` as a decimal, or "+SECONDS" from the start (up to nanoseconds, exactly), or "start" or "end". Nullopt when the
/// text is none of these or leaves int64. Not clamped to the range: TF holds beyond it.
[[nodiscard]] std::optional<tf::TimePoint> parseTime(const QString& text, const TimeRange& range);

/// "+12.345678901" from the start of the range, exactly; `decimals` 0..9 digits are kept, the rest cut off.
[[nodiscard]] QString secondsText(tf::TimePoint time, const TimeRange& range, int decimals = 9);

/// Slider positions 0..`steps` to times and back, exactly at both ends and without overflow for any int64 range.
[[nodiscard]] tf::TimePoint timeAtStep(int step, int steps, const TimeRange& range);
[[nodiscard]] int stepAtTime(tf::TimePoint time, int steps, const TimeRange& range);

/// `time` + `delta_ns`, kept within the range.
[[nodiscard]] tf::TimePoint shifted(tf::TimePoint time, std::int64_t delta_ns, const TimeRange& range);

}  // namespace stillframe::viewer
