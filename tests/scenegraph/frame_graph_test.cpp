#include "scenegraph/frame_graph.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <set>

#include "scenegraph/placement.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::Random;
using test::TfBuilder;
using test::translate;
using test::turn;
using namespace tf::literals;

bool isShown(const FrameGraph& graph, const std::string& frame) {
  return graph.node(frame) != nullptr && graph.node(frame)->getNodeMask() != 0U;
}

TEST(FrameGraph, MasksFrameThatHasNoSampleYet) {
  const auto buffer = TfBuilder().edge("map", "base").at(10_s, translate(1, 0, 0)).build();
  FrameGraph graph{buffer};
  graph.acquire("base");
  graph.setTick("map", {5_s});
  EXPECT_FALSE(isShown(graph, "base"));
  graph.setTick("map", {10_s});
  EXPECT_TRUE(isShown(graph, "base"));
  EXPECT_EQ(graph.node("base")->getMatrix().getTrans(), osg::Vec3d(1, 0, 0));
}

TEST(FrameGraph, HoldsNodesOnlyWhileSomebodyUsesThem) {
  FrameGraph graph{TfBuilder().edge("map", "base").at(0, translate(1, 0, 0)).build()};
  EXPECT_EQ(graph.node("base"), nullptr);
  osg::MatrixTransform& first = graph.acquire("base");
  EXPECT_EQ(&graph.acquire("/base"), &first) << "leading slashes name the same frame";
  EXPECT_EQ(graph.root().getNumChildren(), 1U);
  graph.release("base");
  EXPECT_EQ(graph.node("base"), &first);
  graph.release("/base");
  EXPECT_EQ(graph.node("base"), nullptr);
  EXPECT_EQ(graph.root().getNumChildren(), 0U);
  graph.release("base");
  graph.release("never acquired");
}

TEST(FrameGraph, PosesAFrameAcquiredBetweenTicksAtOnce) {
  FrameGraph graph{TfBuilder().edge("map", "base").at(0, translate(1, 2, 3)).build()};
  graph.acquire("early");
  EXPECT_FALSE(isShown(graph, "early")) << "nothing is shown before the first tick";
  graph.setTick("map", {0});
  graph.acquire("base");
  EXPECT_TRUE(isShown(graph, "base"));
  EXPECT_EQ(graph.node("base")->getMatrix().getTrans(), osg::Vec3d(1, 2, 3));
}

TEST(FrameGraph, ATickThatChangesNothingCostsNothing) {
  const auto buffer = TfBuilder()
                          .edge("map", "base")
                          .at(0_s, translate(1, 0, 0))
                          .at(10_s, translate(2, 0, 0))
                          .edge("map", "still")
                          .at(0_s, translate(0, 5, 0))
                          .build();
  FrameGraph graph{buffer};
  graph.acquire("base");
  graph.acquire("still");
  graph.setTick("map", {1_s});
  EXPECT_EQ(graph.lastTick().matrices_written, 2U);
  graph.setTick("map", {1_s});
  EXPECT_FALSE(graph.lastTick().snapshot_taken);
  EXPECT_EQ(graph.lastTick().matrices_written, 0U);
  graph.setTick("map", {2_s});
  EXPECT_TRUE(graph.lastTick().snapshot_taken);
  EXPECT_EQ(graph.lastTick().matrices_written, 0U) << "the same samples are in force";
  graph.setTick("map", {10_s});
  EXPECT_EQ(graph.lastTick().matrices_written, 1U) << "only what moved";
  ASSERT_TRUE(buffer->insert({"map", "base", {9_s}, translate(7, 0, 0)}));
  graph.setTick("map", {10_s});
  EXPECT_TRUE(graph.lastTick().snapshot_taken) << "the buffer has grown";
}

TEST(FrameGraph, FramesComeAndGoInAnyOrderAndTheRestStayPosed) {
  constexpr std::size_t kFrames = 40;
  const auto nameOf = [](std::size_t i) { return "frame" + std::to_string(i); };
  TfBuilder builder;
  for (std::size_t i = 0; i < kFrames; ++i) {
    builder.edge("map", nameOf(i));
    for (int second = 0; second < 100; ++second) {
      builder.at(second * 1_s, translate(static_cast<double>(i), second, 0));
    }
  }
  FrameGraph graph{builder.build()};
  Random random(8);
  std::set<std::size_t> held;
  for (int second = 0; second < 100; ++second) {
    for (int change = 0; change < 15; ++change) {
      if (const std::size_t i = random.index(kFrames); held.erase(i) == 1) {
        graph.release(nameOf(i));
      } else {
        graph.acquire(nameOf(i));
        held.insert(i);
      }
    }
    graph.setTick("map", {second * 1_s});
    ASSERT_EQ(graph.root().getNumChildren(), held.size());
    for (std::size_t i = 0; i < kFrames; ++i) {
      const osg::MatrixTransform* const node = graph.node(nameOf(i));
      ASSERT_EQ(node != nullptr, held.contains(i));
      if (node != nullptr) {
        EXPECT_EQ(node->getName(), nameOf(i));
        EXPECT_EQ(node->getMatrix().getTrans(), osg::Vec3d(static_cast<double>(i), second, 0));
      }
    }
  }
}

TEST(FrameGraph, UnknownFixedFrameShowsOnlyWhatHangsInIt) {
  FrameGraph graph{TfBuilder().edge("map", "base").at(0, translate(1, 0, 0)).build()};
  graph.acquire("base");
  graph.acquire("nowhere");
  graph.setTick("/nowhere", {0});
  EXPECT_FALSE(isShown(graph, "base"));
  EXPECT_TRUE(isShown(graph, "nowhere"));
  EXPECT_EQ(graph.fixedFromFrame("base").error().code, tf::LookupError::UnknownTarget);
  EXPECT_TRUE(graph.fixedFromFrame("nowhere"));
}

TEST(FrameGraph, AFrameWithoutANameHasNoPlace) {
  FrameGraph graph{std::make_shared<tf::TransformBuffer>()};
  graph.acquire("");
  graph.setTick("", {0});
  EXPECT_FALSE(isShown(graph, ""));
  EXPECT_FALSE(graph.fixedFromFrame("/"));
}

TEST(FrameGraph, ShowsAFrameThatBecomesKnownLater) {
  const auto buffer = TfBuilder().edge("map", "base").at(0, translate(1, 0, 0)).build();
  FrameGraph graph{buffer};
  graph.acquire("later");
  graph.setTick("map", {5});
  EXPECT_EQ(graph.fixedFromFrame("later").error().code, tf::LookupError::UnknownSource);
  ASSERT_TRUE(buffer->insert({"base", "later", {0}, translate(0, 1, 0)}));
  graph.setTick("map", {5});
  EXPECT_TRUE(isShown(graph, "later"));
}

TEST(FrameGraph, OneFailingEdgeHidesExactlyWhatItCutsOff) {
  const auto buffer = TfBuilder()
                          .edge("map", "odom")
                          .at(0, translate(1, 0, 0))
                          .edge("odom", "base")
                          .at(10, translate(1, 0, 0))
                          .edge("base", "lidar")
                          .at(0, translate(1, 0, 0))
                          .build();
  FrameGraph graph{buffer};
  for (const char* frame : {"map", "odom", "base", "lidar"}) {
    graph.acquire(frame);
  }
  graph.setTick("map", {5});
  EXPECT_TRUE(isShown(graph, "map") && isShown(graph, "odom"));
  EXPECT_FALSE(isShown(graph, "base") || isShown(graph, "lidar"));
  graph.setTick("lidar", {5});
  EXPECT_TRUE(isShown(graph, "lidar") && isShown(graph, "base"));
  EXPECT_FALSE(isShown(graph, "map") || isShown(graph, "odom"));
}

TEST(FrameGraph, MatricesAreThoseOfALookupBitForBitAtUtmOffsets) {
  Random random(3);
  TfBuilder builder;
  std::string parent = "map";
  for (int i = 0; i < 20; ++i) {
    const std::string child = "f" + std::to_string(i);
    builder.edge(parent, child).at(0, random.transform(5e6));
    parent = random.index(2) == 0 ? child : parent;
  }
  const auto buffer = builder.build();
  FrameGraph graph{buffer};
  graph.setTick("map", {0});
  for (const std::string& frame : buffer->frames()) {
    const osg::Matrixd& shown = graph.acquire(frame).getMatrix();
    const auto fixed_from_frame = graph.fixedFromFrame(frame);
    ASSERT_TRUE(fixed_from_frame);
    const glm::dmat4 expected = tf::toMatrix(*fixed_from_frame);
    EXPECT_EQ(std::memcmp(shown.ptr(), glm::value_ptr(expected), sizeof(expected)), 0) << frame;
    const auto looked_up = buffer->tryLookupTransform("map", frame, {0});
    ASSERT_TRUE(looked_up);
    EXPECT_LT(glm::length(looked_up->translation - fixed_from_frame->translation), 1e-8) << frame;
  }
}

Status whyNot(const FrameGraph& graph, const std::string& frame) {
  const auto fixed_from_frame = graph.fixedFromFrame(frame);
  EXPECT_FALSE(fixed_from_frame);
  return fixed_from_frame ? Status{} : placementStatus(graph, frame, fixed_from_frame.error());
}

TEST(PlacementStatus, NamesTheRemedyForAStaticTransformThatComesLate) {
  const auto buffer = TfBuilder().edge("base", "lidar", true).at(10_s, translate(1, 0, 0)).build();
  FrameGraph graph{buffer};
  graph.setTick("base", {5_s});
  const Status status = whyNot(graph, "lidar");
  EXPECT_EQ(status.code, "NoSampleAtTime");
  EXPECT_EQ(status.level, StatusLevel::Warn);
  EXPECT_TRUE(status.message.contains("10.000000000 s")) << status.message;
  EXPECT_TRUE(status.message.contains("switch on 'static transforms hold for all time'")) << status.message;
  buffer->setStaticForAllTime(true);
  graph.setTick("base", {5_s});
  EXPECT_TRUE(graph.fixedFromFrame("lidar")) << "the remedy helps";
}

TEST(PlacementStatus, ADynamicEdgeSaysWhenItBegins) {
  FrameGraph graph{TfBuilder().edge("base", "lidar").at(10_s, translate(1, 0, 0)).build()};
  graph.setTick("base", {5_s});
  const std::string message = whyNot(graph, "lidar").message;
  EXPECT_FALSE(message.contains("static")) << message;
  EXPECT_TRUE(message.contains("comes first at 10.000000000 s: go there")) << message;
}

TEST(PlacementStatus, ADisconnectedFrameNamesTheRootOfItsTree) {
  FrameGraph graph{TfBuilder()
                       .edge("map", "base")
                       .at(0, translate(1, 0, 0))
                       .edge("island", "hut")
                       .at(0, translate(1, 0, 0))
                       .edge("hut", "lamp")
                       .at(0, translate(1, 0, 0))
                       .build()};
  graph.setTick("map", {0});
  EXPECT_EQ(whyNot(graph, "lamp").code, "Disconnected");
  EXPECT_TRUE(whyNot(graph, "lamp").message.contains("choose 'island' as fixed frame"))
      << whyNot(graph, "lamp").message;
}

TEST(PlacementStatus, AnUnknownFixedFrameGetsNearNamesOrTheRoots) {
  FrameGraph graph{TfBuilder().edge("map", "base_link").at(0, turn(0.5)).build()};
  graph.setTick("base_lnk", {0});
  EXPECT_EQ(whyNot(graph, "map").code, "UnknownTarget");
  EXPECT_TRUE(whyNot(graph, "map").message.contains("did you mean 'base_link'")) << whyNot(graph, "map").message;
  graph.setTick("xyzzy", {0});
  EXPECT_TRUE(whyNot(graph, "base_link").message.contains("the root is 'map'"));
}

TEST(PlacementStatus, SaysWhenThereAreNoTransformsAtAll) {
  FrameGraph graph{std::make_shared<tf::TransformBuffer>()};
  graph.setTick("", {0});
  EXPECT_TRUE(whyNot(graph, "lidar").message.contains("choose 'lidar' as fixed frame"));
}

TEST(PlacementStatus, NamesTheUnknownOrMissingFrameOfTheData) {
  FrameGraph graph{TfBuilder().edge("map", "base").at(0, translate(1, 0, 0)).build()};
  graph.setTick("map", {0});
  EXPECT_EQ(whyNot(graph, "lidar").code, "UnknownSource");
  EXPECT_TRUE(whyNot(graph, "lidar").message.contains("choose 'lidar' as fixed frame"));
  EXPECT_TRUE(whyNot(graph, "").message.contains("frame_id is empty"));
}

}  // namespace
}  // namespace stillframe::scenegraph
