#include "tools/accuracy/accuracy.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/accuracy/depth_accuracy.h"
#include "tools/accuracy/points_accuracy.h"
#include "tools/accuracy/post_accuracy.h"
#include "tools/accuracy/tf_accuracy.h"
#include "tools/accuracy/transparency_accuracy.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_session.h"
#include "tools/cli/temporary_sample.h"
#include "tools/sample/sample.h"

namespace stillframe::cli {
namespace {

using accuracy::AccuracyReport;

struct AccuracyOptions {
  std::string subject = "tf";
  RecordingOptions recording;
  std::string folder;
};

Result<AccuracyReport> reportOfTf(const AccuracyOptions& /*options*/) { return accuracy::tfAccuracy().report; }

Result<AccuracyReport> reportOfDepth(const AccuracyOptions& /*options*/) { return accuracy::depthAccuracy().report; }

/// The clouds of the file's last instant, or of a sample made for it, as they are seen from above at an angle.
Result<AccuracyReport> reportOfPoints(const AccuracyOptions& options) {
  const TemporarySample sample;
  ViewOptions view;
  view.recording = options.recording;
  std::string what = printable(options.recording.file);
  if (options.recording.file.empty()) {
    view.recording.file = sample.path().string();
    what = "The sample recording with large clouds";
    constexpr sample::SampleOptions kLargeClouds{.duration_ns = 150'000'000, .lidar_points = 1'000'000};
    if (const auto made = sample::writeSample(sample.path(), kLargeClouds); !made) {
      return std::unexpected(fileError(view.recording.file, made.error()));
    }
  }
  auto session = SceneSession::make(view);
  if (!session) {
    return std::unexpected(session.error());
  }
  scenegraph::Scene& scene = (*session)->scene();
  for (const auto& slot : scene.layers()) {
    slot->layer->setVisible(slot->type->consumes == scenegraph::ObjectType::PointCloud);
  }
  (*session)->showTime((*session)->time());
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  auto measured = accuracy::pointsAccuracy(**renderer, scene.root(), (*session)->camera(), what);
  if (!measured) {
    return std::unexpected(fileError(view.recording.file, measured.error()));
  }
  return std::move(measured->report);
}

Result<AccuracyReport> reportOfPost(const AccuracyOptions& /*options*/) {
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  auto measured = accuracy::postAccuracy(**renderer);
  if (!measured) {
    return failure(measured.error().message);
  }
  return std::move(measured->report);
}

Result<AccuracyReport> reportOfTransparency(const AccuracyOptions& /*options*/) {
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  auto measured = accuracy::transparencyAccuracy(**renderer);
  if (!measured) {
    return failure(measured.error().message);
  }
  return std::move(measured->report);
}

/// A subject is a line here and a file of tools/accuracy/.
struct Subject {
  const char* name;
  const char* help;
  Result<AccuracyReport> (*report)(const AccuracyOptions& options);
  bool takes_file = false;
};

constexpr std::array kSubjects{
    Subject{"tf", "the ways of composing a chain of transforms", &reportOfTf},
    Subject{"post", "the post passes: occlusion, eye-dome lighting, target formats, anti-aliasing", &reportOfPost},
    Subject{"transparency", "putting only so many blended fragments of a pixel in order", &reportOfTransparency},
    Subject{"depth", "turning round the lens of a depth camera", &reportOfDepth},
    Subject{"points", "drawing fewer points, by each rasteriser, of FILE or of a sample", &reportOfPoints, true},
};

Result<void> runAccuracy(const AccuracyOptions& options) {
  const auto* const subject = std::ranges::find(kSubjects, options.subject, &Subject::name);
  if (!options.recording.file.empty() && !subject->takes_file) {
    return usageError("accuracy " + options.subject + " is measured on no recording; '" +
                      printable(options.recording.file) + "' is one too many");
  }
  if (!options.folder.empty()) {  // said now, not after minutes of measuring
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) {
      return failure("--out '" + options.folder + "': " + failed.message());
    }
  }
  const auto report = subject->report(options);
  if (!report) {
    return std::unexpected(report.error());
  }
  std::fputs(report->table.c_str(), stdout);
  if (options.folder.empty()) {
    return {};
  }
  if (!accuracy::writeReport(*report, options.folder)) {
    return failure(options.folder + ": cannot write " + report->name + ".md and " + report->name + ".svg there");
  }
  std::printf("\n%s/%s.md\n%s/%s.svg\n", options.folder.c_str(), report->name.c_str(), options.folder.c_str(),
              report->name.c_str());
  return {};
}

}  // namespace

Command addAccuracyCommand(CLI::App& app) {
  auto options = std::make_shared<AccuracyOptions>();
  std::string help;
  std::vector<std::string> names;
  for (const Subject& subject : kSubjects) {
    help += std::string(help.empty() ? "" : "; ") + subject.name + ": " + subject.help;
    names.emplace_back(subject.name);
  }
  app.add_option("SUBJECT", options->subject, help)->check(CLI::IsMember(names))->capture_default_str();
  app.add_option("FILE", options->recording.file, "A recording to measure on, where the subject takes one");
  addTransformOptions(app, options->recording);
  app.add_option("--out", options->folder, "Folder for the table and an SVG plot of error against run time");
  return [options] { return runAccuracy(*options); };
}

}  // namespace stillframe::cli
