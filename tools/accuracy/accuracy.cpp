#include "tools/accuracy/accuracy.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace stillframe::accuracy {

std::string dateOfToday() {
  const std::chrono::year_month_day day{std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02u", static_cast<int>(day.year()),
                static_cast<unsigned>(day.month()), static_cast<unsigned>(day.day()));
  return text.data();
}

bool writeReport(const AccuracyReport& report, const std::string& directory) {
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
