#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "scenegraph/near_names.h"
#include "tools/cli/commands.h"
#include "tools/cli/json_text.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/time_argument.h"

namespace stillframe::cli {
namespace {

struct TfOptions {
  RecordingOptions recording;
  std::string target;
  std::string source;
  std::string time = "end";
  bool is_json = false;
};

/// All 17 significant digits, which a JSON library would shorten.
std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

void printTransform(const tf::RigidTransform& target_from_source, bool is_json) {
  const auto& t = target_from_source.translation;
  const auto& r = target_from_source.rotation;
  const std::string comma = is_json ? ", " : " ";
  const std::string translation = digits(t.x) + comma + digits(t.y) + comma + digits(t.z);
  const std::string rotation = digits(r.x) + comma + digits(r.y) + comma + digits(r.z) + comma + digits(r.w);
  if (is_json) {
    std::printf("{\"translation\": [%s], \"rotation\": [%s]}\n", translation.c_str(), rotation.c_str());
  } else {
    std::printf("translation %s\nrotation    %s\n", translation.c_str(), rotation.c_str());
  }
}

/// One sentence; a frame that does not exist is named, with those of nearly that name.
std::string reasonText(const tf::TransformBuffer& buffer, const tf::LookupFailure& failure, const TfOptions& options) {
  const bool is_target = failure.code == tf::LookupError::UnknownTarget;
  if (!is_target && failure.code != tf::LookupError::UnknownSource) {
    return buffer.describe(failure);
  }
  return scenegraph::noSuch("frame", is_target ? options.target : options.source, buffer.frames());
}

Json failureJson(const tf::TransformBuffer& buffer, const tf::LookupFailure& failure, const TfOptions& options) {
  Json error{{"code", tf::toString(failure.code)},
             {"message", reasonText(buffer, failure, options)},
             {"target", options.target},
             {"source", options.source},
             {"time_ns", failure.time.ns}};
  if (failure.code == tf::LookupError::NoSampleAtTime) {
    error["edge"] = {{"parent", buffer.frameName(buffer.parent(failure.edge_child))},
                     {"child", buffer.frameName(failure.edge_child)}};
    error["first_ns"] = failure.edge_first.ns;
    error["last_ns"] = failure.edge_last.ns;
  }
  return {{"error", error}};
}

Result<void> runTf(const TfOptions& options) {
  const auto time = parseTime(options.time);
  if (!time) {
    return std::unexpected(time.error());
  }
  const auto recording = openRecording(options.recording);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  const auto& dataset = *(*recording)->dataset();
  const auto range = dataset.timeRange();
  if (!range && time->base != TimeArgument::Base::Epoch) {
    return failure(options.recording.file + ": the recording holds no messages");
  }
  const auto point = resolveTime(*time, range.value_or(std::pair<tf::TimePoint, tf::TimePoint>{}));
  if (!point) {
    return std::unexpected(point.error());
  }
  const tf::TransformBuffer& buffer = *dataset.transforms();
  const auto target_from_source = buffer.tryLookupTransform(options.target, options.source, *point);
  if (target_from_source) {
    printTransform(*target_from_source, options.is_json);
    return {};
  }
  if (options.is_json) {
    std::fputs(jsonText(failureJson(buffer, target_from_source.error(), options)).c_str(), stdout);
  }
  return std::unexpected(CliError{
      ExitCode::LookupFailed, options.recording.file + ": " + reasonText(buffer, target_from_source.error(), options)});
}

}  // namespace

Command addTfCommand(CLI::App& app) {
  auto options = std::make_shared<TfOptions>();
  addRecordingOptions(app, options->recording);
  app.add_option("--target", options->target, "Frame to express in")->required();
  app.add_option("--source", options->source, "Frame whose points are expressed")->required();
  app.add_option("--time", options->time, "Nanoseconds, +SECONDS from the start, start, or end")->capture_default_str();
  app.add_flag("--json", options->is_json, "One JSON object, a failure too");
  return [options] { return runTf(*options); };
}

}  // namespace stillframe::cli
