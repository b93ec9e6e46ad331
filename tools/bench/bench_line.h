#pragma once

#include <string>

namespace stillframe::bench {

/// One measured number beside what it should be.
struct BenchLine {
  std::string name;
  double value = 0.0;
  std::string unit;
  double target = 0.0;
  bool lower_is_better = true;
  [[nodiscard]] bool meetsTarget() const noexcept { return lower_is_better ? value <= target : value >= target; }
};

}  // namespace stillframe::bench
