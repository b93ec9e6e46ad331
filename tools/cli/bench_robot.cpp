#include <array>
#include <memory>
#include <string>
#include <utility>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/scene.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

constexpr int kLinks = 200;

/// One description.
class DescriptionSource final : public scenegraph::EntrySource {
 public:
  explicit DescriptionSource(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const scenegraph::TopicInfo& /*topic*/, const scenegraph::Entry& /*entry*/) const override {
    return scenegraph::AnyObject::make(scenegraph::RobotDescription{.format = "urdf", .text = text_});
  }

 private:
  std::string text_;
};

std::string linkName(int i) { return "link_" + std::to_string(i); }

/// A chain of boxes, each on a joint of its own that moves.
std::shared_ptr<scenegraph::Dataset> makeRobot() {
  auto dataset = std::make_shared<scenegraph::Dataset>("robot of " + std::to_string(kLinks) + " links");
  std::string text = "<robot name='chain'>";
  for (int i = 0; i < kLinks; ++i) {
    text += "<link name='" + linkName(i) + "'><visual><geometry><box size='0.1 0.1 0.1'/></geometry></visual></link>";
    if (i > 0) {
      text += "<joint name='joint_" + std::to_string(i) + "' type='continuous'><parent link='" + linkName(i - 1) +
              "'/><child link='" + linkName(i) + "'/></joint>";
    }
  }
  const scenegraph::TopicId topic =
      dataset->store().addTopic({.name = "/robot_description",
                                 .type = scenegraph::ObjectType::RobotDescription,
                                 .schema = "",
                                 .encoding = "",
                                 .unsupported_reason = ""},
                                std::make_shared<const DescriptionSource>(text + "</robot>"));
  dataset->store().append(topic, std::array{scenegraph::Entry{}});
  for (int i = 0; i < kLinks; ++i) {
    for (std::int64_t stamp = 0; stamp < 100; ++stamp) {
      const tf::RigidTransform pose{.translation = {0.1, 0.001 * static_cast<double>(stamp), 0.0}};
      (void)dataset->transforms()->insert({.parent = i == 0 ? "map" : linkName(i - 1),
                                           .child = linkName(i),
                                           .stamp = {stamp},
                                           .parent_from_child = pose});
    }
  }
  return dataset;
}

/// Seconds of a tick to another time, the best of many.
double tickSeconds(scenegraph::Scene& scene) {
  std::int64_t time = 0;
  return bestSecondsOf(300, [&] { scene.update({time = (time + 37) % 100}); });
}

}  // namespace

void benchRobot(std::vector<BenchResult>& results) {
  const auto dataset = makeRobot();
  const auto executor = scenegraph::makeSynchronousExecutor();
  const auto measure = [&](const scenegraph::SettingTexts& settings, bool is_visible) {
    scenegraph::Scene scene(dataset, nodes::layerTypes(), *executor);
    scene.setFixedFrame("map");
    if (const auto slot = scene.addLayer("/robot_description")) {
      (void)(*slot)->layer->applySettings(settings);
      (*slot)->layer->setVisible(is_visible);
    }
    return 1e3 * tickSeconds(scene);
  };
  results.push_back({"robot of 200 links, hidden, tick", measure({}, false), "ms"});
  results.push_back({"robot of 200 links, placed by transforms, tick", measure({}, true), "ms", 1.0});
  results.push_back({"robot of 200 links, placed by kinematics, tick", measure({{"joints", "zero"}}, true), "ms", 1.0});
}

}  // namespace stillframe::cli
