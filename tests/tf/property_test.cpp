// TransformBuffer against a model that is too simple to be wrong: maps of samples, walked up edge by edge.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>
#include <set>

#include "tf/transform_buffer.h"
#include "tf_builders.h"
#include "tools/accuracy/rigid_reference.h"

namespace stillframe::tf {
namespace {

using accuracy::RigidReference;

class Model {
 public:
  std::optional<InsertError> insert(const std::string& parent, const std::string& child, std::int64_t stamp,
                                    const RigidTransform& parent_from_child, bool is_static,
                                    std::optional<std::int64_t> retention) {
    if (parent == child) {
      return InsertError::SelfLoop;
    }
    if (parents_.contains(child) && parents_[child] != parent) {
      return InsertError::ReparentConflict;
    }
    for (const std::string& ancestor : chainUp(parent)) {
      if (ancestor == child) {
        return InsertError::Cycle;
      }
    }
    frames_.insert(parent);
    frames_.insert(child);
    parents_[child] = parent;
    auto& samples = samples_[child];
    samples[stamp] = parent_from_child;
    all_static_[child] = (samples.size() == 1 && !all_static_.contains(child) ? true : all_static_[child]) && is_static;
    if (retention) {
      std::erase_if(samples, [&, newest = samples.rbegin()->first](const auto& entry) {
        return static_cast<__int128_t>(newest) - entry.first > *retention;
      });
    }
    return std::nullopt;
  }

  struct Answer {
    std::optional<LookupError> error;
    std::string failing_child;
    RigidReference target_from_source;
  };
  Answer lookup(const std::string& target, const std::string& source, std::int64_t time, bool static_for_all_time) {
    if (!frames_.contains(target)) {
      return {LookupError::UnknownTarget, {}, {}};
    }
    if (!frames_.contains(source)) {
      return {LookupError::UnknownSource, {}, {}};
    }
    const auto from_target = chainUp(target);
    const auto from_source = chainUp(source);
    if (from_target.back() != from_source.back()) {
      return {LookupError::Disconnected, {}, {}};
    }
    const std::set<std::string> above_target(from_target.begin(), from_target.end());
    Answer answer;
    std::string meet = source;
    RigidReference meet_from_source;
    for (; !above_target.contains(meet); meet = parents_[meet]) {
      const auto edge = at(meet, time, static_for_all_time);
      if (!edge) {
        return {LookupError::NoSampleAtTime, meet, {}};
      }
      meet_from_source = RigidReference(*edge) * meet_from_source;
    }
    RigidReference meet_from_target;
    for (std::string frame = target; frame != meet; frame = parents_[frame]) {
      const auto edge = at(frame, time, static_for_all_time);
      if (!edge) {
        return {LookupError::NoSampleAtTime, frame, {}};
      }
      meet_from_target = RigidReference(*edge) * meet_from_target;
    }
    answer.target_from_source = inverse(meet_from_target) * meet_from_source;
    return answer;
  }
  const std::set<std::string>& frames() const { return frames_; }
  std::size_t sampleCount(const std::string& child) { return samples_[child].size(); }

 private:
  std::vector<std::string> chainUp(const std::string& frame) {
    std::vector<std::string> chain{frame};
    while (parents_.contains(chain.back())) {
      chain.push_back(parents_[chain.back()]);
    }
    return chain;
  }
  std::optional<RigidTransform> at(const std::string& child, std::int64_t time, bool static_for_all_time) {
    const auto& samples = samples_[child];
    const auto after = samples.upper_bound(time);
    if (after != samples.begin()) {
      return std::prev(after)->second;
    }
    return static_for_all_time && all_static_[child] ? std::optional(samples.begin()->second) : std::nullopt;
  }

  std::set<std::string> frames_;
  std::map<std::string, std::string> parents_;
  std::map<std::string, std::map<std::int64_t, RigidTransform>> samples_;
  std::map<std::string, bool> all_static_;
};

void expectSame(const std::expected<RigidTransform, LookupFailure>& actual, const Model::Answer& expected,
                const TransformBuffer& buffer) {
  ASSERT_EQ(actual.has_value(), !expected.error.has_value());
  if (!actual) {
    ASSERT_EQ(toString(actual.error().code), toString(*expected.error));
    if (actual.error().code == LookupError::NoSampleAtTime) {
      ASSERT_EQ(buffer.frameName(actual.error().edge_child), expected.failing_child);
    }
    return;
  }
  ASSERT_LT(placementError(RigidReference(*actual), expected.target_from_source), 1e-12);
  ASSERT_LT(rotationError(RigidReference(*actual), expected.target_from_source), 1e-14);
}

class AgainstModel : public testing::TestWithParam<unsigned> {};

TEST_P(AgainstModel, AnyInsertsAndAnyQuestionsAgree) {
  std::mt19937_64 random(GetParam());
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
  const auto anyTime = [&]() -> std::int64_t {
    switch (below(12)) {
      case 0:
        return std::numeric_limits<std::int64_t>::min() + static_cast<std::int64_t>(below(3));
      case 1:
        return std::numeric_limits<std::int64_t>::max() - static_cast<std::int64_t>(below(3));
      default:
        return static_cast<std::int64_t>(below(400)) - 200;
    }
  };
  const std::optional<std::int64_t> retention =
      GetParam() % 3 == 0 ? std::optional<std::int64_t>(static_cast<std::int64_t>(below(150))) : std::nullopt;
  const bool static_for_all_time = GetParam() % 2 == 0;
  const bool in_bulk = GetParam() % 4 < 2;
  TransformBuffer buffer(retention);
  buffer.setStaticForAllTime(static_for_all_time);
  Model model;
  std::vector<std::string> names{"map", "/odom", "base link", "\xC3\xBC"};
  for (std::size_t i = 0; i < 4 + below(20); ++i) {
    names.push_back(numbered("f", i));
  }
  const auto anyName = [&] { return names[below(names.size())]; };

  for (int round = 0; round < 5; ++round) {
    std::vector<TransformSample> bulk;
    std::size_t accepted = 0;
    for (int i = 0; i < 600; ++i) {
      // Mostly along a tree (a frame below an earlier one), now and then anywhere.
      const std::size_t child = below(names.size());
      const bool wild = below(20) == 0;
      const std::string& parent = names[wild || child == 0 ? below(names.size()) : below(child)];
      const std::int64_t stamp = anyTime();
      const RigidTransform transform = randomTransform(random, 0.0, 10.0);
      const bool is_static = below(10) != 0 && child % 3 == 0;
      const auto expected =
          model.insert(std::string(stripLeadingSlashes(parent)), std::string(stripLeadingSlashes(names[child])), stamp,
                       transform, is_static, retention);
      const TransformSample item = tf::sample(parent, names[child], stamp, transform, is_static);
      accepted += expected ? 0 : 1;
      if (in_bulk) {
        bulk.push_back(item);
        continue;
      }
      const auto actual = buffer.insert(item);
      ASSERT_EQ(actual.has_value(), !expected.has_value());
      if (expected) {
        ASSERT_EQ(toString(actual.error()), toString(*expected));
      }
    }
    if (in_bulk) {
      const auto report = buffer.insertBulk(bulk);
      ASSERT_EQ(report.inserted, accepted);
      ASSERT_EQ(report.refused, bulk.size() - accepted);
    }
    ASSERT_EQ(buffer.frameCount(), model.frames().size());
    for (const std::string& frame : model.frames()) {
      const auto edge = buffer.edge(*buffer.findFrame(frame));
      ASSERT_EQ(edge ? edge->samples : 0u, model.sampleCount(frame));
    }
    for (int query = 0; query < 300; ++query) {
      const std::string target = below(50) == 0 ? "ghost" : std::string(stripLeadingSlashes(anyName()));
      const std::string source = std::string(stripLeadingSlashes(anyName()));
      const std::int64_t time = anyTime();
      expectSame(buffer.tryLookupTransform(target, source, TimePoint{time}),
                 model.lookup(target, source, time, static_for_all_time), buffer);
    }
    Snapshot snapshot;
    for (int query = 0; query < 10; ++query) {
      const std::string root = buffer.frameName(static_cast<FrameId>(below(buffer.frameCount())));
      const std::int64_t time = anyTime();
      buffer.snapshot(*buffer.findFrame(root), TimePoint{time}, snapshot);
      ASSERT_EQ(snapshot.root_from_frame.size(), buffer.frameCount());
      for (FrameId frame = 0; frame < buffer.frameCount(); ++frame) {
        expectSame(snapshot.root_from_frame[frame],
                   model.lookup(root, buffer.frameName(frame), time, static_for_all_time), buffer);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, AgainstModel, testing::Range(0u, 24u));

}  // namespace
}  // namespace stillframe::tf
