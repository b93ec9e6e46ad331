// What it costs to import a mesh in a process of its own: the same file, in the child and in this program.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "nodes/meshes/import_process.h"
#include "nodes/meshes/mesh_import.h"

namespace stillframe::bench {
namespace {

/// A wavy binary STL of so many triangles.
std::vector<std::byte> makeStl(std::uint32_t triangles) {
  constexpr std::size_t kHeader = 80;
  std::vector<std::byte> bytes(kHeader);
  const auto put = [&](const auto& value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(value));
    std::memcpy(bytes.data() + at, &value, sizeof(value));
  };
  put(triangles);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const float x = static_cast<float>(i % 1000);
    const float y = static_cast<float>(i) / 1000.0F;
    const std::array<float, 12> facet{0, 0, 1, x, y, std::sin(x), x + 1, y, std::sin(x + 1), x, y + 1, std::sin(x)};
    put(facet);
    put(std::uint16_t{0});
  }
  return bytes;
}

void inChild(benchmark::State& state) {
  const auto bytes = makeStl(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) {
    const auto mesh =
        nodes::importInProcess({.bytes = bytes, .format = "stl", .limits = nodes::importLimits(bytes.size())});
    if (!mesh) {
      state.SkipWithError(mesh.error().message.c_str());
      return;
    }
    benchmark::DoNotOptimize(mesh->positions.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void inThisProgram(benchmark::State& state) {
  const auto bytes = makeStl(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) {
    const auto mesh = nodes::importMesh({.bytes = bytes, .format = "stl"});
    benchmark::DoNotOptimize(mesh->positions.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(inThisProgram)->Arg(100)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(inChild)->Arg(100)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace stillframe::bench
