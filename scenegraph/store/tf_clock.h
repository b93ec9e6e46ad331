#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tf/time.h"

namespace stillframe::scenegraph {

/// Both stamps of one dynamic transform, and which edge it belongs to (any dense number).
struct ClockSample {
  std::uint32_t edge = 0;
  tf::TimePoint header;
  tf::TimePoint log;
};

/// Whether header stamps ride the tracker's clock, and what shows it.
struct ClockVerdict {
  bool is_mismatch = false;               ///< header stamps ride another epoch: log times have to stand in
  std::vector<std::uint32_t> dissenters;  ///< edges whose own samples say the opposite, ascending
  tf::TimePoint header_first, header_last;
  tf::TimePoint log_first, log_last;
};

/// Compares the stamps: a mismatch when the two intervals lie more than 1 s apart, or the median |header - log| exceeds
/// 10 s. An edge dissents when its own median lies on the other side of 10 s. No samples: no mismatch.
[[nodiscard]] ClockVerdict compareClocks(std::span<const ClockSample> samples);

/// "[1700000000.000000000 s, 1700000012.500000000 s]", exact over the whole of int64.
[[nodiscard]] std::string intervalText(tf::TimePoint first, tf::TimePoint last);
/// "1700000000.000000000 s".
[[nodiscard]] std::string timeText(tf::TimePoint time);

}  // namespace stillframe::scenegraph
