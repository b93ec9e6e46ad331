#include "nodes/markers/slot_index.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

namespace stillframe::test {
namespace {

using nodes::SlotIndex;

TEST(SlotIndex, AnswersAsAMapWhateverComesAndGoes) {
  std::mt19937 random(7);
  SlotIndex index;
  std::map<std::string, std::size_t> known;
  std::vector<std::string> ids(400);
  const auto idOf = [&](std::size_t slot) -> std::string_view { return ids[slot]; };
  std::vector<std::size_t> free;
  for (std::size_t slot = 0; slot < ids.size(); ++slot) {
    free.push_back(slot);
  }
  for (int step = 0; step < 40'000; ++step) {
    const std::string id = "5:cubes:" + std::to_string(random() % 600);
    const auto slot = index.find(id, idOf);
    const auto wanted = known.find(id);
    ASSERT_EQ(slot.has_value(), wanted != known.end()) << id;
    if (slot) {
      ASSERT_EQ(*slot, wanted->second) << id;
      index.erase(id, *slot);
      known.erase(wanted);
      free.push_back(*slot);
    } else if (!free.empty()) {
      const std::size_t next = free[random() % free.size()];
      std::erase(free, next);
      ids[next] = id;
      index.insert(id, next);
      known.emplace(id, next);
    }
    ASSERT_EQ(index.empty(), known.empty());
  }
  for (const auto& [id, slot] : known) {
    EXPECT_EQ(index.find(id, idOf), slot);
    index.erase(id, slot);
  }
  EXPECT_TRUE(index.empty());
}

}  // namespace
}  // namespace stillframe::test
