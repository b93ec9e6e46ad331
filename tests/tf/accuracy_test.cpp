#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tf/transform_buffer.h"
#include "tf/wide_transform.h"
#include "tf_builders.h"
#include "tools/accuracy/rigid_reference.h"

namespace stillframe::tf {
namespace {

using accuracy::placementError;
using accuracy::RigidReference;
using accuracy::rotationError;

/// A chain frame_0 (root) .. frame_n (leaf) and what its end should be.
struct ReferencedChain {
  ReferencedChain(std::size_t depth, double min_offset, double max_offset, unsigned seed) {
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < depth; ++i) {
      const RigidTransform link = randomTransform(random, min_offset, max_offset);
      EXPECT_TRUE(buffer.insert(sample(numbered("frame_", i), numbered("frame_", i + 1), 0, link)));
      root_from_leaf = root_from_leaf * RigidReference(link);
    }
    leaf = numbered("frame_", depth);
  }
  TransformBuffer buffer;
  RigidReference root_from_leaf;
  std::string leaf;
};

TEST(TransformAccuracy, PlacesChainsOf256AtMillionsOfMetresWithinAMicrometre) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const ReferencedChain chain(256, 1e6, 1e7, seed);
    const RigidReference found(chain.buffer.lookupTransform("frame_0", chain.leaf, {}));
    EXPECT_LT(placementError(found, chain.root_from_leaf), 1e-6 / 4) << seed;
    EXPECT_LT(rotationError(found, chain.root_from_leaf), 5e-15 / 10) << seed;
    const RigidReference back(chain.buffer.lookupTransform(chain.leaf, "frame_0", {}));
    EXPECT_LT(placementError(back, inverse(chain.root_from_leaf)), 1e-6 / 4) << seed;
    EXPECT_LT(rotationError(back, inverse(chain.root_from_leaf)), 5e-15 / 10) << seed;
  }
}

TEST(TransformAccuracy, SnapshotsAreAsExactAsLookupsInBothDirections) {
  const ReferencedChain chain(256, 1e6, 1e7, 99);
  Snapshot snapshot;
  const FrameId root = *chain.buffer.findFrame("frame_0");
  const FrameId leaf = *chain.buffer.findFrame(chain.leaf);
  chain.buffer.snapshot(root, {}, snapshot);
  EXPECT_LT(placementError(RigidReference(*snapshot.root_from_frame[leaf]), chain.root_from_leaf), 1e-6 / 4);
  chain.buffer.snapshot(leaf, {}, snapshot);
  const RigidReference expected = inverse(chain.root_from_leaf);
  EXPECT_LT(placementError(RigidReference(*snapshot.root_from_frame[root]), expected), 1e-6 / 4);
  EXPECT_LT(rotationError(RigidReference(*snapshot.root_from_frame[root]), expected), 5e-15 / 10);
}

TEST(TransformAccuracy, LongChainsStayExact) {
  const ReferencedChain chain(1024, 1e6, 1e7, 5);
  const RigidReference found(chain.buffer.lookupTransform("frame_0", chain.leaf, {}));
  EXPECT_LT(placementError(found, chain.root_from_leaf), 1e-6 / 4);
  EXPECT_LT(rotationError(found, chain.root_from_leaf), 5e-15 / 10);
}

TEST(TransformAccuracy, NeighboursFarFromTheirParentKeepTheirDistance) {
  TransformBuffer buffer;
  std::mt19937_64 random(17);
  const RigidTransform left = randomTransform(random, 6e6, 6.4e6);  // as far as the centre of the Earth
  RigidTransform right = left;
  right.translation += glm::dvec3(0.5, -0.25, 1.0);
  ASSERT_TRUE(buffer.insert(sample("earth", "left", 0, left)));
  ASSERT_TRUE(buffer.insert(sample("earth", "right", 0, right)));
  const RigidReference found(buffer.lookupTransform("left", "right", {}));
  const RigidReference expected = inverse(RigidReference(left)) * RigidReference(right);
  EXPECT_LT(placementError(found, expected), 1e-15);
}

TEST(TransformAccuracy, OneEdgeAnswersWithWhatWasInserted) {
  std::mt19937_64 random(23);
  for (int i = 0; i < 1000; ++i) {
    TransformBuffer buffer;
    const RigidTransform link = randomTransform(random, 1e-9, 1e9);
    ASSERT_TRUE(buffer.insert(sample("a", "b", 0, link)));
    const RigidTransform found = buffer.lookupTransform("a", "b", {});
    for (glm::length_t k = 0; k < 3; ++k) {
      ASSERT_EQ(found.translation[k], link.translation[k]);  // bit for bit: nothing was computed
    }
    ASSERT_LT(rotationError(RigidReference(found), RigidReference(link)), 4e-16);
  }
}

TEST(TransformAccuracy, InverseTimesTransformIsIdentity) {
  std::mt19937_64 random(29);
  for (int i = 0; i < 1000; ++i) {
    const RigidTransform transform = randomTransform(random, 1.0, 1e9);
    const double scale = glm::length(transform.translation);
    for (const RigidTransform& product : {inverse(transform) * transform, transform * inverse(transform)}) {
      ASSERT_LT(glm::length(product.translation), 1e-15 * scale);
      ASSERT_LT(rotationError(RigidReference(product), RigidReference()), 1e-15);
    }
  }
}

TEST(TransformAccuracy, AMillionSmallRotationsStayUnit) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> small(-1e-3, 1e-3);
  RigidTransform product;
  ChainAccumulator chain;
  double worst = 0.0;
  for (int i = 0; i < 1'000'000; ++i) {
    const glm::dquat turn(1.0, small(random), small(random), small(random));
    const RigidTransform step{*normalizedRotation(turn), {1e-3, 0, 0}};
    product = product * step;
    chain.append(step);
    worst = std::max(worst, std::abs(glm::length(product.rotation) - 1.0));
  }
  EXPECT_LT(worst, 1e-12);
  const RigidTransform accumulated = chain.narrow();
  EXPECT_NEAR(glm::length(accumulated.rotation), 1.0, 1e-12);
  EXPECT_LT(rotationError(RigidReference(accumulated), RigidReference(product)), 1e-12);
  EXPECT_LT(placementError(RigidReference(accumulated), RigidReference(product)), 1e-9);
}

TEST(TransformAccuracy, StoredNormsDoNotScaleWhatLiesBehindThem) {
  // Every quaternion is short by the most that still passes for unit; 256 of them must not shrink the chain.
  TransformBuffer buffer;
  RigidReference expected;
  const double shrunk = 1.0 - std::numeric_limits<double>::epsilon() / 2;
  const RigidTransform link{{0.5 * shrunk, 0.5 * shrunk, 0.5 * shrunk, 0.5 * shrunk}, {1e9, -2e8, 3e7}};
  for (std::size_t i = 0; i < 256; ++i) {
    ASSERT_TRUE(buffer.insert(sample(numbered("frame_", i), numbered("frame_", i + 1), 0, link)));
    expected = expected * RigidReference(link);
  }
  EXPECT_LT(placementError(RigidReference(buffer.lookupTransform("frame_0", "frame_256", {})), expected), 1e-4);
}

}  // namespace
}  // namespace stillframe::tf
