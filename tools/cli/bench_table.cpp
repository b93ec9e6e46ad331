#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ranges>
#include <string>
#include <vector>

#include "tools/cli/bench_results.h"
#include "tools/cli/json_text.h"

namespace stillframe::cli {
namespace {

/// One run of the benchmark, as it was printed.
struct BenchRun {
  std::string title;
  Json json;
};

Result<BenchRun> readRun(const std::string& file) {
  std::ifstream stream(file);
  Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("results") || !json["results"].is_array()) {
    return failure(file + ": this is not what `bench --json` prints");
  }
  return BenchRun{std::filesystem::path(file).stem().string(), std::move(json)};
}

/// The row of that name; nullptr when the run has none.
const Json* findRow(const BenchRun& run, const std::string& name) {
  for (const Json& row : run.json["results"]) {
    if (row.value("name", "") == name) {
      return &row;
    }
  }
  return nullptr;
}

std::string targetOf(const Json& row) {
  return row.contains("at_most")    ? "at most " + valueText(row.value("at_most", 0.0))
         : row.contains("at_least") ? "at least " + valueText(row.value("at_least", 0.0))
                                    : "";
}

/// Names of all rows: those of the last run in its order, then what only earlier ones have.
std::vector<std::string> namesOf(const std::vector<BenchRun>& runs) {
  std::vector<std::string> names;
  for (const BenchRun& run : runs | std::views::reverse) {
    for (const Json& row : run.json["results"]) {
      if (const std::string name = row.value("name", ""); std::ranges::find(names, name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  return names;
}

}  // namespace

std::string valueText(double value) {
  std::array<char, 320> text{};
  std::snprintf(text.data(), text.size(), value >= 1000.0 ? "%.0f" : value < 0.1 ? "%.3g" : "%.4g", value);
  return text.data();
}

Result<std::string> benchTable(const std::vector<std::string>& files) {
  std::vector<BenchRun> runs;
  for (const std::string& file : files) {
    auto run = readRun(file);
    if (!run) {
      return std::unexpected(run.error());
    }
    runs.push_back(std::move(*run));
  }
  std::string text;
  std::string head = "| what |";
  std::string rule = "|---|";
  for (const BenchRun& run : runs) {
    text += "- " + run.title + ": " + run.json.value("processor", "?") + ", " +
            std::to_string(run.json.value("cores", 0)) + " cores, memcpy " +
            valueText(run.json.value("memcpy_mb_per_s", 0.0)) + " MB/s; " + run.json.value("renderer", "?") +
            "; stillframe " + run.json.value("version", "?") + "; " + run.json.value("date", "?") + "\n";
    head += " " + run.title + " |";
    rule += "--:|";
  }
  text += "\n" + head + " target |\n" + rule + "---|\n";
  for (const std::string& name : namesOf(runs)) {
    std::string unit;
    std::string target;
    std::string cells;
    for (const BenchRun& run : runs) {
      const Json* const row = findRow(run, name);
      cells += " " + (row == nullptr ? std::string() : valueText(row->value("value", 0.0))) + " |";
      unit = row == nullptr ? unit : row->value("unit", "");
      target = row == nullptr ? target : targetOf(*row);
    }
    text += "| " + name + (unit.empty() ? "" : " (" + unit + ")") + " |" + cells + " " + target + " |\n";
  }
  return text;
}

}  // namespace stillframe::cli
