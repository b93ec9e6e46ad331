#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tf/transform_buffer.h"

namespace stillframe::bench {

/// Samples of a chain of frames at a steady 100 Hz with a little jitter, edges taking turns as they do in a recording.
///
/// Seeded: every run is the same. Frame 0 is the root; frame i hangs below frame i - 1.
class ChainWorkload {
 public:
  /// `pause_ns`: halfway, the robot was switched off for so long.
  ChainWorkload(std::size_t depth, std::size_t samples_per_edge, std::int64_t pause_ns = 0);

  [[nodiscard]] const std::vector<tf::TransformSample>& samples() const noexcept { return samples_; }
  void shuffle();
  /// A buffer that holds them all.
  [[nodiscard]] std::unique_ptr<tf::TransformBuffer> load() const;
  /// Frees the samples once a buffer holds them.
  void forgetSamples();
  [[nodiscard]] const std::string& root() const noexcept { return names_.front(); }
  [[nodiscard]] const std::string& leaf() const noexcept { return names_.back(); }
  /// A time at which the whole chain has samples, uniform over its history less the pause.
  [[nodiscard]] tf::TimePoint randomTime();

 private:
  std::mt19937_64 random_{42};
  std::vector<std::string> names_;  // the samples view these
  std::vector<tf::TransformSample> samples_;
  std::int64_t first_ns_ = 0;
  std::int64_t last_ns_ = 0;
  std::int64_t half_span_ns_ = 0;  // of the history less the pause
};

/// A tree of `frames` frames, each below a random earlier one, with one second of 100 Hz samples an edge.
[[nodiscard]] std::unique_ptr<tf::TransformBuffer> makeRandomTree(std::size_t frames);

struct SharedRates {
  double lookups_per_s = 0.0;  ///< of all readers together
  double inserts_per_s = 0.0;  ///< of all writers together
};

/// `readers` threads looking up over `seconds`, while `writers` threads insert in bulk.
[[nodiscard]] SharedRates sharedRates(tf::TransformBuffer& buffer, const ChainWorkload& chain, int readers, int writers,
                                      double seconds);

}  // namespace stillframe::bench
