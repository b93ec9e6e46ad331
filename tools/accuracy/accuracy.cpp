#include "tools/accuracy/accuracy.h"

#include <filesystem>
#include <fstream>

namespace stillframe::accuracy {

bool writeReport(const AccuracyReport& report, const std::string& directory) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  const auto write = [&](const char* extension, const std::string& text) {
    std::ofstream file(std::filesystem::path(directory) / std::string(report.name).append(extension), std::ios::binary);
    file << text;
    file.close();
    return file.good();
  };
  const bool table_written = write(".md", report.table);
  const bool plot_written = write(".svg", report.svg);
  return table_written && plot_written;
}

}  // namespace stillframe::accuracy
