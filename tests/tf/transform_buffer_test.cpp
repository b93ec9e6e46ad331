#include "tf/transform_buffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tf_builders.h"

namespace stillframe::tf {
namespace {

using testing::ElementsAre;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.z, expected.z, tolerance);
}

/// Seen from outside: what a refused insert must leave alone.
void expectUntouchedBy(TransformBuffer& buffer, const TransformSample& refused, InsertError error) {
  const auto frames = buffer.frames();
  const auto revision = buffer.revision();
  const auto bytes = buffer.sampleBytes();
  const auto result = buffer.insert(refused);
  ASSERT_FALSE(result);
  EXPECT_EQ(toString(result.error()), toString(error));
  EXPECT_EQ(buffer.frames(), frames);
  EXPECT_EQ(buffer.revision(), revision);
  EXPECT_EQ(buffer.sampleBytes(), bytes);
}

TEST(TransformBuffer, LookupTakesSourcePointsToTarget) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "base", 0, yaw(std::numbers::pi / 2, 10, 0, 0))));
  ASSERT_TRUE(buffer.insert(sample("base", "lidar", 0, translate(1, 2, 3))));
  ASSERT_TRUE(buffer.insert(sample("base", "camera", 0, yaw(std::numbers::pi, 0, 0, 1))));
  const glm::dvec3 origin(0.0);
  expectNear(transformPoint(buffer.lookupTransform("map", "lidar", {}), origin), {8, 1, 3});
  expectNear(transformPoint(buffer.lookupTransform("lidar", "map", {}), {8, 1, 3}), origin);
  expectNear(transformPoint(buffer.lookupTransform("camera", "lidar", {}), origin), {-1, -2, 2});
  expectNear(transformPoint(buffer.lookupTransform("lidar", "camera", {}), {-1, -2, 2}), origin);
}

TEST(TransformBuffer, HoldsZeroOrderOnEveryEdge) {
  TransformBuffer buffer;
  for (const std::int64_t stamp : {10, 20, 30}) {
    ASSERT_TRUE(buffer.insert(sample("map", "base", stamp, translate(static_cast<double>(stamp), 0, 0))));
  }
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{10}).translation.x, 10);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{19}).translation.x, 10);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{20}).translation.x, 20);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{kMax}).translation.x, 30);
  const FrameId base = *buffer.findFrame("base");
  EXPECT_EQ(buffer.stampInForce(base, TimePoint{29}), TimePoint{20});
  EXPECT_EQ(buffer.stampInForce(base, TimePoint{9}), std::nullopt);
  EXPECT_EQ(buffer.stampInForce(*buffer.findFrame("map"), TimePoint{29}), std::nullopt);
}

TEST(TransformBuffer, NamesFirstFailingEdgeFromSourceUpThenFromTargetUp) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "a", 10)));
  ASSERT_TRUE(buffer.insert(sample("a", "b", 50)));
  ASSERT_TRUE(buffer.insert(sample("b", "c", 5)));
  ASSERT_TRUE(buffer.insert(sample("map", "x", 40)));
  ASSERT_TRUE(buffer.insert(sample("map", "x", 90)));
  const auto failure = buffer.tryLookupTransform("x", "c", TimePoint{7}).error();
  EXPECT_EQ(failure.code, LookupError::NoSampleAtTime);
  EXPECT_EQ(buffer.frameName(failure.edge_child), "b");
  EXPECT_EQ(failure.edge_first, TimePoint{50});
  EXPECT_EQ(failure.time, TimePoint{7});
  EXPECT_EQ(buffer.frameName(failure.target), "x");
  EXPECT_EQ(buffer.frameName(failure.source), "c");
  const auto reverse = buffer.tryLookupTransform("c", "x", TimePoint{7}).error();
  EXPECT_EQ(buffer.frameName(reverse.edge_child), "x");
  EXPECT_EQ(reverse.edge_first, TimePoint{40});
  EXPECT_EQ(reverse.edge_last, TimePoint{90});
  const std::string sentence = buffer.describe(failure);
  for (const char* part : {"\"x\"", "\"c\"", "\"a\"", "\"b\"", "50", "7"}) {
    EXPECT_THAT(sentence, testing::HasSubstr(part));
  }
}

TEST(TransformBuffer, LooksNoFurtherThanTheCommonAncestor) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "base", 1000)));  // not yet known at 10
  ASSERT_TRUE(buffer.insert(sample("base", "left", 0, translate(0, 1, 0))));
  ASSERT_TRUE(buffer.insert(sample("base", "right", 0, translate(0, -1, 0))));
  expectNear(buffer.lookupTransform("left", "right", TimePoint{10}).translation, {0, -2, 0});
  EXPECT_FALSE(buffer.tryLookupTransform("map", "right", TimePoint{10}));
}

TEST(TransformBuffer, FrameInItselfIsIdentityAtAnyTime) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "base", 1000, translate(5, 0, 0))));
  for (const char* frame : {"map", "base", "/base"}) {
    const auto found = buffer.tryLookupTransform(frame, frame, TimePoint{kMin});
    ASSERT_TRUE(found);
    expectNear(found->translation, {0, 0, 0}, 0.0);
    EXPECT_DOUBLE_EQ(found->rotation.w, 1.0);
  }
  EXPECT_EQ(buffer.tryLookupTransform("ghost", "ghost", {}).error().code, LookupError::UnknownTarget);
}

TEST(TransformBuffer, TypesEveryLookupError) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "base", 0)));
  ASSERT_TRUE(buffer.insert(sample("moon", "rover", 0)));
  EXPECT_EQ(buffer.tryLookupTransform("ghost", "base", {}).error().code, LookupError::UnknownTarget);
  EXPECT_EQ(buffer.tryLookupTransform("ghost", "wraith", {}).error().code, LookupError::UnknownTarget);
  const auto unknown_source = buffer.tryLookupTransform("base", "ghost", {}).error();
  EXPECT_EQ(unknown_source.code, LookupError::UnknownSource);
  EXPECT_EQ(buffer.frameName(unknown_source.target), "base");
  EXPECT_EQ(unknown_source.source, kNoFrame);
  const auto apart = buffer.tryLookupTransform("base", "rover", {}).error();
  EXPECT_EQ(apart.code, LookupError::Disconnected);
  EXPECT_THAT(buffer.describe(apart), testing::AllOf(testing::HasSubstr("base"), testing::HasSubstr("rover")));
  EXPECT_EQ(buffer.tryLookupTransform(FrameId{99}, FrameId{0}, {}).error().code, LookupError::UnknownTarget);
  EXPECT_EQ(buffer.tryLookupTransform(FrameId{0}, kNoFrame, {}).error().code, LookupError::UnknownSource);
  try {
    (void)buffer.lookupTransform("base", "ghost", {});
    FAIL() << "expected an exception";
  } catch (const TransformException& exception) {
    EXPECT_EQ(exception.failure().code, LookupError::UnknownSource);
    EXPECT_THAT(exception.what(), testing::HasSubstr("ghost"));
  }
}

TEST(TransformBuffer, RefusesInTheDocumentedOrderAndChangesNothing) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "base", 0)));
  ASSERT_TRUE(buffer.insert(sample("base", "arm", 0)));
  const RigidTransform broken{{0, 0, 0, 0}, {kNan, 0, 0}};
  const RigidTransform zero{{0, 0, 0, 0}, {1, 0, 0}};
  expectUntouchedBy(buffer, sample("", "x", 0, broken), InsertError::EmptyFrameName);
  expectUntouchedBy(buffer, sample("///", "///", 0, broken), InsertError::EmptyFrameName);
  expectUntouchedBy(buffer, sample("/x", "x", 0, broken), InsertError::SelfLoop);
  expectUntouchedBy(buffer, sample("base", "/base", 0), InsertError::SelfLoop);
  expectUntouchedBy(buffer, sample("x", "base", 0, broken), InsertError::NotFinite);
  expectUntouchedBy(buffer, sample("x", "base", 0, zero), InsertError::ZeroQuaternion);
  expectUntouchedBy(buffer, sample("x", "base", 0), InsertError::ReparentConflict);
  expectUntouchedBy(buffer, sample("arm", "base", 0), InsertError::ReparentConflict);
  expectUntouchedBy(buffer, sample("arm", "map", 0), InsertError::Cycle);
  expectUntouchedBy(buffer, sample("base", "map", 0), InsertError::Cycle);
}

TEST(TransformBuffer, RefusesEveryComponentThatIsNotFinite) {
  TransformBuffer buffer;
  for (const double bad : {kNan, kInf, -kInf}) {
    for (glm::length_t i = 0; i < 3; ++i) {
      RigidTransform transform;
      transform.translation[i] = bad;
      expectUntouchedBy(buffer, sample("a", "b", 0, transform), InsertError::NotFinite);
    }
    for (glm::length_t i = 0; i < 4; ++i) {
      RigidTransform transform;
      transform.rotation[i] = bad;
      expectUntouchedBy(buffer, sample("a", "b", 0, transform), InsertError::NotFinite);
    }
  }
}

TEST(TransformBuffer, NormalisesQuaternionsOfAnyNorm) {
  const double smallest = std::numeric_limits<double>::denorm_min();
  const double largest = std::numeric_limits<double>::max();
  for (const double norm : {smallest, 1e-300, 1e-160, 1.0, 3.0, 1e160, 1e300, largest}) {
    TransformBuffer buffer;
    ASSERT_TRUE(buffer.insert(sample("a", "b", 0, {{norm, -norm, norm, -norm}, {1, 2, 3}})));
    const glm::dquat rotation = buffer.lookupTransform("a", "b", {}).rotation;
    EXPECT_DOUBLE_EQ(rotation.w, 0.5) << norm;
    EXPECT_DOUBLE_EQ(rotation.x, -0.5) << norm;
    EXPECT_DOUBLE_EQ(rotation.y, 0.5) << norm;
    EXPECT_DOUBLE_EQ(rotation.z, -0.5) << norm;
  }
}

TEST(TransformBuffer, TakesLateRepeatedAndExtremeStamps) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "base", kMax, translate(3, 0, 0))));
  ASSERT_TRUE(buffer.insert(sample("map", "base", kMin, translate(1, 0, 0))));
  ASSERT_TRUE(buffer.insert(sample("map", "base", 0, translate(9, 0, 0))));
  ASSERT_TRUE(buffer.insert(sample("map", "base", 0, translate(2, 0, 0))));
  EXPECT_EQ(buffer.edge(*buffer.findFrame("base"))->samples, 3u);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{kMin}).translation.x, 1);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{-1}).translation.x, 1);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{0}).translation.x, 2);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{kMax - 1}).translation.x, 2);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{kMax}).translation.x, 3);
}

TEST(TransformBuffer, RetentionDropsBehindTheNewestOfEachEdge) {
  TransformBuffer buffer(100);
  for (std::int64_t stamp = 0; stamp <= 1000; stamp += 10) {
    ASSERT_TRUE(buffer.insert(sample("map", "fast", stamp)));
  }
  ASSERT_TRUE(buffer.insert(sample("map", "slow", 5)));
  ASSERT_TRUE(buffer.insert(sample("map", "fast", 899)));  // too late to matter
  const auto fast = *buffer.edge(*buffer.findFrame("fast"));
  EXPECT_EQ(fast.first, TimePoint{900});
  EXPECT_EQ(fast.last, TimePoint{1000});
  EXPECT_EQ(fast.samples, 11u);
  EXPECT_EQ(buffer.edge(*buffer.findFrame("slow"))->samples, 1u);
}

TEST(TransformBuffer, RetentionDoesNotOverflowAtTheEndsOfTime) {
  for (const std::int64_t retention : {std::int64_t{0}, std::int64_t{1}, kMax}) {
    TransformBuffer buffer(retention);
    ASSERT_TRUE(buffer.insert(sample("map", "base", kMin, translate(1, 0, 0))));
    ASSERT_TRUE(buffer.insert(sample("map", "base", kMin + 1, translate(2, 0, 0))));
    EXPECT_EQ(buffer.edge(*buffer.findFrame("base"))->samples, retention == 0 ? 1u : 2u);
    ASSERT_TRUE(buffer.insert(sample("map", "base", kMax, translate(3, 0, 0))));
    EXPECT_EQ(buffer.edge(*buffer.findFrame("base"))->samples, 1u);
    EXPECT_DOUBLE_EQ(buffer.lookupTransform("map", "base", TimePoint{kMax}).translation.x, 3);
  }
  TransformBuffer negative(-5);
  ASSERT_TRUE(negative.insert(sample("map", "base", 0)));
  EXPECT_TRUE(negative.tryLookupTransform("map", "base", {}));
}

TEST(TransformBuffer, StaticEdgesHoldForAllTimeOnlyWhenAsked) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("base", "lidar", 100, translate(1, 0, 0), true)));
  ASSERT_TRUE(buffer.insert(sample("base", "lidar", 200, translate(2, 0, 0), true)));
  ASSERT_TRUE(buffer.insert(sample("base", "arm", 100, translate(3, 0, 0))));
  const FrameId lidar = *buffer.findFrame("lidar");
  EXPECT_FALSE(buffer.isStaticForAllTime());
  EXPECT_FALSE(buffer.tryLookupTransform("base", "lidar", TimePoint{99}));
  const auto revision = buffer.revision();
  buffer.setStaticForAllTime(true);
  EXPECT_NE(buffer.revision(), revision);
  EXPECT_TRUE(buffer.isStaticForAllTime());
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("base", "lidar", TimePoint{kMin}).translation.x, 1);
  EXPECT_DOUBLE_EQ(buffer.lookupTransform("base", "lidar", TimePoint{200}).translation.x, 2);
  EXPECT_EQ(buffer.stampInForce(lidar, TimePoint{0}), TimePoint{100});
  EXPECT_FALSE(buffer.tryLookupTransform("base", "arm", TimePoint{99}));
  ASSERT_TRUE(buffer.insert(sample("base", "lidar", 300)));  // it moves after all
  EXPECT_FALSE(buffer.edge(lidar)->is_static);
  EXPECT_FALSE(buffer.tryLookupTransform("base", "lidar", TimePoint{99}));
}

TEST(TransformBuffer, DescribesTheTree) {
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("/odom", "base link", 7, {}, true)));
  ASSERT_TRUE(buffer.insert(sample("//map", "odom", 1)));
  ASSERT_TRUE(buffer.insert(sample("m\xC3\xBCll", "\xE5\xA4\xA9", 2)));
  EXPECT_THAT(buffer.frames(), ElementsAre("odom", "base link", "map", "m\xC3\xBCll", "\xE5\xA4\xA9"));
  EXPECT_EQ(buffer.frameCount(), 5u);
  EXPECT_THAT(buffer.roots(), ElementsAre(2, 3));
  EXPECT_EQ(buffer.parent(*buffer.findFrame("/base link")), buffer.findFrame("odom"));
  EXPECT_EQ(buffer.parent(*buffer.findFrame("map")), kNoFrame);
  EXPECT_EQ(buffer.parent(99), kNoFrame);
  EXPECT_EQ(buffer.frameName(99), "?");
  EXPECT_EQ(buffer.findFrame("nowhere"), std::nullopt);
  EXPECT_FALSE(buffer.edge(*buffer.findFrame("map")));  // only ever a parent
  EXPECT_FALSE(buffer.edge(kNoFrame));
  const auto edge = *buffer.edge(*buffer.findFrame("base link"));
  EXPECT_EQ(edge.parent, "odom");
  EXPECT_EQ(edge.child, "base link");
  EXPECT_EQ(edge.last, TimePoint{7});
  EXPECT_TRUE(edge.is_static);
  EXPECT_TRUE(buffer.tryLookupTransform("map", "base link", TimePoint{7}));
}

TEST(TransformBuffer, ClearForgetsEverythingButTheSwitch) {
  TransformBuffer buffer;
  buffer.setStaticForAllTime(true);
  ASSERT_TRUE(buffer.insert(sample("map", "base", 0)));
  const auto revision = buffer.revision();
  buffer.clear();
  EXPECT_NE(buffer.revision(), revision);
  EXPECT_EQ(buffer.frameCount(), 0u);
  EXPECT_EQ(buffer.sampleBytes(), 0u);
  EXPECT_TRUE(buffer.isStaticForAllTime());
  ASSERT_TRUE(buffer.insert(sample("base", "map", 0)));  // the other way round now
  EXPECT_EQ(buffer.findFrame("base"), FrameId{0});
}

TEST(TransformBuffer, BulkInsertGoesOnPastRefusalsAndCountsThem) {
  TransformBuffer buffer;
  std::vector<TransformSample> samples;
  for (std::int64_t i = 0; i < 1000; ++i) {
    samples.push_back(sample("map", "base", i));
    samples.push_back(sample("other", "base", 500 + i));
    samples.push_back(sample("base", "map", i));
    samples.push_back(sample("x", "x", i));
  }
  const auto report = buffer.insertBulk(samples);
  EXPECT_EQ(report.inserted, 1000u);
  EXPECT_EQ(report.refused, 3000u);
  ASSERT_EQ(report.refusals.size(), 3u);
  EXPECT_EQ(report.refusals[0].count, 1000u);
  EXPECT_EQ(buffer.frameCount(), 2u);
  EXPECT_TRUE(buffer.tryLookupTransform("map", "base", TimePoint{999}));
  for (const auto& refusal : report.refusals) {
    if (refusal.error == InsertError::ReparentConflict) {
      EXPECT_EQ(refusal.parent, "other");
      EXPECT_EQ(refusal.child, "base");
      EXPECT_EQ(refusal.first_stamp, TimePoint{500});
    }
  }
}

TEST(TransformBuffer, BulkInsertListsABoundedNumberOfRefusals) {
  TransformBuffer buffer;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 1000; ++i) {
    names.push_back(numbered("f", i));
  }
  std::vector<TransformSample> samples;
  for (const std::string& name : names) {
    samples.push_back(sample(name, name, 0));
  }
  const auto report = buffer.insertBulk(samples);
  EXPECT_EQ(report.refused, 1000u);
  EXPECT_EQ(report.refusals.size(), BulkInsertReport::kMaxRefusals);
  EXPECT_EQ(report.refusals.front().parent, "f0");
  EXPECT_TRUE(buffer.insertBulk({}).refusals.empty());
}

TEST(TransformBuffer, FastAndSlowEdgesLiveSideBySide) {
  TransformBuffer buffer;
  for (std::int64_t ms = 0; ms < 200'000; ++ms) {
    ASSERT_TRUE(buffer.insert(sample("base", "imu", ms * 1'000'000, translate(static_cast<double>(ms), 0, 0))));
  }
  for (std::int64_t s = 0; s < 200; s += 100) {
    ASSERT_TRUE(buffer.insert(sample("map", "base", s * 1'000'000'000, translate(0, static_cast<double>(s), 0))));
  }
  const auto found = buffer.lookupTransform("map", "imu", TimePoint{123'456'789'012});
  expectNear(found.translation, {123'456, 100, 0}, 0.0);
}

TEST(TransformBuffer, AMillionFramesInAnyOrderTakeLinearTime) {
  constexpr int kFrames = 1'000'000;
  std::vector<std::string> names;
  names.reserve(kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) {
    names.push_back(numbered("frame_", i));
  }
  std::vector<TransformSample> samples;
  for (std::size_t i = 1; i < kFrames; ++i) {
    samples.push_back(sample(names[i - 1], names[i], 0, translate(1, 0, 0)));
  }
  for (const bool leaf_first : {false, true}) {
    TransformBuffer buffer;
    if (leaf_first) {
      std::reverse(samples.begin(), samples.end());
    }
    EXPECT_EQ(buffer.insertBulk(samples).inserted, samples.size());
    const auto found = buffer.lookupTransform(names.front(), names.back(), {});
    EXPECT_DOUBLE_EQ(found.translation.x, kFrames - 1);
    Snapshot snapshot;
    buffer.snapshot(*buffer.findFrame(names[kFrames / 2]), {}, snapshot);
    EXPECT_DOUBLE_EQ(snapshot.root_from_frame[*buffer.findFrame(names.front())]->translation.x, -kFrames / 2);
    EXPECT_EQ(buffer.insert(sample(names.back(), names.front(), 0)).error(), InsertError::Cycle);
  }
}

TEST(TransformBuffer, HandsOutEverySampleOfAnEdgeInOrder) {
  TransformBuffer buffer;
  for (const std::int64_t stamp : {5, 1, 3, 200, 100}) {
    ASSERT_TRUE(buffer.insert(sample("map", "base", stamp, yaw(0.0, static_cast<double>(stamp), 0, 0))));
  }
  const auto samples = buffer.samples(*buffer.findFrame("base"));
  ASSERT_EQ(samples.size(), 5U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].parent_from_child.translation.x, static_cast<double>(samples[i].stamp.ns));
    EXPECT_TRUE(i == 0 || samples[i - 1].stamp < samples[i].stamp);
  }
  EXPECT_TRUE(buffer.samples(*buffer.findFrame("map")).empty());
  EXPECT_TRUE(buffer.samples(99).empty());
}

TEST(RigidTransform, RollPitchAndYawTurnAboutTheFixedAxesInTurn) {
  const auto about = [](const glm::dvec3& axis, double angle) { return glm::angleAxis(angle, axis); };
  for (const double roll : {-3.0, -0.4, 0.0, 2.0}) {
    for (const double pitch : {-1.5, 0.0, 0.7}) {
      for (const double heading : {-2.5, 0.0, 1.2}) {
        expectNear(rollPitchYaw(about({0, 0, 1}, heading) * about({0, 1, 0}, pitch) * about({1, 0, 0}, roll)),
                   {roll, pitch, heading}, 1e-9);
      }
    }
  }
}

TEST(RigidTransform, AtNinetyDegreesOfPitchAllOfTheTurnIsYaw) {
  for (const double pitch : {-std::numbers::pi / 2, std::numbers::pi / 2}) {
    const glm::dquat rotation = glm::angleAxis(0.6, glm::dvec3(0, 0, 1)) * glm::angleAxis(pitch, glm::dvec3(0, 1, 0));
    expectNear(rollPitchYaw(rotation), {0.0, pitch, 0.6}, 1e-7);
  }
}

}  // namespace
}  // namespace stillframe::tf
