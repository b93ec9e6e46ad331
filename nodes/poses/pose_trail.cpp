#include "nodes/poses/pose_trail.h"

#include <algorithm>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stillframe::nodes {
namespace {

using scenegraph::CacheKey;
using scenegraph::Dataset;
using scenegraph::Entry;
using scenegraph::PosesInFrame;
using scenegraph::TopicId;

/// The first pose of a message; nullopt when there is none, or it could not be decoded.
struct TrailPose {
  std::optional<tf::RigidTransform> pose;
  std::uint32_t frame = 0;  ///< index into the shelf's frames
  bool is_decodable = true;
};

/// What was decoded of a topic so far, as the cache holds it.
struct TrailShelf {
  mutable std::mutex mutex;                                    // guards all below
  mutable std::unordered_map<std::uint64_t, TrailPose> poses;  // by sequence
  mutable std::vector<std::string> frames;

  [[nodiscard]] std::uint32_t frameIndex(std::string_view frame) const {
    const auto found = std::ranges::find(frames, frame);
    if (found != frames.end()) {
      return static_cast<std::uint32_t>(found - frames.begin());
    }
    frames.emplace_back(frame);
    return static_cast<std::uint32_t>(frames.size() - 1);
  }
  [[nodiscard]] const TrailPose& pose(const Dataset& dataset, TopicId topic, const Entry& entry) const {
    const auto [found, is_new] = poses.try_emplace(entry.sequence);
    if (is_new) {
      const auto object = dataset.store().decode(topic, entry);
      const auto message = object ? object->get<PosesInFrame>() : nullptr;
      found->second.is_decodable = message != nullptr;
      if (message != nullptr && !message->poses.empty()) {
        found->second.pose = message->poses.front();
        found->second.frame = frameIndex(tf::stripLeadingSlashes(message->frame_id));
      }
    }
    return found->second;
  }
};

/// What a worker needs; by value.
struct TrailWork {
  std::shared_ptr<Dataset> dataset;
  TopicId topic = 0;
  std::size_t first = 0;  ///< entries by position
  std::size_t end = 0;
  bool is_cut = false;
};

scenegraph::LatestJob<PoseTrail>::Result collect(const TrailWork& work) {
  const CacheKey key{work.topic, 0, 0, 0, "trail poses"};
  scenegraph::ObjectCache& cache = work.dataset->cache();
  auto shelf = cache.get<TrailShelf>(key);
  if (shelf == nullptr) {
    shelf = std::make_shared<const TrailShelf>();
  }
  auto path = std::make_shared<PosesInFrame>();
  path->kind = scenegraph::PosesKind::Path;
  std::size_t other_frames = 0;
  std::size_t undecodable = 0;
  const std::scoped_lock lock(shelf->mutex);
  std::optional<std::uint32_t> frame;
  for (std::size_t i = work.end; i-- > work.first;) {  // the last message says which frame it is
    const auto entry = work.dataset->store().at(work.topic, i);
    if (!entry) {
      continue;
    }
    const TrailPose& pose = shelf->pose(*work.dataset, work.topic, *entry);
    undecodable += pose.is_decodable ? 0U : 1U;
    if (!pose.pose) {
      continue;
    }
    frame = frame.value_or(pose.frame);
    if (pose.frame != *frame) {
      ++other_frames;
      continue;
    }
    path->poses.push_back(*pose.pose);
    path->stamps.push_back(entry->log_time);
  }
  std::ranges::reverse(path->poses);
  std::ranges::reverse(path->stamps);
  path->frame_id = frame ? shelf->frames[*frame] : "";
  cache.put(key, shelf, sizeof(TrailShelf) + shelf->poses.size() * (sizeof(TrailPose) + 4 * sizeof(void*)));
  return std::make_shared<const PoseTrail>(PoseTrail{PoseSet(std::move(path)), other_frames, undecodable, work.is_cut});
}

}  // namespace

TrailLoader::TrailLoader(const scenegraph::LayerContext& context, std::string topic)
    : dataset_(context.dataset.shared_from_this()), topic_(std::move(topic)), job_(context) {}

std::shared_ptr<const PoseTrail> TrailLoader::get(const Entry& last, const TrailWindow& window) {
  const scenegraph::ObjectStore& store = dataset_->store();
  const auto topic = store.findTopic(topic_, scenegraph::ObjectType::PosesInFrame);
  if (!topic) {
    return nullptr;
  }
  TrailWork work{.dataset = dataset_, .topic = *topic};
  work.end = store.countAtOrBefore(*topic, last.log_time);
  if (window.seconds) {
    // Saturates: a window may be longer than the clock.
    const double span_ns = std::min(*window.seconds * 1e9, 9e18);
    const auto back = static_cast<std::int64_t>(span_ns);
    const std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
    const std::int64_t begin = last.log_time.ns < lowest + back + 1 ? lowest : last.log_time.ns - back - 1;
    work.first = store.countAtOrBefore(*topic, {begin});
  }
  if (work.end - work.first > window.most) {
    work.first = work.end - window.most;
  }
  if (work.end - work.first > PoseTrail::kMost) {
    work.first = work.end - PoseTrail::kMost;
    work.is_cut = true;
  }
  const auto first = store.at(*topic, work.first);
  CacheKey key = scenegraph::cacheKey(*topic, last, "trail");
  key.product += ":" + std::to_string(work.end - work.first) + ":" + std::to_string(first ? first->sequence : 0);
  const auto result = job_.get(key, [work] { return collect(work); });
  return result ? result->value_or(nullptr) : nullptr;
}

}  // namespace stillframe::nodes
