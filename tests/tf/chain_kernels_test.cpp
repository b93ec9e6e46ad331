#include "tf/chain_kernels.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "tf/chain_accumulator.h"
#include "tf_builders.h"
#include "tools/accuracy/rigid_reference.h"

namespace stillframe::tf {
namespace {

using accuracy::placementError;
using accuracy::RigidReference;
using accuracy::rotationError;

struct LinkedChain {
  explicit LinkedChain(std::size_t depth, double min_offset, double max_offset, unsigned seed) {
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < depth; ++i) {
      links.push_back(randomTransform(random, min_offset, max_offset));
    }
    for (const RigidTransform& link : links) {
      pointers.push_back(&link);
      product = product * RigidReference(link);
    }
  }
  LinkedChain(const LinkedChain&) = delete;
  LinkedChain& operator=(const LinkedChain&) = delete;

  std::vector<RigidTransform> links;
  std::vector<const RigidTransform*> pointers;
  RigidReference product;
};

void expectSameBits(const ChainParts& a, const ChainParts& b) {
  for (const auto lanes : {&ChainParts::high, &ChainParts::low, &ChainParts::sum, &ChainParts::rest}) {
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>((a.*lanes)[i]), std::bit_cast<std::uint64_t>((b.*lanes)[i])) << i;
    }
  }
}

/// Every link a step from the one before.
std::vector<ChainStep> stepsAlong(const LinkedChain& chain, std::vector<ChainParts>& parts) {
  parts.assign(chain.links.size() + 1, {});
  std::vector<ChainStep> steps;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    steps.push_back({&parts[i], &chain.links[i], &parts[i + 1], {}});
  }
  return steps;
}

TEST(ChainKernels, EveryInstructionSetGivesTheSameBits) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const LinkedChain chain(1 + seed * 3, 1e-9, 1e9, seed);
    ChainParts plain;
    ChainParts best;
    ChainKernels::portable().append(plain, chain.pointers);
    ChainKernels::best().append(best, chain.pointers);
    expectSameBits(plain, best);

    std::vector<ChainParts> plain_parts;
    std::vector<ChainParts> best_parts;
    auto plain_steps = stepsAlong(chain, plain_parts);
    auto best_steps = stepsAlong(chain, best_parts);
    ChainKernels::portable().append_each(plain_steps);
    ChainKernels::best().append_each(best_steps);
    for (std::size_t i = 0; i < plain_steps.size(); ++i) {
      expectSameBits(plain_parts[i + 1], best_parts[i + 1]);
      const RigidReference a(plain_steps[i].rounded);
      const RigidReference b(best_steps[i].rounded);
      ASSERT_EQ(placementError(a, b) + rotationError(a, b), 0.0);
    }
  }
}

TEST(ChainKernels, EachIsAsExactAsItsResultCanBeWritten) {
  for (const ChainKernels* kernels : {&ChainKernels::portable(), &ChainKernels::best()}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const LinkedChain chain(256, 1e6, 1e7, seed);
      ChainAccumulator all;
      kernels->append(all.parts, chain.pointers);
      EXPECT_LT(placementError(RigidReference(all.narrow()), chain.product), 2.5e-7);
      EXPECT_LT(rotationError(RigidReference(all.narrow()), chain.product), 3e-16);

      std::vector<ChainParts> parts;
      auto steps = stepsAlong(chain, parts);
      kernels->append_each(steps);
      EXPECT_LT(placementError(RigidReference(steps.back().rounded), chain.product), 2.5e-7);
      EXPECT_LT(rotationError(RigidReference(steps.back().rounded), chain.product), 3e-16);
    }
  }
}

TEST(ChainKernels, AQuarterMillionLinksAtOnceLoseNothing) {
  // The low part grows along the way and is folded only at the end.
  const LinkedChain chain(250'000, 0.1, 1.0, 3);
  ChainAccumulator all;
  all.append(chain.pointers);
  EXPECT_LT(rotationError(RigidReference(all.narrow()), chain.product), 3e-16);
  EXPECT_LT(placementError(RigidReference(all.narrow()), chain.product), 1e-12);
}

TEST(ChainKernels, AppendInverseUndoesAppend) {
  const LinkedChain chain(64, 1e6, 1e7, 8);
  ChainAccumulator there_and_back;
  there_and_back.append(chain.pointers);
  for (std::size_t i = chain.links.size(); i-- > 0;) {
    there_and_back.appendInverse(chain.links[i]);
  }
  EXPECT_LT(placementError(RigidReference(there_and_back.narrow()), RigidReference()), 2.5e-7);
  EXPECT_LT(rotationError(RigidReference(there_and_back.narrow()), RigidReference()), 3e-16);
}

}  // namespace
}  // namespace stillframe::tf
