#include "tools/accuracy/post_accuracy.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string_view>

#include "scenegraph/passes/view_effects.h"
#include "scenegraph/stopwatch.h"
#include "tools/accuracy/post_scene.h"
#include "tools/accuracy/svg_plot.h"

namespace stillframe::accuracy {
namespace {

using scenegraph::Picture;
using scenegraph::PostChain;
using scenegraph::SettingTexts;
using scenegraph::Status;
using scenegraph::TargetFormat;
using scenegraph::ViewEffects;

constexpr int kWidth = 640;
constexpr int kHeight = 360;
constexpr double kStep = 1.0 / 255.0;       // of a byte: what nobody sees
constexpr double kUnnoticed = 1.6 * kStep;  // as noise from pixel to pixel
constexpr std::array<const char*, 3> kRadii{"0.25", "0.5", "1"};

/// A chain to be measured; the place of its curve in the legend.
struct Way {
  std::string subject;
  std::string name;
  std::size_t series = 0;
  PostChain chain = {};
};

/// Curves, the same in every panel.
constexpr std::array<const char*, 7> kSeries{
    "occlusion, smoothed", "half resolution", "unsmoothed", "EDL", "formats", "FXAA, MSAA", "SSAA"};

PostChain chainOf(const char* effect, const SettingTexts& settings) {
  ViewEffects effects;
  effects.setOn(effect, true);
  (void)effects.apply(effect, settings);
  return effects.chain();
}

/// Through a tone curve, as a picture with effects is seen: it brings out what a format lacks in the dark, and
/// R11G11B10F has nowhere to say what is not to be graded.
PostChain withFormat(TargetFormat format) {
  ViewEffects effects;
  effects.setOn("edl", true);
  effects.setOn("tonemap", true);
  (void)effects.apply("tonemap", {{"curve", "aces"}, {"exposure", "-0.5"}});
  PostChain chain = effects.chain();
  chain.scene_format = format;
  for (auto& pass : chain.passes) {
    pass.format = format;
  }
  return chain;
}

std::string ssaoSubject(const std::string& radius) { return "ambient occlusion, radius " + radius + " m"; }

std::vector<Way> ways() {
  std::vector<Way> ways;
  for (const char* radius : kRadii) {
    for (const auto& [series, half, smooth] : {std::tuple{std::size_t{0}, "false", "true"},
                                               {std::size_t{1}, "true", "true"},
                                               {std::size_t{2}, "false", "false"}}) {
      for (const char* samples : {"4", "8", "16", "32", "64", "128"}) {
        ways.push_back(
            {ssaoSubject(radius),
             std::string(samples) + " samples" +
                 (series == 1   ? ", half resolution"
                  : series == 2 ? ", not smoothed"
                                : ""),
             series,
             chainOf("ssao",
                     {{"radius", radius}, {"samples", samples}, {"half_resolution", half}, {"smoothing", smooth}})});
      }
    }
  }
  for (const char* neighbours : {"4", "8", "16", "32", "64"}) {
    ways.push_back({"eye-dome lighting", std::string(neighbours) + " neighbours", 3,
                    chainOf("edl", {{"neighbours", neighbours}})});
  }
  ways.push_back({"target formats", "RGBA8", 4, withFormat(TargetFormat::Rgba8)});
  ways.push_back({"target formats", "R11G11B10F", 4, withFormat(TargetFormat::R11G11B10F)});
  ways.push_back({"target formats", "RGBA16F", 4, withFormat(TargetFormat::Rgba16F)});
  ways.push_back({"target formats", "RGBA32F", 4, withFormat(TargetFormat::Rgba32F)});
  ways.push_back({"anti-aliasing", "none", 5});
  ways.push_back({"anti-aliasing", "fxaa", 5, chainOf("aa", {{"mode", "fxaa"}})});
  for (const char* samples : {"2", "4", "8"}) {
    ways.push_back({"anti-aliasing", "msaa, " + std::string(samples) + " samples", 5,
                    chainOf("aa", {{"mode", "msaa"}, {"samples", samples}})});
  }
  for (const char* samples : {"2", "4", "8", "16"}) {
    ways.push_back({"anti-aliasing", "ssaa, " + std::string(samples) + " samples", 6,
                    chainOf("aa", {{"mode", "ssaa"}, {"samples", samples}})});
  }
  return ways;
}

PostChain referenceOf(const std::string& subject) {
  for (const char* radius : kRadii) {
    if (subject == ssaoSubject(radius)) {
      return chainOf("ssao", {{"radius", radius}, {"samples", "1024"}, {"smoothing", "false"}});
    }
  }
  if (subject == "eye-dome lighting") {
    return chainOf("edl", {{"neighbours", "128"}});
  }
  return subject == "target formats" ? withFormat(TargetFormat::Rgba32F)
                                     : chainOf("aa", {{"mode", "ssaa"}, {"samples", "64"}});
}

/// Draws, and knows how long it took at best.
class Meter {
 public:
  explicit Meter(scenegraph::OffscreenRenderer& renderer) : renderer_(renderer), scene_(makePostScene()) {}

  [[nodiscard]] std::expected<Picture, Status> draw(const PostChain& chain) {
    return renderer_.render(
        *scene_, postSceneView(),
        {.width = kWidth, .height = kHeight, .background = {0.12F, 0.13F, 0.15F, 1.0F}, .post = chain});
  }
  [[nodiscard]] int samples() const { return renderer_.lastFrame().samples; }
  /// Shortest of as many frames as `seconds` allow, three at least, after one that makes what is made once.
  [[nodiscard]] double frameMs(const PostChain& chain, double seconds) {
    double best = std::numeric_limits<double>::infinity();
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 4 || scenegraph::secondsSince(start) < seconds; ++i) {
      if (draw(chain) && i > 0) {
        best = std::min(best, renderer_.lastFrame().frame_ms);
      }
    }
    return best;
  }

 private:
  scenegraph::OffscreenRenderer& renderer_;
  osg::ref_ptr<osg::Group> scene_;
};

void compare(const Picture& picture, const Picture& reference, PostRow& row) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < reference.rgba.size(); ++i) {
    if (i % 4 == 3) {
      continue;
    }
    // Light beyond white is white in the end; errors there are counted no further.
    const double error = std::abs(static_cast<double>(std::min(picture.rgba[i], 1.0F)) -
                                  static_cast<double>(std::min(reference.rgba[i], 1.0F)));
    sum += error * error;
    row.max_error = std::max(row.max_error, error);
    ++count;
  }
  row.rmse = std::sqrt(sum / static_cast<double>(count));
}

std::string tableOf(const std::vector<PostRow>& rows) {
  std::string table;
  std::string subject;
  for (const PostRow& row : rows) {
    if (row.subject != subject) {
      subject = row.subject;
      table += "\n### " + subject +
               "\n\n| way | RMSE | largest error | frame (ms) | of it the effect (ms) |\n|---|--:|--:|--:|--:|\n";
    }
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(), "| %s | %.2e | %.3f | %.2f | %.2f |\n", row.way.c_str(), row.rmse,
                  row.max_error, row.frame_ms, row.extra_ms);
    table += line.data();
  }
  return table;
}

std::string plotOf(const std::vector<PostRow>& rows, const std::vector<Way>& all, const std::string& renderer) {
  PlotFigure figure;
  figure.title = "Post passes: error against run time";
  figure.caption = "On " + renderer + ", " + std::to_string(kWidth) + "x" + std::to_string(kHeight) +
                   ". Each curve: samples or neighbours growing from left to right. Hollow: no error.";
  figure.x_label = "time of the whole frame (ms)";
  figure.y_label = "RMSE of linear light, white = 1";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (figure.panels.empty() || figure.panels.back().title != rows[i].subject) {
      PlotPanel panel{.title = rows[i].subject, .series = {}};
      for (const char* name : kSeries) {
        panel.series.push_back({name, {}});
      }
      figure.panels.push_back(std::move(panel));
    }
    figure.panels.back().series[all[i].series].points.push_back({rows[i].frame_ms, rows[i].rmse});
  }
  return renderSvg(figure);
}

/// The first way of a subject that is no further off than `limit`; its last where none is. Ways come in the order of
/// what they cost by their nature, so that the choice does not hang on the noise of times.
const PostRow& firstWithin(const std::vector<PostRow>& rows, const std::string& subject, double limit,
                           const std::string& ending = "") {
  const PostRow* last = nullptr;
  for (const PostRow& row : rows) {
    if (row.subject == subject && row.way.ends_with(ending)) {
      last = &row;
      if (row.rmse <= limit) {
        break;
      }
    }
  }
  return *last;
}

double rmseOf(const std::vector<PostRow>& rows, const std::string& subject, const std::string& way) {
  const auto found =
      std::ranges::find_if(rows, [&](const PostRow& row) { return row.subject == subject && row.way == way; });
  return found == rows.end() ? 0.0 : found->rmse;
}

/// What the curves say the defaults should be, and what they are.
std::string argumentOf(const std::vector<PostRow>& rows) {
  std::string text = "\n### Defaults\n\n";
  const auto line = [&](const std::string& subject, double limit, const std::string& rule, const std::string& in_use,
                        const std::string& ending = "") {
    const PostRow& row = firstWithin(rows, subject, limit, ending);
    std::array<char, 32> error{};
    std::snprintf(error.data(), error.size(), "%.1e", row.rmse);
    text +=
        "- " + subject + ": " + rule + " is **" + row.way + "** (RMSE " + error.data() + "); in use: " + in_use + ".\n";
  };
  const ViewEffects effects;
  const SettingTexts ssao = effects.settings("ssao");
  for (const char* radius : kRadii) {
    line(ssaoSubject(radius), kUnnoticed,
         "smoothing errs more than it saves; without, the fewest within 1.6 steps of a byte",
         ssao.at("samples") + " samples" + (ssao.at("smoothing") == "true" ? "" : ", not smoothed"), ", not smoothed");
  }
  line("eye-dome lighting", kUnnoticed, "the fewest within 1.6 steps of a byte",
       effects.settings("edl").at("neighbours") + " neighbours");
  line("target formats", 0.25 * kStep, "the fewest bytes within a quarter of a step, as passes add up", "RGBA16F");
  const SettingTexts aa = effects.settings("aa");
  line("anti-aliasing", 0.5 * rmseOf(rows, "anti-aliasing", "none"), "the first that halves the error of none",
       aa.at("mode") + ", " + aa.at("samples") + " samples");
  return text;
}

std::string headOf(const std::string& renderer) {
  return "# Post passes: error against run time\n\nMeasured " + dateOfToday() + " on " + renderer + ", pictures of " +
         std::to_string(kWidth) + "x" + std::to_string(kHeight) +
         ", by `stillframe accuracy post`. Errors are of linear light, white = 1 (a step of a byte is 3.9e-3); times "
         "are the shortest of several "
         "frames, with the GPU drained. References: ambient occlusion by 1024 samples at full resolution without "
         "smoothing, eye-dome lighting by 128 "
         "neighbours, 32-bit float targets, and 64 samples of the whole picture. Target formats are compared behind "
         "eye-dome lighting and the ACES-like curve at -0.5 EV; R11G11B10F has no alpha, so that all of a picture "
         "counts as data and is left ungraded. Light beyond white counts as white.\n";
}

}  // namespace

std::expected<PostReport, Status> postAccuracy(scenegraph::OffscreenRenderer& renderer, double seconds) {
  Meter meter(renderer);
  const std::vector<Way> all = ways();
  PostReport result;
  std::string subject;
  std::optional<Picture> reference;
  const double each = seconds / static_cast<double>(all.size());
  double plain_ms = meter.frameMs({}, each);
  for (const Way& way : all) {
    if (way.subject != subject) {
      subject = way.subject;
      auto drawn = meter.draw(referenceOf(subject));
      if (!drawn) {
        return std::unexpected(drawn.error());
      }
      reference = std::move(*drawn);
      plain_ms = std::min(plain_ms, meter.frameMs({}, each));
    }
    const auto picture = meter.draw(way.chain);
    if (!picture) {
      return std::unexpected(picture.error());
    }
    PostRow row{.subject = subject, .way = way.name};
    if (way.chain.msaa_samples > meter.samples()) {
      row.way += " (the driver has " + std::to_string(meter.samples()) + ")";
    }
    compare(*picture, *reference, row);
    row.frame_ms = meter.frameMs(way.chain, each);
    row.extra_ms = std::max(0.0, row.frame_ms - plain_ms);
    result.rows.push_back(std::move(row));
  }
  const std::string name = renderer.context().info().renderer;
  result.report.name = "post";
  result.report.table = headOf(name) + tableOf(result.rows) + argumentOf(result.rows);
  result.report.svg = plotOf(result.rows, all, name);
  return result;
}

}  // namespace stillframe::accuracy
