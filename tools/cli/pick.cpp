#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string_view>

#include "scenegraph/camera/picking.h"
#include "scenegraph/pick/scene_pick.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "tools/cli/commands.h"
#include "tools/cli/json_text.h"
#include "tools/cli/scene_session.h"

namespace stillframe::cli {
namespace {

constexpr double kFrameReachPx = 24.0;
constexpr std::size_t kMostFrames = 8;

struct PickOptions {
  explicit PickOptions(CLI::App& app) : view(app) {}
  ViewArguments view;
  std::vector<std::string> pixels;
  std::string reach = "8";
  bool is_json = false;
};

struct Pixel {
  int x = 0;
  int y = 0;
};

/// What lies at one pixel.
struct PixelReport {
  Pixel pixel;
  std::expected<scenegraph::PickResult, scenegraph::PickError> result;
  std::vector<std::string> frames;  ///< whose origins are near
};

Result<Pixel> parsePixel(const std::string& text, const PictureSize& size) {
  Pixel pixel;
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, pixel.x);
  const bool has_comma = x.ec == std::errc{} && x.ptr != end && *x.ptr == ',';
  const auto y = has_comma ? std::from_chars(x.ptr + 1, end, pixel.y) : x;
  if (!has_comma || y.ec != std::errc{} || y.ptr != end) {
    return usageError("--pixel '" + text + "' is not two whole numbers X,Y");
  }
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.width_px || pixel.y >= size.height_px) {
    return usageError("--pixel '" + text + "' lies outside of the picture of " + std::to_string(size.width_px) + "x" +
                      std::to_string(size.height_px) + " pixels; the top left one is 0,0");
  }
  return pixel;
}

Json valueJson(const scenegraph::PickValue& value) {
  return std::visit(
      [&](const auto& held) -> Json {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, float>) {
          // The digits that the float has, and no more.
          return std::isfinite(held) ? Json::parse(scenegraph::pickText(held)) : Json(scenegraph::pickText(held));
        } else if constexpr (std::is_same_v<Held, double>) {
          return std::isfinite(held) ? Json(held) : Json(scenegraph::pickText(held));
        } else {
          return held;
        }
      },
      value);
}

Json pointJson(const std::string& frame, const std::optional<glm::dvec3>& point) {
  return {{"frame", frame}, {"xyz", point ? Json{point->x, point->y, point->z} : Json(nullptr)}};
}

Json reportJson(const scenegraph::Scene& scene, const PixelReport& report, const std::string& display_frame) {
  Json json{{"pixel", {report.pixel.x, report.pixel.y}}};
  json["code"] = report.result ? "Ok" : scenegraph::toString(report.result.error());
  json["frames"] = report.frames;
  if (!report.result) {
    return json;
  }
  const scenegraph::PickResult& result = *report.result;
  json["topic"] = result.topic;
  json["kind"] = result.picked.kind;
  json["id"] = result.picked.id;
  json["stamp_ns"] = result.picked.stamp ? Json(result.picked.stamp->ns) : Json(nullptr);
  json["source"] = pointJson(result.frame, result.picked.point_in_frame);
  json["fixed"] = pointJson(result.fixed_frame, result.point_in_fixed);
  json["display"] = pointJson(display_frame, scenegraph::pointIn(scene, result, display_frame));
  Json fields = Json::object();
  for (const auto& [name, value] : result.picked.fields) {
    std::string key = name;
    for (int i = 2; fields.contains(key); ++i) {  // a cloud may name two fields alike
      key = name + "#" + std::to_string(i);
    }
    fields[key] = valueJson(value);
  }
  json["fields"] = std::move(fields);
  return json;
}

void printReport(const scenegraph::Scene& scene, const PixelReport& report, const std::string& display_frame) {
  std::printf("%d,%d", report.pixel.x, report.pixel.y);
  if (!report.result) {
    std::printf(": nothing there\n");
  } else {
    std::printf("\n");
    for (const auto& [name, text] : scenegraph::pickRows(scene, *report.result, display_frame)) {
      std::printf("  %s: %s\n", printable(name).c_str(), printable(text).c_str());
    }
  }
  for (const std::string& frame : report.frames) {
    std::printf("  near frame: %s\n", printable(frame).c_str());
  }
}

Result<void> runPick(const PickOptions& options) {
  const auto view = options.view.view();
  if (!view) {
    return std::unexpected(view.error());
  }
  const auto reach = parseNumber("--reach", options.reach, 0.0, 64.0);
  if (!reach) {
    return std::unexpected(reach.error());
  }
  if (options.pixels.size() > 2) {
    return usageError("--pixel is given " + std::to_string(options.pixels.size()) +
                      " times: once to pick, twice to measure as well");
  }
  std::vector<Pixel> pixels;
  for (const std::string& text : options.pixels) {
    const auto pixel = parsePixel(text, view->size);
    if (!pixel) {
      return std::unexpected(pixel.error());
    }
    pixels.push_back(*pixel);
  }
  auto made = SceneSession::make(*view);
  if (!made) {
    return std::unexpected(made.error());
  }
  scenegraph::Scene& scene = (*made)->scene();
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  (*made)->setContext((*renderer)->context().info());
  const scenegraph::CameraView camera = (*made)->camera();
  const scenegraph::PictureSize size{static_cast<double>(view->size.width_px),
                                     static_cast<double>(view->size.height_px)};
  scene.setView(camera, size);
  const auto drawn = (*renderer)->render(
      scene.root(), camera, {view->size.width_px, view->size.height_px, view->background, {}, view->points});
  if (!drawn) {
    return failure(drawn.error().message);
  }
  const std::string display_frame = view->follow_frame.value_or(scene.fixedFrame());
  std::vector<PixelReport> reports;
  for (const Pixel& pixel : pixels) {
    const auto hits = (*renderer)->pick(pixel.x, pixel.y, static_cast<int>(*reach));
    PixelReport report{pixel, scenegraph::describeHits(scene, hits), {}};
    for (auto& near : scenegraph::pickFrames(scene.frames().buffer(), scene.frames().snapshot(), camera, size,
                                             {pixel.x + 0.5, pixel.y + 0.5}, kFrameReachPx, kMostFrames)) {
      report.frames.push_back(std::move(near.frame));
    }
    reports.push_back(std::move(report));
  }
  std::optional<scenegraph::Measurement> measured;
  if (reports.size() == 2 && reports[0].result && reports[1].result) {
    measured = scenegraph::measure(reports[0].result->point_in_fixed, reports[1].result->point_in_fixed);
  }
  if (options.is_json) {
    Json json{{"size", {view->size.width_px, view->size.height_px}},
              {"time_ns", (*made)->time().ns},
              {"fixed_frame", scene.fixedFrame()},
              {"display_frame", display_frame},
              {"picks", Json::array()}};
    for (const PixelReport& report : reports) {
      json["picks"].push_back(reportJson(scene, report, display_frame));
    }
    if (measured) {
      const glm::dvec3& delta = measured->delta_in_fixed;
      json["measurement"] = {
          {"frame", scene.fixedFrame()}, {"delta", {delta.x, delta.y, delta.z}}, {"length_m", measured->length_m}};
    }
    std::fputs(jsonText(json).c_str(), stdout);
  } else {
    for (const PixelReport& report : reports) {
      printReport(scene, report, display_frame);
    }
    if (measured) {
      std::printf("distance in %s: %s m, components %s\n", printable(scene.fixedFrame()).c_str(),
                  scenegraph::pickText(measured->length_m).c_str(),
                  scenegraph::pointText(measured->delta_in_fixed).c_str());
    }
  }
  for (const PixelReport& report : reports) {
    if (!report.result) {
      return std::unexpected(CliError{ExitCode::LookupFailed, view->recording.file + ": nothing there at pixel " +
                                                                  std::to_string(report.pixel.x) + "," +
                                                                  std::to_string(report.pixel.y)});
    }
  }
  return {};
}

}  // namespace

Command addPickCommand(CLI::App& app) {
  auto options = std::make_shared<PickOptions>(app);
  app.add_option("--pixel", options->pixels, "Column and row of a pixel, from 0,0 at the top left; twice to measure")
      ->required()
      ->type_name("X,Y")
      ->allow_extra_args(false);
  app.add_option("--reach", options->reach, "Pixels by which a point or a line may be missed, 0 to 64")
      ->capture_default_str();
  app.add_flag("--json", options->is_json, "One JSON object, nothing found too");
  return [options] { return runPick(*options); };
}

}  // namespace stillframe::cli
