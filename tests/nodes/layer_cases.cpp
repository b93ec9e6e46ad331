#include "nodes/registry.h"
#include "scenegraph/objects/laser_scan.h"
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

/// 0.1 s or more from the log time on.
scenegraph::LaserScan scanAt(std::int64_t log_ns, const std::string& frame, std::size_t beams) {
  scenegraph::LaserScan scan;
  scan.stamp = {log_ns};
  scan.frame_id = frame;
  scan.angle_increment_rad = 0.1;
  scan.time_increment_s = 0.01;
  scan.range_max_m = 10.0;
  scan.ranges_m.resize(beams);
  return scan;
}

void addScan(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) {
  Random random(seed);
  auto scan = scanAt(log_ns, frame, 10 + seed % 3);
  for (double& range : scan.ranges_m) {
    range = random.number(1.0, 12.0);
  }
  scan.ranges_m.front() = 2.0;
  scan.intensities = scan.ranges_m;
  builder.at(log_ns, std::move(scan));
}

void addEmptyScan(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) {
  builder.at(log_ns, scanAt(log_ns, frame, 0));
}

}  // namespace

std::vector<LayerCase> layerCases() {
  return {{.type = "grid"},
          {.type = "tf"},
          {.type = "point_cloud", .add = addCloud, .addEmpty = addEmptyCloud},
          {.type = "laser_scan", .add = addScan, .addEmpty = addEmptyScan}};
}

std::span<const scenegraph::LayerType> typesUnderTest() { return nodes::layerTypes(); }

}  // namespace stillframe::test
