#include "nodes/markers/scene_history.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/support/builders.h"

namespace stillframe::nodes {
namespace {

using namespace tf::literals;
using scenegraph::CubePrimitive;
using scenegraph::SceneEntities;
using scenegraph::SceneEntity;
using scenegraph::SceneEntityDeletion;
using testing::ElementsAre;
using testing::IsEmpty;

SceneEntity cube(const std::string& id, double x = 0.0, std::int64_t lifetime_ns = 0) {
  SceneEntity entity;
  entity.id = id;
  entity.frame_id = "map";
  entity.lifetime_ns = lifetime_ns;
  entity.cubes.push_back({.pose = {.translation = {x, 0, 0}}, .size = {1, 1, 1}, .color = {}});
  return entity;
}

SceneEntityDeletion deletion(const std::string& id) {
  return {.type = id.empty() ? SceneEntityDeletion::Type::All : SceneEntityDeletion::Type::MatchingId,
          .stamp = {std::numeric_limits<std::int64_t>::max()},
          .id = id,
          .marker_namespace = ""};
}

/// Messages as a store would hold them.
class Stream {
 public:
  Stream& at(std::int64_t log_ns) {
    messages_.push_back({.log_time = {log_ns}, .sequence = next_++, .payload_bytes = 100, .scene = nullptr});
    scene_ = std::make_shared<SceneEntities>();
    messages_.back().scene = scene_;
    return *this;
  }
  Stream& add(SceneEntity entity) {
    scene_->steps.push_back({false, scene_->entities.size()});
    scene_->entities.push_back(std::move(entity));
    return *this;
  }
  Stream& remove(const SceneEntityDeletion& gone) {
    scene_->steps.push_back({true, scene_->deletions.size()});
    scene_->deletions.push_back(gone);
    return *this;
  }
  /// A message that arrives late.
  void insert(std::size_t place, std::int64_t log_ns, SceneEntity entity) {
    at(log_ns).add(std::move(entity));
    std::rotate(messages_.begin() + static_cast<std::ptrdiff_t>(place), messages_.end() - 1, messages_.end());
  }
  void breakLast(const std::string& why) {
    messages_.back().scene = std::unexpected(scenegraph::DecodeError{"BadChunk", why});
  }
  SceneMessage& last() { return messages_.back(); }

  [[nodiscard]] SceneState state(SceneHistory& history, std::int64_t time_ns) {
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(messages_, [&](const SceneMessage& message) { return message.log_time.ns <= time_ns; }));
    return history.at(
        count, {time_ns}, [&](std::size_t place) { return messages_[place].sequence; },
        [&](std::size_t place) {
          ++fetched;
          return messages_[place];
        });
  }
  int fetched = 0;

 private:
  std::vector<SceneMessage> messages_;
  std::shared_ptr<SceneEntities> scene_;
  std::uint64_t next_ = 0;
};

std::set<std::string> ids(const SceneState& state) {
  std::set<std::string> found;
  for (std::size_t slot = 0; slot < state.slotCount(); ++slot) {
    if (state.at(slot) != nullptr) {
      found.insert(state.at(slot)->id);
    }
  }
  EXPECT_EQ(found.size(), state.totals.entities);
  return found;
}

/// All that a state says, bit for bit.
std::string text(const SceneState& state) {
  std::string out = std::to_string(state.totals.primitives) + "/" + std::to_string(state.refused) + "/" +
                    std::to_string(state.next_expiry.ns) + "/" + std::to_string(state.last_expiry.ns) + "\n";
  for (const ShapeBatch& batch : state.batches) {
    out += batch.frame_id + " " + std::to_string(static_cast<int>(batch.key.kind)) + " " +
           std::to_string(batch.key.cell[0]) + ": " + std::to_string(batch.size) + "\n";
  }
  for (std::size_t slot = 0; slot < state.slotCount(); ++slot) {
    if (const LiveEntity* const entity = state.at(slot)) {
      out += std::to_string(slot) + " " + entity->id;
      for (const ShapeRun& run : entity->shapes.runs) {
        out += " " + std::to_string(run.first) + "+" + std::to_string(run.instances.size()) + "@" +
               std::to_string(run.instances[0].local_from_mesh[3]);
      }
      out += "\n";
    }
  }
  return out;
}

TEST(SceneHistory, ReplacesDeletesAndEndsLifetimesOnLogTime) {
  Stream stream;
  stream.at(1_s).add(cube("a")).add(cube("b", 0, 2_s)).at(2_s).add(cube("a", 5)).at(4_s).remove(deletion("a"));
  stream.at(5_s).add(cube("c")).add(cube("d")).at(6_s).remove(deletion("")).add(cube("e"));
  SceneHistory history;
  EXPECT_THAT(ids(stream.state(history, 1_s)), ElementsAre("a", "b"));
  EXPECT_EQ(stream.state(history, 2_s).at(0)->shapes.runs[0].instances[0].local_from_mesh[3], 5.0F);
  EXPECT_THAT(ids(stream.state(history, 3_s - 1)), ElementsAre("a", "b"));
  EXPECT_THAT(ids(stream.state(history, 3_s)), ElementsAre("a"));
  EXPECT_THAT(ids(stream.state(history, 4_s)), IsEmpty());
  EXPECT_THAT(ids(stream.state(history, 5_s)), ElementsAre("c", "d"));
  EXPECT_THAT(ids(stream.state(history, 6_s)), ElementsAre("e"));
  EXPECT_THAT(ids(stream.state(history, 2_s)), ElementsAre("a", "b")) << "and back";
}

TEST(SceneHistory, SaysHowLongAStateHolds) {
  Stream stream;
  stream.at(1_s).add(cube("a", 0, 1_s)).add(cube("b", 0, 3_s));
  SceneHistory history;
  const SceneState state = stream.state(history, 3_s);
  EXPECT_EQ(state.last_expiry.ns, 2_s);
  EXPECT_EQ(state.next_expiry.ns, 4_s);
}

TEST(SceneHistory, DeletesOnlyWhatIsStampedBefore) {
  Stream stream;
  SceneEntity late = cube("late");
  late.stamp = {50};
  SceneEntityDeletion all = deletion("");
  all.stamp = {49};
  stream.at(1_s).add(late).add(cube("early")).at(2_s).remove(all);
  SceneHistory history;
  EXPECT_THAT(ids(stream.state(history, 2_s)), ElementsAre("late"));
}

TEST(SceneHistory, KeepsAPlaceInItsBatchAsLongAsTheEntityLives) {
  Stream stream;
  stream.at(1_s).add(cube("a")).add(cube("b")).add(cube("c")).at(2_s).remove(deletion("a")).add(cube("c", 7));
  stream.at(3_s).add(cube("d"));
  SceneHistory history;
  SceneState state = stream.state(history, 2_s);
  ASSERT_EQ(state.batches.size(), 1U);
  EXPECT_EQ(state.batches[0].size, 3U);
  EXPECT_EQ(state.at(1)->shapes.runs[0].first, 1U);
  EXPECT_EQ(state.at(2)->shapes.runs[0].first, 2U);
  state = stream.state(history, 3_s);
  EXPECT_EQ(state.at(0)->id, "d");
  EXPECT_EQ(state.at(0)->shapes.runs[0].first, 0U);
}

TEST(SceneHistory, SharesWhatDoesNotChange) {
  Stream stream;
  stream.at(1_s);
  for (int i = 0; i < 10'000; ++i) {
    stream.add(cube(std::to_string(i), i));
  }
  stream.at(2_s).add(cube("5000", -1));
  SceneHistory history;
  const SceneState before = stream.state(history, 1_s);
  const SceneState after = stream.state(history, 2_s);
  std::vector<std::size_t> changed;
  forEachChange(before, after, [&](std::size_t slot, const LiveEntity*, const LiveEntity* now) {
    changed.push_back(slot);
    EXPECT_EQ(now->id, "5000");
  });
  EXPECT_THAT(changed, ElementsAre(5000U));
}

/// Anything that a stream may hold.
Stream randomStream(unsigned seed, int messages) {
  test::Random random(seed);
  Stream stream;
  for (int i = 0; i < messages; ++i) {
    stream.at(i * 100_ms);
    for (std::size_t n = random.index(6); n > 0; --n) {
      const std::string id = std::to_string(random.index(60));
      switch (random.index(random.index(20) == 0 ? 4 : 3)) {
        case 0:
          stream.add(cube(id, random.number(-9000, 9000), random.index(2) == 0 ? 0 : 350_ms));
          break;
        case 1: {
          SceneEntity many = cube(id, i);
          many.frame_id = random.index(2) == 0 ? "map" : "base";
          many.cubes.resize(1 + random.index(40), many.cubes[0]);
          many.spheres.push_back({.pose = {}, .size = {1, 1, 1}, .color = {1, 0, 0, 0.5F}});
          stream.add(many);
          break;
        }
        case 2:
          stream.remove(deletion(id));
          break;
        default:
          stream.remove(deletion(""));
      }
    }
  }
  return stream;
}

TEST(SceneHistory, AnyPathToATimeGivesTheSameState) {
  Stream stream = randomStream(5, 400);
  SceneHistory walker(std::size_t{1} << 30U, 300'000);
  test::Random random(6);
  for (int goal = 0; goal < 150; ++goal) {
    const std::int64_t time = static_cast<std::int64_t>(random.index(45'000)) * 1_ms;
    SceneHistory straight;
    ASSERT_EQ(text(stream.state(walker, time)), text(stream.state(straight, time))) << time;
  }
  EXPECT_GT(walker.byteSize(), 0U);
}

TEST(SceneHistory, NoPlaceHoldsTwoEntities) {
  Stream stream = randomStream(9, 300);
  SceneHistory history;
  for (std::int64_t time = 0; time < 30_s; time += 700_ms) {
    const SceneState state = stream.state(history, time);
    std::map<std::pair<std::string, ShapeBatchKey>, std::set<std::uint32_t>> taken;
    for (std::size_t slot = 0; slot < state.slotCount(); ++slot) {
      for (const ShapeRun& run : state.at(slot) != nullptr ? state.at(slot)->shapes.runs : FewOf<ShapeRun>{}) {
        for (std::uint32_t i = 0; i < run.instances.size(); ++i) {
          ASSERT_TRUE((taken[{state.at(slot)->frame_id, run.key}].insert(run.first + i).second));
        }
      }
    }
    for (const auto& [id, places] : taken) {
      const auto batch = std::ranges::find_if(state.batches, [&](const ShapeBatch& candidate) {
        return candidate.frame_id == id.first && candidate.key == id.second;
      });
      ASSERT_NE(batch, state.batches.end());
      ASSERT_LT(*places.rbegin(), batch->size);
    }
  }
}

TEST(SceneHistory, ClosesGapsWhenMostOfABatchIsGone) {
  Stream stream;
  stream.at(1_s);
  for (int i = 0; i < 5000; ++i) {
    stream.add(cube(std::to_string(i)));
  }
  stream.at(2_s);
  for (int i = 0; i < 4990; ++i) {
    stream.remove(deletion(std::to_string(i)));
  }
  SceneHistory history;
  EXPECT_EQ(stream.state(history, 1_s).batches[0].size, 5000U);
  EXPECT_EQ(stream.state(history, 2_s).batches[0].size, 10U);
  EXPECT_EQ(stream.state(history, 2_s).totals.entities, 10U);
}

TEST(SceneHistory, ReadsALongStreamOnceAndGoesBackByCheckpoints) {
  Stream stream;
  for (int i = 0; i < 5000; ++i) {
    stream.at(i * 10_ms).add(cube(std::to_string(i % 50), i));
    stream.last().payload_bytes = 20'000;
  }
  SceneHistory history;
  (void)stream.state(history, 50_s);
  EXPECT_EQ(stream.fetched, 5000);
  EXPECT_GT(history.checkpointCount(), 20U);
  (void)stream.state(history, 50_s);
  EXPECT_EQ(stream.fetched, 5000);
  (void)stream.state(history, 25_s);
  EXPECT_LT(stream.fetched, 5000 + 200);
}

TEST(SceneHistory, NoticesWhatArrivedLate) {
  Stream stream;
  stream.at(1_s).add(cube("a")).at(3_s).remove(deletion("b"));
  SceneHistory history;
  EXPECT_THAT(ids(stream.state(history, 3_s)), ElementsAre("a"));
  stream.insert(1, 2_s, cube("c"));
  EXPECT_THAT(ids(stream.state(history, 3_s)), ElementsAre("a", "c"));
}

TEST(SceneHistory, RefusesWhatFindsNoRoomAndGoesOn) {
  Stream stream;
  stream.at(1_s).add(cube("small"));
  SceneEntity big = cube("big");
  big.cubes.resize(100'000, big.cubes[0]);
  stream.add(big).add(cube("after"));
  SceneHistory history(1'000'000);
  const SceneState state = stream.state(history, 1_s);
  EXPECT_THAT(ids(state), ElementsAre("after", "small"));
  EXPECT_EQ(state.refused, 1U);
}

TEST(SceneHistory, BoundsTheDrawCallsOfEntitiesInAsManyFrames) {
  Stream stream;
  stream.at(1_s);
  for (int i = 0; i < 6000; ++i) {
    SceneEntity entity = cube(std::to_string(i));
    entity.frame_id = "frame" + entity.id;
    stream.add(entity);
  }
  SceneHistory history;
  const SceneState state = stream.state(history, 1_s);
  EXPECT_EQ(state.batches.size(), SceneHistory::kMostBatches);
  EXPECT_EQ(state.refused, 6000U - SceneHistory::kMostBatches);
}

TEST(SceneHistory, CountsMessagesThatCannotBeRead) {
  Stream stream;
  stream.at(1_s).add(cube("a")).at(2_s);
  stream.breakLast("too short");
  SceneHistory history;
  const SceneState state = stream.state(history, 2_s);
  EXPECT_THAT(ids(state), ElementsAre("a"));
  EXPECT_EQ(state.undecodable, 1U);
  ASSERT_TRUE(state.failure);
  EXPECT_EQ(state.failure->message, "too short");
}

TEST(SceneHistory, HoldsAnEntityOfTheLongestLifetime) {
  Stream stream;
  stream.at(1_s).add(cube("a", 0, std::numeric_limits<std::int64_t>::max())).add(cube("b", 0, -5));
  SceneHistory history;
  EXPECT_THAT(ids(stream.state(history, 9'000'000'000_s)), ElementsAre("a", "b"));
}

}  // namespace
}  // namespace stillframe::nodes
