#pragma once

#include <string>

namespace stillframe::accuracy {

/// A report of error against run time, ready to print and to write. Each subject makes one: a header of its own, and a
/// line in the program's table of subjects.
struct AccuracyReport {
  std::string name;   ///< of its files: tf.md, tf.svg
  std::string table;  ///< Markdown
  std::string svg;
};

/// "2026-11-22", UTC: when what is reported was measured.
[[nodiscard]] std::string dateOfToday();

/// Writes <name>.md and <name>.svg into a directory that there is; false when that failed.
[[nodiscard]] bool writeReport(const AccuracyReport& report, const std::string& directory);

}  // namespace stillframe::accuracy
