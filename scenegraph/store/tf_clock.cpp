#include "scenegraph/store/tf_clock.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stillframe::scenegraph {
namespace {

constexpr double kMaxGapSeconds = 1.0;
constexpr double kMaxMedianSeconds = 10.0;

/// The lower median; reorders `values`, which is not empty.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ClockVerdict compareClocks(std::span<const ClockSample> samples) {
  ClockVerdict verdict;
  if (samples.empty()) {
    return verdict;
  }
  verdict.header_first = verdict.header_last = samples.front().header;
  verdict.log_first = verdict.log_last = samples.front().log;
  std::vector<double> distances;
  distances.reserve(samples.size());
  std::map<std::uint32_t, std::vector<double>> distances_of_edge;
  for (const ClockSample& sample : samples) {
    verdict.header_first = std::min(verdict.header_first, sample.header);
    verdict.header_last = std::max(verdict.header_last, sample.header);
    verdict.log_first = std::min(verdict.log_first, sample.log);
    verdict.log_last = std::max(verdict.log_last, sample.log);
    distances.push_back(std::abs(tf::secondsBetween(sample.header, sample.log)));
    distances_of_edge[sample.edge].push_back(distances.back());
  }
  const double gap = std::max(tf::secondsBetween(verdict.header_last, verdict.log_first),
                              tf::secondsBetween(verdict.log_last, verdict.header_first));
  verdict.is_mismatch = gap > kMaxGapSeconds || median(distances) > kMaxMedianSeconds;
  for (auto& [edge, of_edge] : distances_of_edge) {
    const double edge_median = median(of_edge);
    // Beneath the bound an edge says "same clock"; where the gap alone decided, it agrees when it is as far off.
    const bool edge_mismatch = edge_median > (gap > kMaxGapSeconds ? kMaxGapSeconds : kMaxMedianSeconds);
    if (edge_mismatch != verdict.is_mismatch) {
      verdict.dissenters.push_back(edge);
    }
  }
  return verdict;
}

std::string timeText(tf::TimePoint time) {
  const bool is_negative = time.ns < 0;
  const std::uint64_t magnitude =
      is_negative ? ~static_cast<std::uint64_t>(time.ns) + 1 : static_cast<std::uint64_t>(time.ns);
  const std::string fraction = std::to_string(magnitude % 1'000'000'000U);
  return (is_negative ? "-" : "") + std::to_string(magnitude / 1'000'000'000U) + "." +
         std::string(9 - fraction.size(), '0') + fraction + " s";
}

std::string intervalText(tf::TimePoint first, tf::TimePoint last) {
  return "[" + timeText(first) + ", " + timeText(last) + "]";
}

}  // namespace stillframe::scenegraph
