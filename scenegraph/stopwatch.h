#pragma once

#include <chrono>

namespace stillframe::scenegraph {

/// Wall time since `start`.
[[nodiscard]] inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
[[nodiscard]] inline double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return 1e3 * secondsSince(start);
}

}  // namespace stillframe::scenegraph
