#include "tests/scenegraph/fake_layer.h"
#include "tests/support/layer_contract.h"

namespace stillframe::test {
namespace {

void addCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  CloudBuilder cloud(frame);
  cloud.xyz();
  for (unsigned i = 0; i < 5 + seed % 3; ++i) {
    cloud.point({random.number(-5, 5), random.number(-5, 5), random.number(-5, 5)});
  }
  builder.at(log_ns, cloud.build());
}

void addEmptyCloud(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, CloudBuilder(frame).xyz().build());
}

}  // namespace

std::vector<LayerCase> layerCases() { return {{.type = "fake", .add = addCloud, .addEmpty = addEmptyCloud}}; }

std::span<const scenegraph::LayerType> typesUnderTest() { return fakeTypes(); }

}  // namespace stillframe::test
