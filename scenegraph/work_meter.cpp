#include "scenegraph/work_meter.h"

#include <chrono>
#include <utility>

namespace stillframe::scenegraph {

void WorkMeter::submit(std::function<void()> job) {
  inner_.submit([job = std::move(job), last_ns = last_ns_] {
    const auto start = std::chrono::steady_clock::now();
    job();
    last_ns->store(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start).count());
  });
}

std::optional<double> WorkMeter::lastMs() const {
  const std::int64_t ns = last_ns_->load();
  return ns < 0 ? std::nullopt : std::optional(static_cast<double>(ns) * 1e-6);
}

}  // namespace stillframe::scenegraph
