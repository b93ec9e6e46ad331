#include "viewer/time/opening_time.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace stillframe::viewer {
namespace {

constexpr std::int64_t kLongestWaitNs = 2'000'000'000;
constexpr double kShareOfRecording = 0.1;

}  // namespace

tf::TimePoint openingTime(const scenegraph::ObjectStore& store, const TimeRange& range) {
  const double share_ns = kShareOfRecording * 1e9 * tf::secondsBetween(range.first, range.last);
  const tf::TimePoint until =
      shifted(range.first, static_cast<std::int64_t>(std::min(share_ns, static_cast<double>(kLongestWaitNs))), range);
  tf::TimePoint all_begun = range.first;
  std::optional<tf::TimePoint> first_seen;
  for (scenegraph::TopicId id = 0; id < store.topicCount(); ++id) {
    const scenegraph::ObjectType type = store.topic(id).type;
    const auto span = type == scenegraph::ObjectType::None ? std::nullopt : store.span(id);
    if (!span) {
      continue;
    }
    if (span->first <= until) {
      all_begun = std::max(all_begun, span->first);
    }
    if (type != scenegraph::ObjectType::FrameTransforms) {
      first_seen = first_seen ? std::min(*first_seen, span->first) : span->first;
    }
  }
  return first_seen ? std::max(all_begun, *first_seen) : all_begun;
}

}  // namespace stillframe::viewer
