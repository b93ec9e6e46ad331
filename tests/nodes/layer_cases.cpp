#include "nodes/registry.h"
#include "tests/support/layer_contract.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;

void addCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  CloudBuilder cloud(frame);
  cloud.xyz().field("intensity", FieldType::Float32);
  for (unsigned i = 0; i < 5 + seed % 3; ++i) {
    cloud.point({random.number(-5, 5), random.number(-5, 5), random.number(-5, 5), random.number(0, 100)});
  }
  builder.at(log_ns, cloud.build());
}

void addEmptyCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, CloudBuilder(frame).xyz().build());
}

}  // namespace

std::vector<LayerCase> layerCases() {
  return {{.type = "grid"}, {.type = "tf"}, {.type = "point_cloud", .add = addCloud, .addEmpty = addEmptyCloud}};
}

std::span<const scenegraph::LayerType> typesUnderTest() { return nodes::layerTypes(); }

}  // namespace stillframe::test
