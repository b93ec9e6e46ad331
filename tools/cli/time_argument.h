#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "tf/time.h"
#include "tools/cli/cli_error.h"

namespace stillframe::cli {

/// A time as the user writes it: integer nanoseconds, `+SECONDS` from the start, `start`, `end`.
struct TimeArgument {
  enum class Base { Epoch, Start, End };
  Base base = Base::End;
  std::int64_t offset_ns = 0;
  std::string text = {};  ///< as written
};

/// Exact to the nanosecond: `+0.1` is 100000000 ns, never a rounded double. Refuses what is finer or does not fit.
[[nodiscard]] Result<TimeArgument> parseTime(std::string_view text);

/// The instant in a recording that spans `range`, first and last log time. May lie outside of it; refuses only what no
/// int64 can hold.
[[nodiscard]] Result<tf::TimePoint> resolveTime(const TimeArgument& time,
                                                const std::pair<tf::TimePoint, tf::TimePoint>& range);

/// "+3 is outside the recording, which spans +0 to +1.5": in the words in which the time was written.
[[nodiscard]] std::string outsideText(const TimeArgument& time, const std::pair<tf::TimePoint, tf::TimePoint>& range);

/// `ns` as decimal seconds, exact.
[[nodiscard]] std::string secondsText(std::int64_t ns);

}  // namespace stillframe::cli
