#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <ranges>

#include "scenegraph/how_many.h"
#include "scenegraph/store/edge_problems.h"
#include "tools/cli/commands.h"
#include "tools/cli/json_text.h"
#include "tools/cli/layer_report.h"
#include "tools/cli/recording_options.h"

namespace stillframe::cli {
namespace {

using ingest::Recording;
using TopicSummary = Recording::TopicSummary;

struct InfoOptions {
  RecordingOptions recording;
  bool is_json = false;
};

Json stampOrNull(bool is_known, tf::TimePoint time) { return is_known ? Json(time.ns) : Json(nullptr); }

Json topicJson(const TopicSummary& topic) {
  const auto type = scenegraph::toString(topic.type);
  Json json{{"name", topic.name},
            {"schema", topic.schema},
            {"encoding", topic.encoding},
            {"type", type.empty() ? Json(nullptr) : Json(type)},
            {"count", topic.count},
            {"first_ns", stampOrNull(topic.count > 0, topic.first)},
            {"last_ns", stampOrNull(topic.count > 0, topic.last)}};
  if (!topic.unsupported_reason.empty()) {
    json["unsupported_reason"] = topic.unsupported_reason;
  }
  return json;
}

Json frameJson(const tf::TransformBuffer& buffer, tf::FrameId frame) {
  const auto edge = buffer.edge(frame);
  const bool has_samples = edge && edge->samples > 0;
  return {{"name", buffer.frameName(frame)},
          {"parent", edge ? Json(edge->parent) : Json(nullptr)},
          {"samples", edge ? edge->samples : 0},
          {"first_ns", has_samples ? Json(edge->first.ns) : Json(nullptr)},
          {"last_ns", has_samples ? Json(edge->last.ns) : Json(nullptr)},
          {"is_static", edge && edge->is_static}};
}

/// Gaps, jumps and stale ends of the edges.
std::vector<scenegraph::Problem> edgeProblemsOf(const scenegraph::Dataset& dataset) {
  const auto range = dataset.timeRange();
  return range ? scenegraph::edgeProblems(*dataset.transforms(), range->second) : std::vector<scenegraph::Problem>{};
}

void printProblems(const char* title, std::span<const scenegraph::Problem> problems) {
  if (!problems.empty()) {
    std::printf("\n%zu %s\n", problems.size(), title);
  }
  for (const auto& problem : problems) {
    std::printf("  %s (%llu x): %s\n", problem.code.c_str(), static_cast<unsigned long long>(problem.count),
                printable(problem.message).c_str());
  }
}

Json infoJson(const Recording& recording) {
  const auto& dataset = *recording.dataset();
  const tf::TransformBuffer& buffer = *dataset.transforms();
  const auto range = dataset.timeRange();
  Json json;
  json["start_ns"] = range ? Json(range->first.ns) : Json(nullptr);
  json["end_ns"] = range ? Json(range->second.ns) : Json(nullptr);
  json["tf_time"] = dataset.tfClockInUse() == scenegraph::TfClock::Log ? "log" : "header";
  json["topics"] = Json::array();
  for (const auto& topic : recording.topics()) {
    json["topics"].push_back(topicJson(topic));
  }
  json["frames"] = Json::array();
  for (tf::FrameId frame = 0; frame < buffer.frameCount(); ++frame) {
    json["frames"].push_back(frameJson(buffer, frame));
  }
  json["attachments"] = Json::array();
  for (const auto& attachment : recording.attachments()) {
    json["attachments"].push_back({{"name", attachment.name},
                                   {"media_type", attachment.media_type},
                                   {"bytes", attachment.bytes},
                                   {"log_time_ns", attachment.log_time.ns}});
  }
  json["metadata"] = recording.metadataNames();
  json["problems"] = problemsJson(dataset.problems());
  json["edge_problems"] = problemsJson(edgeProblemsOf(dataset));
  return json;
}

void printTopics(const Recording& recording) {
  std::size_t widest_name = 5;
  std::size_t widest_schema = 6;
  const auto topics = recording.topics();
  for (const auto& topic : topics) {
    widest_name = std::max(widest_name, topic.name.size());
    widest_schema = std::max(widest_schema, topic.schema.size());
  }
  std::printf("\n%zu topics\n", topics.size());
  for (const auto& topic : topics) {
    const auto type = scenegraph::toString(topic.type);
    std::printf(
        "  %-*s  %-*s  %-8s %8llu  %s\n", static_cast<int>(widest_name), printable(topic.name).c_str(),
        static_cast<int>(widest_schema), printable(topic.schema).c_str(), printable(topic.encoding).c_str(),
        static_cast<unsigned long long>(topic.count),
        type.empty() ? ("not drawn: " + printable(topic.unsupported_reason)).c_str() : std::string(type).c_str());
  }
}

void printFrames(const tf::TransformBuffer& buffer) {
  // A million frames are possible, and a chain of them too: the children of every frame, walked without recursion.
  std::map<tf::FrameId, std::vector<tf::FrameId>> children;
  const std::size_t count = buffer.frameCount();
  for (tf::FrameId frame = 0; frame < count; ++frame) {
    if (const tf::FrameId parent = buffer.parent(frame); parent != tf::kNoFrame) {
      children[parent].push_back(frame);
    }
  }
  std::printf("\n%zu frames\n", count);
  std::vector<std::pair<tf::FrameId, std::size_t>> open;
  const auto roots = buffer.roots();
  for (const tf::FrameId root : roots | std::views::reverse) {
    open.emplace_back(root, 1);
  }
  while (!open.empty()) {
    const auto [frame, depth] = open.back();
    open.pop_back();
    std::string line = std::string(2 * std::min<std::size_t>(depth, 32), ' ') + printable(buffer.frameName(frame));
    if (const auto edge = buffer.edge(frame)) {
      line += "  " + scenegraph::howMany(edge->samples, "samples");
      line += edge->is_static ? ", static" : "";
    }
    std::printf("%s\n", line.c_str());
    if (const auto found = children.find(frame); found != children.end()) {
      for (const tf::FrameId child : found->second | std::views::reverse) {
        open.emplace_back(child, depth + 1);
      }
    }
  }
}

void printInfo(const std::string& file, const Recording& recording) {
  const auto& dataset = *recording.dataset();
  std::printf("%s\n", printable(file).c_str());
  if (const auto range = dataset.timeRange()) {
    std::printf("  start     %lld ns\n  end       %lld ns\n  duration  %.9g s\n",
                static_cast<long long>(range->first.ns), static_cast<long long>(range->second.ns),
                tf::secondsBetween(range->first, range->second));
  } else {
    std::printf("  no messages\n");
  }
  std::printf("  tf time   %s\n", dataset.tfClockInUse() == scenegraph::TfClock::Log ? "log" : "header");
  for (const auto& attachment : recording.attachments()) {
    std::printf("  attached  %s (%s, %llu bytes)\n", printable(attachment.name).c_str(),
                printable(attachment.media_type).c_str(), static_cast<unsigned long long>(attachment.bytes));
  }
  for (const auto& name : recording.metadataNames()) {
    std::printf("  metadata  %s\n", printable(name).c_str());
  }
  printTopics(recording);
  printFrames(*dataset.transforms());
  printProblems("problems", dataset.problems());
  printProblems("edges worth a look", edgeProblemsOf(dataset));
}

Result<void> runInfo(const InfoOptions& options) {
  const auto recording = openRecording(options.recording);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  if (options.is_json) {
    std::fputs(jsonText(infoJson(**recording)).c_str(), stdout);
  } else {
    printInfo(options.recording.file, **recording);
  }
  return {};
}

}  // namespace

Command addInfoCommand(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  addRecordingOptions(app, options->recording);
  app.add_flag("--json", options->is_json, "One JSON object instead of a table");
  return [options] { return runInfo(*options); };
}

}  // namespace stillframe::cli
