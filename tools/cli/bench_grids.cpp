#include <cstring>
#include <random>

#include "tools/bench/grid_workload.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {

void benchGrids(std::vector<BenchResult>& results) {
  const bench::PatchStream stream;
  std::vector<std::byte> from(std::size_t{bench::PatchStream::kSide} * bench::PatchStream::kSide);
  std::vector<std::byte> copy(from.size());
  const double megabytes = static_cast<double>(from.size()) * 1e-6;
  const double copied_s = bestSecondsOf(5, [&] { std::memcpy(copy.data(), from.data(), from.size()); });
  results.push_back({"memcpy of a grid's 4000 x 4000 cells", megabytes / copied_s, "MB/s"});
  const double converted_s = bestSecondsOf(5, [&] { (void)stream.makeHistory(); });
  results.push_back({"occupancy grid, conversion", megabytes / converted_s, "MB/s"});

  auto history = stream.makeHistory();
  const double first_s = secondsOf([&] { (void)stream.seek(history, bench::PatchStream::kPatches); });
  results.push_back({"occupancy grid, first pass of 10 000 patches", 1e3 * first_s, "ms"});
  // The same places three times: what one round has and the others have not is the machine's.
  std::vector<double> seeks_ms(300, 1e9);
  for (int round = 0; round < 3; ++round) {
    std::mt19937 random(7);
    for (double& best_ms : seeks_ms) {
      const std::size_t place = random() % (bench::PatchStream::kPatches + 1);
      best_ms = std::min(best_ms, 1e3 * secondsOf([&] { (void)stream.seek(history, place); }));
    }
  }
  std::ranges::sort(seeks_ms);
  results.push_back({"occupancy grid, seek among 10 000 patches, median", quantile(seeks_ms, 0.5), "ms"});
  results.push_back({"occupancy grid, seek among 10 000 patches, longest", seeks_ms.back(), "ms", 5.0});
}

}  // namespace stillframe::cli
