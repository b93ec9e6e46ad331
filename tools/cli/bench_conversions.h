#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/cli/bench_results.h"

namespace stillframe::cli {

/// What a conversion takes in, and memcpy of the same bytes, in turns, so that both meet the same machine.
class Conversions {
 public:
  explicit Conversions(std::vector<BenchResult>& results) : results_(results) {}

  /// `convert` says whether it did.
  template <typename Convert>
  void add(const std::string& name, std::size_t bytes, int rounds, const Convert& convert) {
    const std::vector<std::byte> from(bytes, std::byte{1});
    std::vector<std::byte> to(bytes);
    double converted_s = 1e9;
    double copied_s = 1e9;
    for (int round = 0; round < rounds; ++round) {
      bool is_good = false;
      converted_s = std::min(converted_s, secondsOf([&] { is_good = convert(); }));
      copied_s = std::min(copied_s, secondsOf([&] { std::memcpy(to.data(), from.data(), bytes); }));
      if (!is_good || to.back() != from.back()) {
        throw std::logic_error("the benchmark's " + name + " was not converted");
      }
    }
    results_.push_back({name + ", conversion", 1e-6 * static_cast<double>(bytes) / converted_s, "MB/s"});
    results_.push_back({name + ", memcpy of as many bytes", 1e-6 * static_cast<double>(bytes) / copied_s, "MB/s"});
  }

 private:
  std::vector<BenchResult>& results_;
};

}  // namespace stillframe::cli
