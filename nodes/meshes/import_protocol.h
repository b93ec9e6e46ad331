#pragma once

#include <cstddef>

namespace stillframe::nodes {

/// What the importing process finds open, and how it ends.
inline constexpr int kImportMeshFd = 3;
inline constexpr int kImportResultFd = 4;
inline constexpr int kImportSentenceFd = 5;
inline constexpr std::size_t kMaxImportSentence = 1000;

enum class ImportExit : int {
  Done = 0,
  NotAMesh = 1,
  OutOfMemory = 2,
  Misuse = 3,
};

}  // namespace stillframe::nodes
