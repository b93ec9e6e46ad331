#include "tools/bench/tf_workloads.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace stillframe::bench {
namespace {

constexpr std::int64_t kEpochNs = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriodNs = 10'000'000;

tf::RigidTransform randomPose(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  return {glm::normalize(glm::dquat(any(random), any(random), any(random), any(random) + 2.0)),
          {any(random), any(random), any(random)}};
}

std::string numbered(std::string_view prefix, std::size_t number) {
  return std::string(prefix).append(std::to_string(number));
}

}  // namespace

ChainWorkload::ChainWorkload(std::size_t depth, std::size_t samples_per_edge, std::int64_t pause_ns)
    : first_ns_(kEpochNs + kPeriodNs),
      last_ns_(kEpochNs + static_cast<std::int64_t>(samples_per_edge) * kPeriodNs + pause_ns) {
  for (std::size_t i = 0; i <= depth; ++i) {
    names_.push_back(numbered("robot_3/link_", i));
  }
  std::uniform_int_distribution<std::int64_t> jitter(0, kPeriodNs / 10);
  samples_.reserve(depth * samples_per_edge);
  for (std::size_t tick = 0; tick < samples_per_edge; ++tick) {
    const std::int64_t pause = 2 * tick < samples_per_edge ? 0 : pause_ns;
    for (std::size_t edge = 0; edge < depth; ++edge) {
      const std::int64_t stamp = kEpochNs + pause + static_cast<std::int64_t>(tick) * kPeriodNs + jitter(random_);
      samples_.push_back({names_[edge], names_[edge + 1], tf::TimePoint{stamp}, randomPose(random_), false});
    }
  }
  half_span_ns_ = (last_ns_ - first_ns_ - pause_ns) / 2;
}

void ChainWorkload::shuffle() { std::shuffle(samples_.begin(), samples_.end(), random_); }

std::unique_ptr<tf::TransformBuffer> ChainWorkload::load() const {
  auto buffer = std::make_unique<tf::TransformBuffer>();
  buffer->insertBulk(samples_);
  buffer->pack();
  return buffer;
}

void ChainWorkload::forgetSamples() { samples_ = {}; }

tf::TimePoint ChainWorkload::randomTime() {
  const auto since = std::uniform_int_distribution<std::int64_t>(0, 2 * half_span_ns_)(random_);
  return {since <= half_span_ns_ ? first_ns_ + since : last_ns_ - (2 * half_span_ns_ - since)};
}

std::unique_ptr<tf::TransformBuffer> makeRandomTree(std::size_t frames) {
  std::mt19937_64 random(7);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < frames; ++i) {
    names.push_back(numbered("frame_", i));
  }
  auto buffer = std::make_unique<tf::TransformBuffer>();
  std::vector<tf::TransformSample> samples;
  for (std::size_t i = 1; i < frames; ++i) {
    const std::string& parent = names[random() % i];
    for (std::int64_t tick = 0; tick < 100; ++tick) {
      samples.push_back({parent, names[i], tf::TimePoint{kEpochNs + tick * 10'000'000}, randomPose(random), false});
    }
  }
  buffer->insertBulk(samples);
  return buffer;
}

SharedRates sharedRates(tf::TransformBuffer& buffer, const ChainWorkload& chain, int readers, int writers,
                        double seconds) {
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> lookups{0};
  std::atomic<std::uint64_t> inserts{0};
  const tf::FrameId root = *buffer.findFrame(chain.root());
  const tf::FrameId leaf = *buffer.findFrame(chain.leaf());
  std::vector<std::jthread> threads;
  const auto start = std::chrono::steady_clock::now();
  for (int reader = 0; reader < readers; ++reader) {
    threads.emplace_back([&, mine = chain]() mutable {
      mine.forgetSamples();
      std::uint64_t done = 0;
      for (; !stop.load(std::memory_order_relaxed); ++done) {
        if (!buffer.tryLookupTransform(root, leaf, mine.randomTime())) {
          return;  // counts as nothing: the number would show it
        }
      }
      lookups += done;
    });
  }
  for (int writer = 0; writer < writers; ++writer) {
    threads.emplace_back([&] {
      while (!stop.load(std::memory_order_relaxed)) {
        // The same stamps again: replaced, the history does not grow.
        inserts += buffer.insertBulk(chain.samples()).inserted;
      }
    });
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  stop = true;
  threads.clear();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {static_cast<double>(lookups.load()) / elapsed.count(), static_cast<double>(inserts.load()) / elapsed.count()};
}

}  // namespace stillframe::bench
