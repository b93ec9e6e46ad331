#include "scenegraph/store/edge_problems.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "scenegraph/store/tf_clock.h"

namespace stillframe::scenegraph {
namespace {

/// What happens between two samples that follow each other.
struct Step {
  double seconds = 0.0;
  double metres = 0.0;
  double radians = 0.0;
};

std::vector<Step> stepsOf(const std::vector<tf::StampedTransform>& samples) {
  std::vector<Step> steps;
  steps.reserve(samples.size());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const tf::RigidTransform& before = samples[i - 1].parent_from_child;
    const tf::RigidTransform& after = samples[i].parent_from_child;
    const glm::dquat turn = glm::conjugate(before.rotation) * after.rotation;
    steps.push_back({tf::secondsBetween(samples[i - 1].stamp, samples[i].stamp),
                     glm::length(after.translation - before.translation),
                     2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w))});
  }
  return steps;
}

/// The value of `member` that `fraction` of the steps do not exceed; `steps` are not empty.
double quantile(const std::vector<Step>& steps, double Step::* member, double fraction) {
  std::vector<double> values;
  values.reserve(steps.size());
  for (const Step& step : steps) {
    values.push_back(step.*member);
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

std::string number(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

/// Lists the first few problems of a kind on an edge, and how many more there are.
class Listed {
 public:
  Listed(std::vector<Problem>& all, std::size_t most) : all_(all), most_(most) {}
  void add(Problem problem) {
    if (++count_ <= most_) {
      all_.push_back(std::move(problem));
      last_ = all_.size() - 1;
    }
  }
  void finish() {
    if (count_ > most_ && most_ > 0) {
      all_[last_].message += "; and " + std::to_string(count_ - most_) + " more on this edge";
      all_[last_].count += count_ - most_;
    }
  }

 private:
  std::vector<Problem>& all_;
  std::size_t most_ = 0;
  std::size_t count_ = 0;
  std::size_t last_ = 0;
};

void checkEdge(const std::string& edge, const std::vector<tf::StampedTransform>& samples, tf::TimePoint end,
               const EdgeLimits& limits, std::vector<Problem>& problems) {
  const std::vector<Step> steps = stepsOf(samples);
  double usual_s = limits.least_gap_s;
  if (!steps.empty()) {
    usual_s = quantile(steps, &Step::seconds, 0.5);
    const double longest_s = std::max(limits.least_gap_s, limits.gap_intervals * usual_s);
    const double longest_m = std::max(limits.least_jump_m, limits.jump_steps * quantile(steps, &Step::metres, 0.95));
    const double widest_rad =
        std::max(limits.least_jump_rad, limits.jump_steps * quantile(steps, &Step::radians, 0.95));
    Listed gaps(problems, limits.most_listed);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].seconds > longest_s) {
        gaps.add({"TransformGap",
                  edge + " has no sample for " + number(steps[i].seconds, "s") + " after " +
                      timeText(samples[i].stamp) + "; it usually has one every " + number(usual_s, "s"),
                  1, samples[i].stamp});
      }
    }
    gaps.finish();
    Listed jumps(problems, limits.most_listed);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].metres > longest_m || steps[i].radians > widest_rad) {
        jumps.add({"TransformJump",
                   edge + " jumps by " + number(steps[i].metres, "m") + " and " +
                       number(steps[i].radians * 180.0 / 3.14159265358979324, "degrees") + " at " +
                       timeText(samples[i + 1].stamp),
                   1, samples[i + 1].stamp});
      }
    }
    jumps.finish();
  }
  const double silent_s = samples.empty() ? 0.0 : tf::secondsBetween(samples.back().stamp, end);
  if (silent_s > std::max(limits.least_gap_s, limits.gap_intervals * usual_s)) {
    problems.push_back({"StaleTransform",
                        edge + " has its last sample at " + timeText(samples.back().stamp) + ", " +
                            number(silent_s, "s") + " before the end; it is held from there on",
                        1, samples.back().stamp});
  }
}

}  // namespace

std::vector<Problem> edgeProblems(const tf::TransformBuffer& buffer, tf::TimePoint end, const EdgeLimits& limits) {
  std::vector<Problem> problems;
  const std::size_t count = buffer.frameCount();
  for (tf::FrameId child = 0; child < count; ++child) {
    const auto edge = buffer.edge(child);
    if (edge && !edge->is_static) {
      checkEdge("'" + edge->parent + "' -> '" + edge->child + "'", buffer.samples(child), end, limits, problems);
    }
  }
  return problems;
}

}  // namespace stillframe::scenegraph
