#include "tools/cli/time_argument.h"

#include <charconv>
#include <optional>

namespace stillframe::cli {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::optional<std::int64_t> parseInteger(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

bool isDigits(std::string_view text) { return text.find_first_not_of("0123456789") == std::string_view::npos; }

Result<std::int64_t> parseSeconds(std::string_view text) {
  const std::string quoted = "'+" + std::string(text) + "'";
  const std::size_t dot = text.find('.');
  const std::string_view whole = text.substr(0, dot);
  std::string_view fraction = dot == std::string_view::npos ? std::string_view{} : text.substr(dot + 1);
  if ((whole.empty() && fraction.empty()) || !isDigits(whole) || !isDigits(fraction)) {
    return usageError("time " + quoted + " is not '+' and decimal seconds");
  }
  while (fraction.size() > 9 && fraction.back() == '0') {
    fraction.remove_suffix(1);
  }
  if (fraction.size() > 9) {
    return usageError("time " + quoted + " is finer than a nanosecond");
  }
  const auto seconds = whole.empty() ? 0 : parseInteger(whole);
  std::int64_t ns = 0;
  const std::string padded = std::string(fraction) + std::string(9 - fraction.size(), '0');
  if (!seconds || __builtin_mul_overflow(*seconds, kSecond, &ns) ||
      __builtin_add_overflow(ns, *parseInteger(padded), &ns)) {
    return usageError("time " + quoted + " is beyond the range of 64-bit nanoseconds");
  }
  return ns;
}

}  // namespace

Result<TimeArgument> parseTime(std::string_view text) {
  if (text == "start") {
    return TimeArgument{TimeArgument::Base::Start, 0, std::string(text)};
  }
  if (text == "end") {
    return TimeArgument{TimeArgument::Base::End, 0, std::string(text)};
  }
  if (text.starts_with('+')) {
    const auto offset_ns = parseSeconds(text.substr(1));
    if (!offset_ns) {
      return std::unexpected(offset_ns.error());
    }
    return TimeArgument{TimeArgument::Base::Start, *offset_ns, std::string(text)};
  }
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  if (digits.empty() || !isDigits(digits)) {
    return usageError("time '" + std::string(text) + "' is neither nanoseconds nor +SECONDS nor start nor end");
  }
  const auto ns = parseInteger(text);
  if (!ns) {
    return usageError("time '" + std::string(text) + "' is beyond the range of 64-bit nanoseconds");
  }
  return TimeArgument{TimeArgument::Base::Epoch, *ns, std::string(text)};
}

Result<tf::TimePoint> resolveTime(const TimeArgument& time, const std::pair<tf::TimePoint, tf::TimePoint>& range) {
  std::int64_t base_ns = 0;
  if (time.base != TimeArgument::Base::Epoch) {
    base_ns = time.base == TimeArgument::Base::Start ? range.first.ns : range.second.ns;
  }
  std::int64_t ns = 0;
  if (__builtin_add_overflow(base_ns, time.offset_ns, &ns)) {
    return usageError("time +" + secondsText(time.offset_ns) + " from " + std::to_string(base_ns) +
                      " ns is beyond the range of 64-bit nanoseconds");
  }
  return tf::TimePoint{ns};
}

std::string outsideText(const TimeArgument& time, const std::pair<tf::TimePoint, tf::TimePoint>& range) {
  const std::string is_outside = time.text + " is outside the recording, which spans ";
  std::int64_t span_ns = 0;
  if (time.base == TimeArgument::Base::Epoch || __builtin_sub_overflow(range.second.ns, range.first.ns, &span_ns)) {
    return is_outside + std::to_string(range.first.ns) + " to " + std::to_string(range.second.ns);
  }
  std::string seconds = secondsText(span_ns);
  seconds.resize(seconds.find_last_not_of('0') + 1);
  seconds.resize(seconds.find_last_not_of('.') + 1);
  return is_outside + "+0 to +" + seconds;
}

std::string secondsText(std::int64_t ns) {
  const std::uint64_t magnitude = ns < 0 ? -static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  const std::string fraction = std::to_string(magnitude % kSecond);
  return (ns < 0 ? "-" : "") + std::to_string(magnitude / kSecond) + "." + std::string(9 - fraction.size(), '0') +
         fraction;
}

}  // namespace stillframe::cli
