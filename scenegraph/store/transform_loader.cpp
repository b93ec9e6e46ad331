#include "scenegraph/store/transform_loader.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "scenegraph/stopwatch.h"

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kBatch = 8192;
constexpr std::size_t kEnoughClockSamples = 10;
constexpr std::size_t kMaxListedRefusals = 1024;
constexpr std::size_t kMaxNamedEdges = 8;

std::string refusalMessage(const tf::BulkInsertReport::Refusal& refusal, const tf::TransformBuffer& buffer) {
  std::string edge = "'" + refusal.parent + "' -> '" + refusal.child + "'";
  const std::string from = " (first at " + timeText(refusal.first_stamp) + ")";
  switch (refusal.error) {
    case tf::InsertError::EmptyFrameName:
      return "transform " + edge + " refused: a frame name is empty" + from;
    case tf::InsertError::SelfLoop:
      return "transform " + edge + " refused: a frame cannot be its own parent" + from;
    case tf::InsertError::NotFinite:
      return "transform " + edge + " refused: translation or rotation is NaN or infinite" + from;
    case tf::InsertError::ZeroQuaternion:
      return "transform " + edge + " refused: its rotation has norm zero" + from;
    case tf::InsertError::ReparentConflict: {
      const auto child = buffer.findFrame(refusal.child);
      const std::string parent = child ? buffer.frameName(buffer.parent(*child)) : "?";
      return "transform " + edge + " refused: '" + refusal.child + "' already has the parent '" + parent + "'" + from;
    }
    case tf::InsertError::Cycle:
      return "transform " + edge + " refused: '" + refusal.parent + "' descends from '" + refusal.child + "'" + from;
  }
  return edge;
}

}  // namespace

void TransformLoader::queueNew() {
  queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(queue_next_));
  queue_next_ = 0;
  const std::size_t old_size = queue_.size();
  const std::size_t topics = store_.topicCount();
  cursors_.resize(topics, 0);
  for (TopicId topic = 0; topic < topics; ++topic) {
    const TopicInfo info = store_.topic(topic);
    if (info.type != ObjectType::FrameTransforms) {
      continue;
    }
    for (const Entry& entry : store_.arrivedSince(topic, cursors_[topic])) {
      queue_.push_back({topic, entry, info.is_static});
      cursors_[topic] = std::max(cursors_[topic], entry.sequence + 1);
    }
  }
  if (queue_.size() > old_size) {
    // By log time over all topics: which of two parents came first does not depend on the order of loading.
    std::ranges::sort(queue_, [](const Work& a, const Work& b) {
      return std::tie(a.entry.log_time, a.entry.sequence) < std::tie(b.entry.log_time, b.entry.sequence);
    });
  }
}

void TransformLoader::take(const Progress& progress) {
  queueNew();
  const bool hold = is_automatic_ && !is_settled_;
  if (!decodeQueue(progress, hold)) {
    return;
  }
  if (hold) {
    const bool was_log_time = uses_log_time_;
    settleClock();
    if (uses_log_time_ != was_log_time && buffer_.frameCount() > 0) {
      if (has_forgotten_) {
        refill();
        return;
      }
      clearBuffer();
    }
  }
  insertGathered();
}

bool TransformLoader::decodeQueue(const Progress& progress, bool hold) {
  constexpr std::size_t kReportEvery = 256;
  // A large chunk was unpacked: what else it holds comes at once, and is told at once, for the next will take as long.
  constexpr double kSlowMs = 20.0;
  const std::uint64_t all = queue_.size();
  std::size_t since_slow = kReportEvery;
  auto reported = std::chrono::steady_clock::now();
  while (queue_next_ < queue_.size()) {
    const auto start = std::chrono::steady_clock::now();
    decodeOne(queue_[queue_next_++]);
    since_slow = millisecondsSince(start) > kSlowMs ? 0 : since_slow + 1;
    if (!hold && gathered_.size() >= kBatch) {
      insertGathered();
    }
    const bool is_due = since_slow < kReportEvery || queue_next_ % kReportEvery == 0 || queue_next_ == all ||
                        millisecondsSince(reported) > kSlowMs;
    if (progress && is_due) {
      reported = std::chrono::steady_clock::now();
      insertProvisionally();
      if (!progress(queue_next_, all)) {
        if (!hold) {
          insertGathered();
        }
        return queue_next_ == all;
      }
    }
  }
  return true;
}

void TransformLoader::insertProvisionally() {
  // The first few decide, and no more until all is there.
  if (is_automatic_ && !is_settled_ && !has_forgotten_ && clock_samples_in_use_ < kEnoughClockSamples) {
    const bool is_mismatch = compareClocks(clock_samples_).is_mismatch;
    if (inserted_ > 0 && is_mismatch != uses_log_time_) {
      clearBuffer();
    }
    uses_log_time_ = is_mismatch;
    clock_samples_in_use_ = clock_samples_.size();
  }
  insertFrom(inserted_);
  inserted_ = gathered_.size();
}

void TransformLoader::decodeOne(const Work& work) {
  const auto decoded = store_.decode(work.topic, work.entry);
  const auto transforms = decoded ? decoded->get<FrameTransforms>() : nullptr;
  if (transforms == nullptr) {
    const DecodeError error =
        decoded ? DecodeError{"WrongObject", "the message is no list of transforms"} : decoded.error();
    auto [found, is_new] = decode_problems_.try_emplace({work.topic, error.code});
    if (is_new) {
      found->second = {error.code,
                       "transform message on '" + store_.topic(work.topic).name + "' at " +
                           timeText(work.entry.log_time) + " not decoded: " + error.message,
                       0, work.entry.log_time};
    }
    ++found->second.count;
    return;
  }
  for (const FrameTransform& transform : transforms->transforms) {
    const Sample sample{nameIndex(transform.parent_frame_id),
                        nameIndex(transform.child_frame_id),
                        transform.stamp,
                        work.entry.log_time,
                        transform.parent_from_child,
                        work.is_static};
    gathered_.push_back(sample);
    if (is_automatic_ && !is_settled_ && !work.is_static) {
      clock_samples_.push_back({edgeIndex(sample), sample.header, sample.log});
    }
  }
}

void TransformLoader::settleClock() {
  const ClockVerdict verdict = compareClocks(clock_samples_);
  uses_log_time_ = verdict.is_mismatch;
  clock_problems_.clear();
  if (verdict.is_mismatch) {
    clock_problems_.push_back(
        {"ClockMismatch",
         "the header stamps of the transforms, " + intervalText(verdict.header_first, verdict.header_last) +
             ", ride another clock than their log times, " + intervalText(verdict.log_first, verdict.log_last) +
             ": the log times are used instead",
         1});
  }
  if (!verdict.dissenters.empty()) {
    std::string named;
    for (std::size_t i = 0; i < std::min(verdict.dissenters.size(), kMaxNamedEdges); ++i) {
      const auto& [parent, child] = edges_[verdict.dissenters[i]];
      named += (i == 0 ? "'" : ", '") + names_[parent] + "' -> '" + names_[child] + "'";
    }
    if (verdict.dissenters.size() > kMaxNamedEdges) {
      named += " and " + std::to_string(verdict.dissenters.size() - kMaxNamedEdges) + " more";
    }
    clock_problems_.push_back({"ClockMixed",
                               std::string("these edges do not ride the clock of the others, whose ") +
                                   (uses_log_time_ ? "log times" : "header stamps") + " are used for all: " + named,
                               verdict.dissenters.size()});
  }
  if (clock_samples_.size() >= kEnoughClockSamples) {
    is_settled_ = true;
    clock_samples_ = {};
    edges_ = {};
    edge_index_ = {};
  }
}

void TransformLoader::insertFrom(std::size_t first) {
  std::vector<tf::TransformSample> batch;
  for (std::size_t begin = first; begin < gathered_.size(); begin += kBatch) {
    batch.clear();
    for (std::size_t i = begin; i < std::min(begin + kBatch, gathered_.size()); ++i) {
      const Sample& sample = gathered_[i];
      batch.push_back({names_[sample.parent], names_[sample.child], uses_log_time_ ? sample.log : sample.header,
                       sample.parent_from_child, sample.is_static});
    }
    const tf::BulkInsertReport report = buffer_.insertBulk(batch);
    std::uint64_t unlisted = report.refused;
    for (const auto& refusal : report.refusals) {
      const std::tuple key(refusal.error, refusal.parent, refusal.child);
      auto found = refusal_index_.find(key);
      if (found == refusal_index_.end() && refusal_problems_.size() < kMaxListedRefusals) {
        found = refusal_index_.emplace(key, refusal_problems_.size()).first;
        refusal_problems_.push_back(
            {std::string(tf::toString(refusal.error)), refusalMessage(refusal, buffer_), 0, refusal.first_stamp});
      }
      if (found != refusal_index_.end()) {
        refusal_problems_[found->second].count += refusal.count;
        unlisted -= refusal.count;
      }
    }
    unlisted_refusals_ += unlisted;
  }
}

void TransformLoader::insertGathered() {
  insertFrom(inserted_);
  has_forgotten_ |= !gathered_.empty();
  gathered_ = {};
  inserted_ = 0;
  buffer_.pack();
}

void TransformLoader::clearBuffer() {
  refusal_problems_.clear();
  refusal_index_.clear();
  unlisted_refusals_ = 0;
  inserted_ = 0;
  clock_samples_in_use_ = 0;
  has_forgotten_ = false;
  buffer_.clear();
}

void TransformLoader::refill() {
  queue_.clear();
  queue_next_ = 0;
  cursors_.clear();
  gathered_.clear();
  inserted_ = 0;
  decode_problems_.clear();
  const bool is_undecided = is_automatic_ && !is_settled_;
  if (is_undecided) {
    clock_samples_.clear();
    clock_problems_.clear();
  }
  queueNew();
  decodeQueue({}, true);
  if (is_undecided) {
    settleClock();
  }
  clearBuffer();
  insertGathered();
}

void TransformLoader::setUseLogTime(std::optional<bool> use_log_time) {
  const bool was_log_time = uses_log_time_;
  const bool has_held_back = is_automatic_ && !is_settled_ && !gathered_.empty();
  const bool is_untouched = buffer_.frameCount() == 0 && cursors_.empty();
  is_automatic_ = !use_log_time.has_value();
  is_settled_ = false;
  clock_samples_.clear();
  clock_problems_.clear();
  uses_log_time_ = use_log_time.value_or(false);
  if (!is_untouched && (is_automatic_ || has_held_back || uses_log_time_ != was_log_time)) {
    refill();
  }
}

std::uint32_t TransformLoader::nameIndex(const std::string& name) {
  if (const auto found = name_index_.find(name); found != name_index_.end()) {
    return found->second;
  }
  names_.push_back(name);
  const auto index = static_cast<std::uint32_t>(names_.size() - 1);
  name_index_.emplace(names_.back(), index);
  return index;
}

std::uint32_t TransformLoader::edgeIndex(const Sample& sample) {
  const auto [found, is_new] =
      edge_index_.try_emplace({sample.parent, sample.child}, static_cast<std::uint32_t>(edges_.size()));
  if (is_new) {
    edges_.emplace_back(sample.parent, sample.child);
  }
  return found->second;
}

std::vector<Problem> TransformLoader::problems() const {
  std::vector<Problem> all = clock_problems_;
  for (const auto& [key, problem] : decode_problems_) {
    all.push_back(problem);
  }
  all.insert(all.end(), refusal_problems_.begin(), refusal_problems_.end());
  if (unlisted_refusals_ > 0) {
    all.push_back({"TransformsRefused", "further transforms refused on edges not listed", unlisted_refusals_});
  }
  return all;
}

}  // namespace stillframe::scenegraph
