#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>

#include "nodes/grid_map/grid_surface.h"
#include "nodes/images/camera_model.h"
#include "nodes/images/depth_map.h"
#include "nodes/laser_scan/scan_cloud.h"
#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/scene.h"
#include "tools/bench/grid_workload.h"
#include "tools/cli/bench_conversions.h"
#include "tools/cli/bench_results.h"
#include "tools/sample/image_writers.h"

namespace stillframe::cli {
namespace {

using scenegraph::AnyObject;
using scenegraph::ObjectType;

template <typename T>
scenegraph::Payload payloadOf(const std::vector<T>& values) {
  const auto view = std::as_bytes(std::span(values));
  const auto bytes = std::make_shared<const std::vector<std::byte>>(view.begin(), view.end());
  return {*bytes, bytes};
}

void addScan(Conversions& conversions) {
  constexpr std::size_t kBeams = 100'000;
  scenegraph::LaserScan scan;
  scan.angle_min_rad = -std::numbers::pi;
  scan.angle_increment_rad = 2.0 * std::numbers::pi / kBeams;
  scan.time_increment_s = 1e-6;
  scan.range_min_m = 0.1;
  scan.range_max_m = 30.0;
  for (std::size_t i = 0; i < kBeams; ++i) {
    scan.ranges_m.push_back(5.0 + std::sin(static_cast<double>(i) * 1e-3));
    scan.intensities.push_back(100.0);
  }
  conversions.add("laser scan of 100 000 beams", kBeams * 2 * sizeof(float), 9,
                  [&] { return nodes::convertScan(scan).has_value(); });
}

constexpr std::uint32_t kDepthWidth = 1280;
constexpr std::uint32_t kDepthHeight = 720;

void addDepth(Conversions& conversions, std::vector<BenchResult>& results) {
  constexpr std::size_t kPixels = std::size_t{kDepthWidth} * kDepthHeight;
  std::vector<std::uint16_t> millimetres;
  std::vector<float> metres;
  std::mt19937 random(5);
  for (std::size_t i = 0; i < kPixels; ++i) {
    const bool is_hole = i % 97 < 3;
    millimetres.push_back(is_hole ? 0 : static_cast<std::uint16_t>(1500 + i % kDepthWidth + random() % 8));
    metres.push_back(0.001F * static_cast<float>(millimetres.back()));
  }
  scenegraph::Image image;
  image.width = kDepthWidth;
  image.height = kDepthHeight;
  const auto add = [&](const char* encoding, scenegraph::Payload data, std::size_t bytes, int rounds) {
    image.encoding = encoding;
    image.data = std::move(data);
    conversions.add(std::string("depth image 1280 x 720 ") + encoding, bytes, rounds, [&] {
      const auto map = nodes::decodeDepth(image);
      return map && map->valid > 0;
    });
  };
  add("16UC1", payloadOf(millimetres), 2 * kPixels, 9);
  add("32FC1", payloadOf(metres), 4 * kPixels, 9);
  std::vector<std::byte> compressed(12);
  const auto png = sample::writeGrayPng(kDepthWidth, millimetres);
  compressed.insert(compressed.end(), png.begin(), png.end());
  image.compressed_encoding = "16UC1";
  add("compressedDepth", payloadOf(compressed), 2 * kPixels, 3);

  scenegraph::CameraInfo info;
  info.width = kDepthWidth;
  info.height = kDepthHeight;
  info.k = {900.0, 0.0, 640.0, 0.0, 900.0, 360.0, 0.0, 0.0, 1.0};
  info.distortion_model = "plumb_bob";
  info.distortion = {-0.28, 0.07, 0.0003, -0.0002, 0.0};
  const auto model = nodes::CameraModel::make(info, kDepthWidth, kDepthHeight, nodes::PixelGrid::Raw);
  const double rays_s = bestSecondsOf(3, [&] { (void)nodes::makeRays(*model, kDepthWidth, kDepthHeight); });
  results.push_back({"rays of 1280 x 720 pixels through a lens, once a camera", 1e3 * rays_s, "ms"});
}

void addGridMap(Conversions& conversions) {
  constexpr std::uint32_t kSide = 2000;
  auto map = std::make_shared<scenegraph::GridMap>();
  map->frame_id = "map";
  map->cell_size_m = {0.1, 0.1};
  map->column_count = map->row_count = kSide;
  map->cell_stride = 2 * sizeof(float);
  map->row_stride = kSide * map->cell_stride;
  map->fields = {{"elevation", 0, scenegraph::FieldType::Float32},
                 {"traversability", 4, scenegraph::FieldType::Float32}};
  std::vector<float> values;
  for (std::size_t i = 0; i < std::size_t{kSide} * kSide; ++i) {
    values.push_back(i % 1009 == 0 ? NAN : std::sin(static_cast<float>(i % kSide) * 0.01F));
    values.push_back(static_cast<float>(i % 256));
  }
  map->data = payloadOf(values);
  conversions.add("grid map of 2000 x 2000 cells, surface and layer", map->data.bytes.size(), 3, [&] {
    const auto surface = nodes::GridSurface::make(map);
    return surface && surface->mesh("elevation") != nullptr && surface->layer("traversability") != nullptr;
  });
}

/// Objects in memory; the locator is an index.
class Objects final : public scenegraph::EntrySource {
 public:
  std::vector<AnyObject> objects;
  std::expected<AnyObject, scenegraph::DecodeError> decode(const scenegraph::TopicInfo& /*topic*/,
                                                           const scenegraph::Entry& entry) const override {
    return objects[entry.locator];
  }
};

/// Whole ticks of a view: the state, what it uploads and the status, not the picture.
void addTicks(std::vector<BenchResult>& results) {
  const bench::PatchStream stream;
  const auto dataset = std::make_shared<scenegraph::Dataset>("bench");
  const auto source = std::make_shared<Objects>();
  const auto topic = [&](const char* name, ObjectType type) {
    scenegraph::TopicInfo info;
    info.name = name;
    info.type = type;
    return dataset->store().addTopic(info, source);
  };
  const auto append = [&](scenegraph::TopicId id, std::int64_t log_ns, AnyObject object) {
    scenegraph::Entry entry;
    entry.log_time = {log_ns};
    entry.payload_bytes = object.byteSize();
    entry.locator = source->objects.size();
    source->objects.push_back(std::move(object));
    dataset->store().append(id, {&entry, 1});
  };
  append(topic("/map", ObjectType::OccupancyGrid), 0, AnyObject::make(stream.base()));
  const auto updates = topic("/map_updates", ObjectType::OccupancyGridUpdate);
  constexpr std::int64_t kStep_ns = 10'000'000;
  for (std::size_t i = 0; i < bench::PatchStream::kPatches; ++i) {
    append(updates, static_cast<std::int64_t>(i + 1) * kStep_ns, AnyObject::make(stream.patch(i)));
  }
  const auto executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene(dataset, nodes::layerTypes(), *executor);
  if (!scene.addLayer("/map")) {
    throw std::logic_error("the benchmark's map has no layer");
  }
  const auto tick = [&](std::size_t place) { scene.update({static_cast<std::int64_t>(place) * kStep_ns}); };
  const double first_s = secondsOf([&] { tick(bench::PatchStream::kPatches); });
  results.push_back({"occupancy layer, first tick behind 10 000 patches", 1e3 * first_s, "ms"});

  // The same places in the same order, three times: what one round has and the others have not is the machine's.
  std::vector<double> seeks_ms(300, 1e9);
  for (int round = 0; round < 3; ++round) {
    std::mt19937 random(7);
    for (double& best_ms : seeks_ms) {
      const std::size_t place = random() % (bench::PatchStream::kPatches + 1);
      best_ms = std::min(best_ms, 1e3 * secondsOf([&] { tick(place); }));
    }
  }
  std::ranges::sort(seeks_ms);
  results.push_back({"occupancy layer, tick to a random patch, median", quantile(seeks_ms, 0.5), "ms", 5.0});
  results.push_back({"occupancy layer, tick to a random patch, longest", seeks_ms.back(), "ms", 16.6});
  const double play_s = secondsOf([&] {
    for (std::size_t place = 0; place < bench::PatchStream::kPatches; ++place) {
      tick(place);
    }
  });
  results.push_back(
      {"occupancy layer, 10 000 ticks in order, each", 1e6 * play_s / bench::PatchStream::kPatches, "us"});
}

}  // namespace

void benchSensors(std::vector<BenchResult>& results) {
  Conversions conversions(results);
  addScan(conversions);
  addDepth(conversions, results);
  addGridMap(conversions);
  addTicks(results);
}

}  // namespace stillframe::cli
