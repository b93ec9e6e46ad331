#include "viewer/time/time_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace stillframe::viewer {
namespace {

constexpr std::uint64_t kNsPerSecond = 1'000'000'000;

std::uint64_t distance(tf::TimePoint earlier, tf::TimePoint later) {
  return static_cast<std::uint64_t>(later.ns) - static_cast<std::uint64_t>(earlier.ns);
}

tf::TimePoint after(tf::TimePoint time, std::uint64_t offset) {
  return tf::TimePoint{static_cast<std::int64_t>(static_cast<std::uint64_t>(time.ns) + offset)};
}

/// "12.5" as nanoseconds, digit by digit: a double would lose the last ones of a long recording.
std::optional<std::uint64_t> parseSeconds(const std::string& text) {
  const std::size_t dot = text.find('.');
  std::string whole = text.substr(0, dot);
  std::string fraction = dot == std::string::npos ? "" : text.substr(dot + 1);
  if ((whole.empty() && fraction.empty()) || fraction.size() > 9) {
    return std::nullopt;
  }
  if (whole.empty()) {
    whole = "0";
  }
  fraction.resize(9, '0');
  std::uint64_t seconds = 0;
  std::uint64_t nanos = 0;
  const auto read = [](const std::string& digits, std::uint64_t& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc{} && end == digits.data() + digits.size();
  };
  if (!read(whole, seconds) || !read(fraction, nanos) ||
      seconds > std::numeric_limits<std::uint64_t>::max() / kNsPerSecond - 1) {
    return std::nullopt;
  }
  return seconds * kNsPerSecond + nanos;
}

}  // namespace

std::optional<tf::TimePoint> parseTime(const QString& text, const TimeRange& range) {
  const std::string trimmed = text.trimmed().toStdString();
  if (trimmed == "start") {
    return range.first;
  }
  if (trimmed == "end") {
    return range.last;
  }
  if (trimmed.starts_with('+')) {
    std::string seconds = trimmed.substr(1);
    if (seconds.ends_with('s')) {
      seconds.pop_back();
    }
    const auto offset = parseSeconds(seconds);
    const std::uint64_t room = distance(range.first, tf::TimePoint{std::numeric_limits<std::int64_t>::max()});
    return offset && *offset <= room ? std::optional(after(range.first, *offset)) : std::nullopt;
  }
  std::int64_t ns = 0;
  const auto [end, error] = std::from_chars(trimmed.data(), trimmed.data() + trimmed.size(), ns);
  if (trimmed.empty() || error != std::errc{} || end != trimmed.data() + trimmed.size()) {
    return std::nullopt;
  }
  return tf::TimePoint{ns};
}

QString secondsText(tf::TimePoint time, const TimeRange& range, int decimals) {
  const bool is_before = time < range.first;
  const std::uint64_t offset = is_before ? distance(time, range.first) : distance(range.first, time);
  QString text = QString::number(offset / kNsPerSecond);
  if (decimals > 0) {
    text +=
        QLatin1Char('.') + QString::number(offset % kNsPerSecond).rightJustified(9, QLatin1Char('0')).left(decimals);
  }
  return (is_before ? QLatin1Char('-') : QLatin1Char('+')) + text;
}

tf::TimePoint timeAtStep(int step, int steps, const TimeRange& range) {
  if (steps <= 0) {
    return range.first;
  }
  const auto n = static_cast<std::uint64_t>(steps);
  const auto i = static_cast<std::uint64_t>(std::clamp(step, 0, steps));
  const std::uint64_t span = distance(range.first, range.last);
  // span * i / n without 128 bits: n and i are ints, so the second product fits.
  return after(range.first, span / n * i + span % n * i / n);
}

int stepAtTime(tf::TimePoint time, int steps, const TimeRange& range) {
  if (time <= range.first || range.last <= range.first) {
    return 0;
  }
  if (time >= range.last) {
    return steps;
  }
  const auto fraction = static_cast<long double>(distance(range.first, time)) /
                        static_cast<long double>(distance(range.first, range.last));
  return static_cast<int>(std::lround(fraction * static_cast<long double>(steps)));
}

tf::TimePoint shifted(tf::TimePoint time, std::int64_t delta_ns, const TimeRange& range) {
  const tf::TimePoint from = std::clamp(time, range.first, range.last);
  if (delta_ns >= 0) {
    const auto delta = static_cast<std::uint64_t>(delta_ns);
    return distance(from, range.last) <= delta ? range.last : after(from, delta);
  }
  const std::uint64_t delta = std::uint64_t{0} - static_cast<std::uint64_t>(delta_ns);
  return distance(range.first, from) <= delta ? range.first : after(from, std::uint64_t{0} - delta);
}

}  // namespace stillframe::viewer
