#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenegraph/status.h"

namespace stillframe::ingest {

/// Faults of one file in order of appearance, bounded: a file of nothing but faults must not fill the memory.
class ProblemLog {
 public:
  void add(std::string code, std::string message) {
    if (problems_.size() < kMaxListed) {
      problems_.push_back({std::move(code), std::move(message), 1});
    } else if (problems_.size() == kMaxListed) {
      problems_.push_back({"MoreProblems", "further problems of this file are not listed", 1});
    } else {
      ++problems_.back().count;
    }
  }
  /// What was added since the last call.
  [[nodiscard]] std::vector<scenegraph::Problem> take() {
    std::vector<scenegraph::Problem> fresh(problems_.begin() + static_cast<std::ptrdiff_t>(taken_), problems_.end());
    taken_ = problems_.size();
    return fresh;
  }

 private:
  static constexpr std::size_t kMaxListed = 100;
  std::vector<scenegraph::Problem> problems_;
  std::size_t taken_ = 0;
};

}  // namespace stillframe::ingest
