#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tf/time.h"
#include "tools/cli/cli_error.h"
#include "tools/cli/time_argument.h"

namespace stillframe::cli {

/// Most pictures of one run: an hour at 25 a second.
inline constexpr int kMostPictures = 90'000;

/// `--times A:B:STEP`: from A to B, each written as a time, every STEP seconds.
struct TimesArgument {
  TimeArgument first;
  TimeArgument last;
  std::int64_t step_ns = 0;
};
[[nodiscard]] Result<TimesArgument> parseTimes(std::string_view text);

/// A, A + STEP, ... as far as B. Refuses what lies outside of `range`, B before A, and more than kMostPictures.
[[nodiscard]] Result<std::vector<tf::TimePoint>> resolveTimes(const TimesArgument& times,
                                                              const std::pair<tf::TimePoint, tf::TimePoint>& range);

/// The name of numbered files: `frame_%05d.png`, `%d` or `%0Wd` standing for the number, `%%` for a percent sign.
class NumberedName {
 public:
  /// Refuses a name with no number or more than one, and every other conversion.
  [[nodiscard]] static Result<NumberedName> parse(std::string_view pattern);
  [[nodiscard]] std::string at(int number) const;

 private:
  std::string before_;
  std::string after_;
  int width_ = 0;
};

}  // namespace stillframe::cli
