#pragma once

#include <cstdint>

namespace stillframe::nodes {

/// What the importing process may use; the parent passes it on.
struct ImportLimits {
  std::uint64_t memory_bytes = std::uint64_t{6} << 30U;  ///< address space
  std::uint64_t output_bytes = std::uint64_t{2} << 30U;  ///< of the mesh
  std::uint32_t cpu_s = 10;
  std::uint32_t wall_s = 25;  ///< the parent ends it then
};

/// Confines the calling process for good: memory, CPU time, size of written files, no core dump, dies with its parent;
/// by a system call filter it can open no file for writing, reach no network and start no program. Returns whether the
/// filter is in force too (it is not on machines whose kernel has none, and then the limits stand alone).
bool confineProcess(const ImportLimits& limits);

}  // namespace stillframe::nodes
