// Markers: a message of 20 000 cubes, read alone, and made into the state that is drawn.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/markers/scene_history.h"
#include "tools/ingest/message_decoder.h"
#include "tools/sample/marker_messages.h"

namespace stillframe::bench {
namespace {

std::shared_ptr<const std::vector<std::byte>> cubes(int count) {
  std::vector<sample::Marker> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    sample::Marker& marker = all[static_cast<std::size_t>(i)];
    marker.frame_id = "map";
    marker.ns = "cubes";
    marker.id = i;
    const int row = i / 300;
    marker.pose.translation = {0.1 * (i % 300), 0.1 * row, 0.0};
  }
  return std::make_shared<const std::vector<std::byte>>(sample::serializeMarkerArray(all));
}

class CubesReader {
 public:
  CubesReader()
      : schema_{1, std::string(sample::markerArrayType().name), "ros2msg",
                std::string(sample::markerArrayType().definition)},
        decoder_(ingest::makeDecoder(&schema_, "cdr", "/bench")) {}
  [[nodiscard]] scenegraph::AnyObject read(const std::shared_ptr<const std::vector<std::byte>>& bytes) const {
    return decoder_.decoder->decode({*bytes, bytes, bytes->size(), {0}}).value();
  }

 private:
  ingest::SchemaRecord schema_;
  ingest::ChannelDecoder decoder_;
};

void readMarkers(benchmark::State& state) {
  const auto bytes = cubes(20'000);
  const CubesReader reader;
  for (auto _ : state) {
    benchmark::DoNotOptimize(reader.read(bytes));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes->size()));
}

void foldMarkers(benchmark::State& state) {
  const auto bytes = cubes(20'000);
  const auto object = CubesReader().read(bytes);
  for (auto _ : state) {
    nodes::SceneHistory history;
    benchmark::DoNotOptimize(history.at(
        1, {1}, [](std::size_t) { return 0U; },
        [&](std::size_t) {
          return nodes::SceneMessage{{0}, 0, bytes->size(), object.get<scenegraph::SceneEntities>()};
        }));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes->size()));
}

BENCHMARK(readMarkers)->Unit(benchmark::kMillisecond);
BENCHMARK(foldMarkers)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stillframe::bench

BENCHMARK_MAIN();
