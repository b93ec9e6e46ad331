// The order in which layers are drawn decides which of two things with the very same depth is seen: it must not depend
// on which of them was hidden, or in another frame, before. Compiled together with a source that defines layerCases()
// and typesUnderTest(), as the contract test is.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "scenegraph/scene.h"
#include "tests/support/graph_dump.h"
#include "tests/support/layer_contract.h"

namespace stillframe::test {
namespace {

using scenegraph::LayerType;
using scenegraph::Scene;

/// Two layers of one topic, which lie on each other, and the built-ins; the topic's data changes its frame.
class LayerOrder : public testing::TestWithParam<LayerCase> {
 protected:
  LayerOrder() {
    builder_.topic("/tf", scenegraph::ObjectType::FrameTransforms);
    builder_.transform(0, "map", "base", turn(0.3, 1, 2, 3));
    builder_.transform(0, "base", "sensor", translate(0, 0, 1));
    const LayerType& type = *std::ranges::find(typesUnderTest(), GetParam().type, &LayerType::name);
    if (GetParam().add != nullptr) {
      builder_.topic("/data", type.consumes);
      for (unsigned s = 1; s < 5; ++s) {
        GetParam().add(builder_, s * 1_s, s % 2 == 0 ? "base" : "sensor", s);
      }
      ids_ = {"/data", "/data#2"};
    }
    for (const LayerType& built_in : typesUnderTest()) {
      if (built_in.consumes == scenegraph::ObjectType::None) {
        ids_.emplace_back(built_in.name);
        ids_.push_back(std::string(built_in.name) + "#2");
      }
    }
    dataset_ = builder_.build();
  }

  /// Adds what is missing, and shows those whose bit is set.
  void arrange(Scene& scene, std::size_t shown) const {
    for (const std::string& id : ids_) {
      EXPECT_TRUE(scene.addLayer(id).has_value()) << id;
    }
    scene.arrangeLayers(ids_);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      scene.layers()[i]->layer->setVisible((shown >> i & 1U) != 0);
    }
  }
  static std::string dump(Scene& scene, tf::TimePoint time, const std::string& frame) {
    scene.setFixedFrame(frame);
    scene.update(time);
    for (int rounds = 0; scene.isPending() && rounds < 20; ++rounds) {
      scene.update(time);
    }
    return dumpGraph(scene.root());
  }

  DatasetBuilder builder_;
  std::vector<std::string> ids_;
  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::unique_ptr<scenegraph::Executor> at_once_ = scenegraph::makeSynchronousExecutor();
};

TEST_P(LayerOrder, IsThatOfTheListWhateverWasHiddenBefore) {
  const std::string frames[] = {"map", "base", "nowhere"};
  Scene walker(dataset_, typesUnderTest(), *at_once_);
  Random random(23);
  for (int step = 0; step < 40; ++step) {
    std::swap(ids_[random.index(ids_.size())], ids_[random.index(ids_.size())]);
    const std::size_t shown = random.index(std::size_t{1} << ids_.size());
    const std::string& frame = frames[random.index(std::size(frames))];
    const tf::TimePoint t{static_cast<std::int64_t>(random.index(6'000)) * 1_ms};
    Scene straight(dataset_, typesUnderTest(), *at_once_);
    arrange(straight, shown);
    arrange(walker, shown);
    ASSERT_EQ(dump(walker, t, frame), dump(straight, t, frame)) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Types, LayerOrder, testing::ValuesIn(layerCases()),
                         [](const auto& tested) { return std::string(tested.param.type); });

}  // namespace
}  // namespace stillframe::test
