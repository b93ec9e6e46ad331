#include "tools/cli/picture_sequence.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace stillframe::cli {
namespace {

constexpr int kWidestNumber = 9;

/// Digits between `%` and `d`: "" or "0W"; nullopt for what is neither.
std::optional<int> widthOf(std::string_view digits) {
  if (digits.empty()) {
    return 0;
  }
  int width = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), width);
  const bool is_number = error == std::errc{} && end == digits.data() + digits.size();
  return is_number && digits.front() == '0' && width >= 1 && width <= kWidestNumber ? std::optional(width)
                                                                                    : std::nullopt;
}

}  // namespace

Result<TimesArgument> parseTimes(std::string_view text) {
  const std::size_t first = text.find(':');
  const std::size_t second = first == std::string_view::npos ? first : text.find(':', first + 1);
  const std::string quoted = "--times '" + std::string(text) + "'";
  if (second == std::string_view::npos || text.find(':', second + 1) != std::string_view::npos) {
    return usageError(quoted + " is not A:B:STEP, two times and a step in seconds");
  }
  TimesArgument times;
  for (const auto& [part, member] : {std::pair{text.substr(0, first), &TimesArgument::first},
                                     {text.substr(first + 1, second - first - 1), &TimesArgument::last}}) {
    const auto time = parseTime(part);
    if (!time) {
      return usageError(quoted + ": " + time.error().message);
    }
    times.*member = *time;
  }
  const auto step = parseTime("+" + std::string(text.substr(second + 1)));
  if (!step || step->offset_ns <= 0) {
    return usageError(quoted + ": the step '" + std::string(text.substr(second + 1)) +
                      "' is not a number of seconds above 0, to the nanosecond at most");
  }
  times.step_ns = step->offset_ns;
  return times;
}

Result<std::vector<tf::TimePoint>> resolveTimes(const TimesArgument& times,
                                                const std::pair<tf::TimePoint, tf::TimePoint>& range) {
  const auto first = resolveTime(times.first, range);
  const auto last = resolveTime(times.last, range);
  if (!first || !last) {
    return std::unexpected(!first ? first.error() : last.error());
  }
  for (const auto& [time, argument] : {std::pair(*first, &times.first), {*last, &times.last}}) {
    if (time < range.first || time > range.second) {
      return usageError("--times: " + outsideText(*argument, range));
    }
  }
  if (*last < *first) {
    return usageError("--times: " + times.last.text + " is before " + times.first.text);
  }
  // Unsigned: a recording may span more than an int64 can say.
  const std::uint64_t span_ns = static_cast<std::uint64_t>(last->ns) - static_cast<std::uint64_t>(first->ns);
  const std::uint64_t steps = span_ns / static_cast<std::uint64_t>(times.step_ns);
  if (steps >= static_cast<std::uint64_t>(kMostPictures)) {
    return usageError("--times: " + std::to_string(steps) + " steps of " + secondsText(times.step_ns) +
                      " s are more than " + std::to_string(kMostPictures) + " pictures");
  }
  std::vector<tf::TimePoint> all;
  for (std::uint64_t i = 0; i <= steps; ++i) {
    all.push_back({first->ns + static_cast<std::int64_t>(i) * times.step_ns});
  }
  return all;
}

Result<NumberedName> NumberedName::parse(std::string_view pattern) {
  NumberedName name;
  bool has_number = false;
  const auto refused = [&] {
    return usageError("--out '" + std::string(pattern) +
                      "' of several pictures has one place for their number, such as frame_%05d.png");
  };
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::string& part = has_number ? name.after_ : name.before_;
    if (pattern[i] != '%') {
      part += pattern[i];
      continue;
    }
    if (i + 1 < pattern.size() && pattern[i + 1] == '%') {
      part += '%';
      ++i;
      continue;
    }
    const std::size_t d = pattern.find_first_not_of("0123456789", i + 1);
    const auto width = d == std::string_view::npos ? std::nullopt : widthOf(pattern.substr(i + 1, d - i - 1));
    if (has_number || !width || pattern[d] != 'd') {
      return refused();
    }
    name.width_ = *width;
    has_number = true;
    i = d;
  }
  return has_number ? Result<NumberedName>(std::move(name)) : refused();
}

std::string NumberedName::at(int number) const {
  const std::string digits = std::to_string(number);
  const auto zeros = static_cast<std::size_t>(std::max(0, width_ - static_cast<int>(digits.size())));
  return before_ + std::string(zeros, '0') + digits + after_;
}

}  // namespace stillframe::cli
