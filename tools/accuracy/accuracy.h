#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace stillframe::accuracy {

/// One way of computing something, at one difficulty: what it costs and how far off it is.
struct AccuracyRow {
  std::string method;
  std::size_t depth = 0;     ///< edges of the chain
  double offset_m = 0.0;     ///< longest offset of an edge
  double error_m = 0.0;      ///< worst placement error of the chain's end, against the reference
  double error_rad = 0.0;    ///< worst rotation error, loss of orthogonality included
  double nanoseconds = 0.0;  ///< to compose the chain once
};

/// A report ready to print and to write.
struct AccuracyReport {
  std::string name;   ///< of its files: tf.md, tf.svg
  std::string table;  ///< Markdown
  std::string svg;
  std::vector<AccuracyRow> rows;
};

/// Error against run time of the ways of composing a chain of transforms, depths 1 to 1024, offsets 1 to 1e9 m. Seeded:
/// errors are the same in every run, times are measured. Takes about `seconds`, and a second more.
[[nodiscard]] AccuracyReport tfAccuracy(double seconds = 2.0);

/// Writes DIRECTORY/<name>.md and .svg, creating the directory; false when that failed.
[[nodiscard]] bool writeReport(const AccuracyReport& report, const std::string& directory);

}  // namespace stillframe::accuracy
