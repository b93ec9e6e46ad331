// A program of its own: it replaces the global operator new to count what a lookup allocates.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tf/transform_buffer.h"
#include "tf_builders.h"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto boundary = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(boundary, (size + boundary - 1) / boundary * boundary)) {
    return memory;
  }
  throw std::bad_alloc();
}
// Inlined, GCC sees free() for what its own operator new made, and warns.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace stillframe::tf {
namespace {

TransformBuffer& longChain() {
  static TransformBuffer buffer;
  if (buffer.frameCount() == 0) {
    for (std::size_t i = 0; i < 1000; ++i) {
      EXPECT_TRUE(buffer.insert(sample(numbered("a_long_robot_frame_name_", i),
                                       numbered("a_long_robot_frame_name_", i + 1), 100, translate(1, 0, 0))));
    }
    EXPECT_TRUE(buffer.insert(sample("another_tree_altogether", "its_only_leaf_frame", 100)));
  }
  return buffer;
}

TEST(Allocations, LookupsMakeNoneOnHitOrMiss) {
  const TransformBuffer& buffer = longChain();
  const std::string root = "a_long_robot_frame_name_0";
  const std::string leaf = "a_long_robot_frame_name_1000";
  const std::string apart = "its_only_leaf_frame";
  const std::string ghost = "a_frame_that_has_never_been_seen_by_anyone";
  int hits = 0;
  const std::size_t before = allocations;
  hits += buffer.tryLookupTransform(root, leaf, TimePoint{100}) ? 1 : 0;
  hits += buffer.tryLookupTransform(leaf, root, TimePoint{100}) ? 1 : 0;
  hits += buffer.tryLookupTransform(leaf, leaf, TimePoint{0}) ? 1 : 0;
  hits += buffer.tryLookupTransform(root, leaf, TimePoint{99}) ? 1 : 0;
  hits += buffer.tryLookupTransform(root, apart, TimePoint{100}) ? 1 : 0;
  hits += buffer.tryLookupTransform(root, ghost, TimePoint{100}) ? 1 : 0;
  hits += buffer.tryLookupTransform(ghost, root, TimePoint{100}) ? 1 : 0;
  hits += buffer.findFrame(ghost) ? 1 : 0;
  hits += buffer.stampInForce(5, TimePoint{0}) ? 1 : 0;
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(hits, 3);
}

TEST(Allocations, AReusedSnapshotMakesNone) {
  const TransformBuffer& buffer = longChain();
  Snapshot snapshot;
  buffer.snapshot(0, TimePoint{100}, snapshot);
  const std::size_t before = allocations;
  for (FrameId root = 0; root < 10; ++root) {
    buffer.snapshot(root * 100, TimePoint{root % 2 == 0 ? 100 : 99}, snapshot);
  }
  EXPECT_EQ(allocations, before);
}

TEST(Allocations, KnownEdgesAreFoundWithoutAny) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("a_long_robot_frame_name_0", "a_long_robot_frame_name_1", 0)));
  const TransformSample replacement = sample("a_long_robot_frame_name_0", "a_long_robot_frame_name_1", 0);
  const std::size_t before = allocations;
  EXPECT_TRUE(buffer.insert(replacement));
  EXPECT_EQ(buffer.insertBulk({&replacement, 1}).inserted, 1u);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace stillframe::tf
