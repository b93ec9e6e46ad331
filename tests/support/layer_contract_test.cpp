#include "tests/support/layer_contract.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <osg/NodeVisitor>
#include <osg/observer_ptr>
#include <sstream>

#include "scenegraph/scene.h"
#include "tests/support/graph_dump.h"
#include "tests/support/setting_texts.h"

namespace stillframe::test {
namespace {

using scenegraph::Executor;
using scenegraph::Layer;
using scenegraph::LayerType;
using scenegraph::Scene;
using scenegraph::SettingSpec;
using scenegraph::SettingTexts;
using scenegraph::StatusLevel;

constexpr const char* kTopic = "/data";

const LayerType* findType(std::string_view name) {
  const auto types = typesUnderTest();
  const auto found = std::ranges::find(types, name, &LayerType::name);
  return found == types.end() ? nullptr : &*found;
}

/// Counts what is submitted.
class CountingExecutor : public Executor {
 public:
  void submit(std::function<void()> job) override {
    ++submitted;
    job();
  }
  void submitSpare(std::function<void()> /*job*/) override {}
  void drain() override {}
  std::size_t submitted = 0;
};

class CollectNodes : public osg::NodeVisitor {
 public:
  CollectNodes() : NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }
  void apply(osg::Node& node) override {
    nodes.emplace_back(&node);
    traverse(node);
  }
  std::vector<osg::observer_ptr<osg::Node>> nodes;
};

class LayerContract : public testing::TestWithParam<LayerCase> {
 protected:
  /// map -> base -> sensor and map -> camera from 12 s on, moving; "island" is another tree. Data from 10 s: in sensor,
  /// then camera, an empty message, one that cannot be decoded, and data again.
  LayerContract() {
    type = findType(GetParam().type);
    builder.topic("/tf", scenegraph::ObjectType::FrameTransforms);
    for (std::int64_t s = 12; s <= 30; s += 2) {
      const auto x = static_cast<double>(s);
      builder.transform(s * 1_s, "map", "base", turn(0.1 * x, x, -x, 0.5));
      builder.transform(s * 1_s, "base", "sensor", turn(-0.2 * x, 0.1, 0.2, 1.0));
      builder.transform(s * 1_s, "map", "camera", turn(0.3, 4e6, -2e6, x));
      builder.transform(s * 1_s, "continent", "island", translate(1, 2, 3));
    }
    if (GetParam().add != nullptr) {
      builder.topic(kTopic, type->consumes);
      for (std::int64_t s = 10; s <= 18; ++s) {
        GetParam().add(builder, s * 1_s + 500_ms, s % 3 == 0 ? "camera" : "sensor", static_cast<unsigned>(s));
      }
      GetParam().addEmpty(builder, 20_s, "sensor");
      builder.failsAt(22_s, "BadChunk");
      GetParam().add(builder, 24_s, "sensor", 24);
    }
    dataset = builder.build();
  }
  [[nodiscard]] bool hasTopic() const { return GetParam().add != nullptr; }
  [[nodiscard]] std::string name() const { return hasTopic() ? kTopic : std::string(type->name); }

  std::unique_ptr<Scene> makeScene(Executor& executor, const std::string& fixed_frame = "map") {
    auto scene = std::make_unique<Scene>(dataset, typesUnderTest(), executor);
    scene->setFixedFrame(fixed_frame);
    EXPECT_TRUE(scene->addLayer(name()).has_value());
    return scene;
  }
  static Layer& layerOf(Scene& scene) { return *scene.layers().front()->layer; }
  /// All that can be observed of a scene of one layer, once its work is done.
  static std::string observe(Scene& scene, Executor& executor, tf::TimePoint time) {
    scene.update(time);
    for (int rounds = 0; scene.isPending() && rounds < 20; ++rounds) {
      executor.drain();
      scene.update(time);
    }
    Layer& layer = layerOf(scene);
    EXPECT_FALSE(layer.isPending());
    std::ostringstream text;
    text << "status " << layer.status().code << ": " << layer.status().message << "\nframe " << layer.sourceFrame()
         << "\n";
    for (const auto& [count, value] : layer.counts()) {
      text << count << " " << value << "\n";
    }
    for (const auto& [key, value] : layer.settings()) {
      text << key << "=" << value << "\n";
    }
    const osg::BoundingBoxd box = layer.boundsInFixed();
    for (unsigned i = 0; box.valid() && i < 8; ++i) {
      text << scenegraph::settingText(box.corner(i).x()) << " " << scenegraph::settingText(box.corner(i).y()) << " "
           << scenegraph::settingText(box.corner(i).z()) << "\n";
    }
    return text.str() + dumpGraph(scene.root());
  }
  static bool drawsSomething(Scene& scene) { return dumpGraph(scene.root()).contains("primitives"); }

  const LayerType* type = nullptr;
  DatasetBuilder builder;
  std::shared_ptr<scenegraph::Dataset> dataset;
  std::unique_ptr<Executor> at_once = scenegraph::makeSynchronousExecutor();
};

TEST(LayerContractCases, EveryTypeHasOne) {
  const auto cases = layerCases();
  for (const LayerType& type : typesUnderTest()) {
    const auto found = std::ranges::find(cases, type.name, &LayerCase::type);
    ASSERT_NE(found, cases.end()) << "no contract case for layer type " << type.name;
    EXPECT_EQ(found->add != nullptr, type.consumes != scenegraph::ObjectType::None) << type.name;
    EXPECT_EQ(found->addEmpty != nullptr, found->add != nullptr) << type.name;
    EXPECT_FALSE(type.label.empty()) << type.name;
  }
  EXPECT_EQ(cases.size(), typesUnderTest().size());
}

TEST_P(LayerContract, DrawsBeneathItsFrame) {
  const auto scene = makeScene(*at_once);
  scene->update({15_s});
  EXPECT_TRUE(drawsSomething(*scene));
  EXPECT_LE(layerOf(*scene).status().level, StatusLevel::Info) << layerOf(*scene).status().message;
  if (hasTopic()) {
    EXPECT_EQ(layerOf(*scene).sourceFrame(), "sensor");
    const osg::MatrixTransform* const sensor = scene->frames().node("sensor");
    ASSERT_NE(sensor, nullptr);
    EXPECT_GT(sensor->getNumChildren(), 0U);
    scene->update({15_s + 600_ms});
    EXPECT_EQ(layerOf(*scene).sourceFrame(), "camera");
    EXPECT_EQ(scene->frames().node("sensor"), nullptr);
    EXPECT_NE(scene->frames().node("camera"), nullptr);
    EXPECT_TRUE(layerOf(*scene).boundsInFixed().valid());
  }
}

TEST_P(LayerContract, DrawsNothingForAnEmptyMessageOrBeforeTheFirst) {
  if (!hasTopic()) {
    return;  // a built-in has no messages
  }
  const auto scene = makeScene(*at_once);
  scene->update({15_s});
  scene->update({20_s});
  EXPECT_FALSE(drawsSomething(*scene));
  EXPECT_NE(layerOf(*scene).status().level, StatusLevel::Error) << layerOf(*scene).status().message;
  EXPECT_FALSE(layerOf(*scene).boundsInFixed().valid());
  scene->update({10_s});
  EXPECT_FALSE(drawsSomething(*scene));
  EXPECT_EQ(layerOf(*scene).status().code, "NoMessage");
}

TEST_P(LayerContract, DrawsNothingForAMessageThatCannotBeDecodedAndSaysWhy) {
  if (!hasTopic()) {
    return;
  }
  const auto scene = makeScene(*at_once);
  scene->update({21_s});
  scene->update({23_s});
  EXPECT_FALSE(drawsSomething(*scene));
  EXPECT_EQ(layerOf(*scene).status().level, StatusLevel::Error);
  EXPECT_EQ(layerOf(*scene).status().code, "BadChunk");
  scene->update({24_s});
  EXPECT_TRUE(drawsSomething(*scene));
  EXPECT_LE(layerOf(*scene).status().level, StatusLevel::Info) << layerOf(*scene).status().message;
}

TEST_P(LayerContract, HidesWhenItsFrameHasNoPlaceAndSaysWhy) {
  if (!hasTopic()) {
    return;  // built-ins draw what has a place
  }
  const auto scene = makeScene(*at_once);
  scene->update({15_s});
  const auto expectHidden = [&](const std::string& code, const std::string& named) {
    EXPECT_FALSE(drawsSomething(*scene)) << code;
    EXPECT_FALSE(layerOf(*scene).boundsInFixed().valid());
    EXPECT_EQ(layerOf(*scene).status().level, StatusLevel::Warn);
    EXPECT_EQ(layerOf(*scene).status().code, code);
    EXPECT_TRUE(layerOf(*scene).status().message.contains(named)) << layerOf(*scene).status().message;
  };
  scene->update({11_s});
  expectHidden("NoSampleAtTime", "sensor");
  scene->setFixedFrame("island");
  scene->update({15_s});
  expectHidden("Disconnected", "island");
  scene->setFixedFrame("maap");
  scene->update({15_s});
  expectHidden("UnknownTarget", "'map'");
  scene->setFixedFrame("map");
  scene->update({15_s});
  EXPECT_TRUE(drawsSomething(*scene));
}

TEST_P(LayerContract, TakesEverySettingItAnnouncesAndRefusesOthers) {
  const auto scene = makeScene(*at_once);
  scene->update({15_s});
  Layer& layer = layerOf(*scene);
  const SettingTexts defaults = layer.settings();
  EXPECT_EQ(layer.settingSpecs().size(), defaults.size());
  for (const SettingSpec& spec : layer.settingSpecs()) {
    ASSERT_TRUE(defaults.contains(spec.key)) << spec.key;
    EXPECT_FALSE(spec.label.empty() || spec.help.empty()) << spec.key;
    std::vector<std::string> texts = goodTexts(spec);
    texts.push_back(defaults.at(spec.key));
    const SettingTexts other_end = outOfTheWay(spec, layer.settingSpecs());
    EXPECT_TRUE(layer.applySettings(other_end));
    for (const std::string& text : texts) {
      const auto applied = layer.applySettings({{spec.key, text}});
      ASSERT_TRUE(applied.has_value()) << spec.key << "=" << text << ": " << applied.error().message;
      scene->update({15_s});
      const std::string stored = layer.settings().at(spec.key);
      EXPECT_TRUE(layer.applySettings({{spec.key, stored}}).has_value()) << spec.key << "=" << stored;
      EXPECT_EQ(layer.settings().at(spec.key), stored) << "not a fixed point: " << spec.key << "=" << text;
      if (spec.kind != scenegraph::SettingKind::Double) {
        EXPECT_EQ(stored, text) << spec.key;
      }
    }
    for (const std::string& text : badTexts(spec)) {
      const auto applied = layer.applySettings({{spec.key, text}});
      EXPECT_FALSE(applied.has_value()) << spec.key << "=" << text;
      EXPECT_TRUE(applied.has_value() || applied.error().message.contains(spec.key));
    }
    for (const auto& [key, text] : other_end) {
      EXPECT_TRUE(layer.applySettings({{key, defaults.at(key)}}));
    }
    EXPECT_EQ(layer.settings(), defaults) << spec.key;
  }
  const auto unknown = layer.applySettings({{"no_such_setting", "1"}});
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().code, "UnknownSetting");
}

TEST_P(LayerContract, ChangesNothingWhenOneOfSeveralSettingsIsRefused) {
  const auto scene = makeScene(*at_once);
  Layer& layer = layerOf(*scene);
  const SettingTexts before = layer.settings();
  for (const SettingSpec& spec : layer.settingSpecs()) {
    for (const std::string& text : goodTexts(spec)) {
      EXPECT_FALSE(layer.applySettings({{spec.key, text}, {"zzz_unknown", "1"}}).has_value());
      EXPECT_EQ(layer.settings(), before);
    }
  }
}

TEST_P(LayerContract, AnyPathToATimeGivesTheSameState) {
  const auto pool = scenegraph::makeThreadPoolExecutor(2);
  const auto walker = makeScene(*at_once);
  const auto pool_walker = makeScene(*pool);
  const std::string frames[] = {"map", "base", "island", "nowhere", "sensor"};
  Random random(17);
  std::vector<std::pair<SettingSpec, std::vector<std::string>>> choices;
  for (const SettingSpec& spec : layerOf(*walker).settingSpecs()) {
    choices.emplace_back(spec, goodTexts(spec));
  }
  for (int goal = 0; goal < 12; ++goal) {
    const tf::TimePoint t{9_s + static_cast<std::int64_t>(random.index(17'000)) * 1_ms};
    const std::string& fixed_frame = frames[random.index(std::size(frames))];
    const SettingTexts before = layerOf(*walker).settings();
    SettingTexts wanted;
    if (!choices.empty()) {
      const auto& [spec, texts] = choices[random.index(choices.size())];
      if (!texts.empty()) {
        wanted[spec.key] = texts[random.index(texts.size())];
      }
      wanted.merge(outOfTheWay(spec, layerOf(*walker).settingSpecs()));
    }
    for (Scene* const scene : {walker.get(), pool_walker.get()}) {
      for (std::size_t step = random.index(6); step > 0; --step) {
        scene->setFixedFrame(frames[random.index(std::size(frames))]);
        layerOf(*scene).setVisible(random.index(4) != 0);
        scene->update({8_s + static_cast<std::int64_t>(random.index(20'000)) * 1_ms});
      }
      layerOf(*scene).setVisible(true);
      scene->setFixedFrame(fixed_frame);
      EXPECT_TRUE(layerOf(*scene).applySettings(wanted).has_value());
    }
    const auto straight = makeScene(*at_once, fixed_frame);
    EXPECT_TRUE(layerOf(*straight).applySettings(before).has_value());
    EXPECT_TRUE(layerOf(*straight).applySettings(wanted).has_value());
    const std::string expected = observe(*straight, *at_once, t);
    ASSERT_EQ(observe(*walker, *at_once, t), expected) << "at " << t.ns << " in " << fixed_frame;
    ASSERT_EQ(observe(*pool_walker, *pool, t), expected) << "on a pool, at " << t.ns << " in " << fixed_frame;
  }
}

TEST_P(LayerContract, IsWrittenInStockClassesAndReadsBackTheSame) {
  const auto scene = makeScene(*at_once);
  for (const tf::TimePoint t : {tf::TimePoint{15_s}, tf::TimePoint{15_s + 600_ms}}) {
    scene->update(t);
    EXPECT_EQ(foreignClasses(scene->root()), "");
    const auto from_bytes = writtenAndRead(scene->root(), GraphFile::Binary);
    ASSERT_NE(from_bytes, nullptr);
    EXPECT_EQ(dumpGraph(*from_bytes), dumpGraph(scene->root()));
    const auto from_text = writtenAndRead(scene->root(), GraphFile::Text);
    ASSERT_NE(from_text, nullptr);
    EXPECT_EQ(firstRealDifference(dumpGraph(*from_text), dumpGraph(scene->root())), "");
  }
}

TEST_P(LayerContract, LeavesTheGraphAsItFoundItAndFreesItsNodes) {
  Scene scene(dataset, typesUnderTest(), *at_once);
  scene.setFixedFrame("map");
  scene.update({15_s});
  const std::string before = dumpGraph(scene.root());
  ASSERT_TRUE(scene.addLayer(name()).has_value());
  scene.update({15_s});
  CollectNodes collected;
  for (unsigned i = 0; i < scene.root().getNumChildren(); ++i) {
    scene.root().getChild(i)->accept(collected);
  }
  EXPECT_FALSE(collected.nodes.empty());
  scene.removeLayer(name());
  scene.update({15_s});
  EXPECT_EQ(dumpGraph(scene.root()), before);
  EXPECT_EQ(scene.root().getNumChildren(), 0U);
  for (const auto& node : collected.nodes) {
    EXPECT_FALSE(node.valid()) << node->className() << " '" << node->getName() << "' outlives its layer";
  }
}

TEST_P(LayerContract, MayBeAttachedAgain) {
  const auto scene = makeScene(*at_once);
  const std::string before = observe(*scene, *at_once, {15_s});
  Layer& layer = layerOf(*scene);
  const scenegraph::LayerContext context{*dataset, scene->frames(), *at_once, [] {}};
  layer.detach();
  EXPECT_EQ(scene->root().getNumChildren(), 0U);
  layer.attach(context);
  scene->update({14_s});  // behind its back: at the same time it would leave its layers alone
  EXPECT_EQ(observe(*scene, *at_once, {15_s}), before);
}

TEST_P(LayerContract, HiddenDrawsNothingDoesNoWorkAndKeepsItsSettings) {
  CountingExecutor counting;
  const auto scene = makeScene(counting);
  Layer& layer = layerOf(*scene);
  const SettingTexts settings = layer.settings();
  EXPECT_TRUE(layer.isVisible());
  layer.setVisible(false);
  scene->update({15_s});
  scene->update({16_s});
  EXPECT_FALSE(layer.isVisible());
  EXPECT_FALSE(drawsSomething(*scene));
  EXPECT_EQ(counting.submitted, 0U);
  EXPECT_FALSE(layer.isPending());
  EXPECT_EQ(layer.settings(), settings);
  layer.setVisible(true);
  EXPECT_EQ(observe(*scene, counting, {15_s}), observe(*makeScene(*at_once), *at_once, {15_s}));
}

TEST_P(LayerContract, HiddenAgainHoldsNoNodeAndDecodesNothingWhereverTheTickGoes) {
  CountingExecutor counting;
  const auto scene = makeScene(counting);
  Layer& layer = layerOf(*scene);
  scene->update({15_s});
  EXPECT_TRUE(drawsSomething(*scene));
  layer.setVisible(false);
  const std::size_t submitted = counting.submitted;
  const std::size_t decoded = builder.source().decodeCount();
  for (std::int64_t s = 10; s <= 30; ++s) {
    scene->update({s * 1_s});
    EXPECT_FALSE(scene->isPending());
    std::vector<osg::Node*> nodes;
    layer.collectNodes(nodes);
    EXPECT_TRUE(nodes.empty());
  }
  EXPECT_EQ(counting.submitted, submitted);
  EXPECT_EQ(builder.source().decodeCount(), decoded);
  EXPECT_EQ(scene->root().getNumChildren(), 0U);
  EXPECT_FALSE(scene->boundsInFixed().valid());
}

INSTANTIATE_TEST_SUITE_P(Types, LayerContract, testing::ValuesIn(layerCases()),
                         [](const auto& tested) { return std::string(tested.param.type); });

}  // namespace
}  // namespace stillframe::test
