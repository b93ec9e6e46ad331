#include "scenegraph/pipeline/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "scenegraph/srgb.h"

namespace stillframe::scenegraph {
namespace {

constexpr Color kBlack{.r = 0.0F, .g = 0.0F, .b = 0.0F, .a = 1.0F};
constexpr Color kWhite{.r = 1.0F, .g = 1.0F, .b = 1.0F, .a = 1.0F};

/// Metres in front of the eye for a depth of [0, 1], whatever the projection.
class MetresFromDepth {
 public:
  explicit MetresFromDepth(const glm::dmat4& clip_from_eye)
      : zz_(clip_from_eye[2][2]), zw_(clip_from_eye[3][2]), wz_(clip_from_eye[2][3]), ww_(clip_from_eye[3][3]) {}
  [[nodiscard]] float operator()(float depth) const {
    if (!(depth > 0.0F)) {
      return std::numeric_limits<float>::infinity();
    }
    // depth = (zz z + zw) / (wz z + ww), solved for -z.
    const double d = static_cast<double>(depth);
    return static_cast<float>((d * ww_ - zw_) / (d * wz_ - zz_));
  }

 private:
  double zz_, zw_, wz_, ww_;
};

constexpr std::size_t kPixelsAStep = std::size_t{1} << 19;

/// Appends rows of one length, the last one first.
void appendFlipped(const std::vector<float>& values, std::size_t rows, std::vector<float>& to) {
  const auto stride = static_cast<std::ptrdiff_t>(values.size() / rows);
  for (auto row = values.end(); row != values.begin(); row -= stride) {
    to.insert(to.end(), row - stride, row);
  }
}

/// `rgba` on black and `on_white` become premultiplied colours over `background`, itself premultiplied by its alpha.
void findAlpha(std::span<float> rgba, const std::vector<float>& on_white, const Color& background) {
  const std::array<float, 3> behind{linearFromSrgb(background.r), linearFromSrgb(background.g),
                                    linearFromSrgb(background.b)};
  const float behind_alpha = std::clamp(background.a, 0.0F, 1.0F);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
    // The channel that hides most: where light is clipped, the others may hide less.
    float seen = 1.0F;
    for (std::size_t c = i; c < i + 3; ++c) {
      seen = std::min(seen, std::clamp(on_white[c] - rgba[c], 0.0F, 1.0F));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      rgba[i + c] += seen * behind_alpha * behind.at(c);
    }
    rgba[i + 3] = 1.0F - seen + seen * behind_alpha;
  }
}

}  // namespace

std::expected<void, Status> checkPicture(const RenderOptions& options, int largest_side_px) {
  const std::string size = std::to_string(options.width) + "x" + std::to_string(options.height);
  if (options.width <= 0 || options.height <= 0) {
    return std::unexpected(
        Status{StatusLevel::Error, "BadSize", "a picture of " + size + " pixels has no area; give at least 1x1"});
  }
  if (options.width > largest_side_px || options.height > largest_side_px ||
      static_cast<long long>(options.width) * options.height > kMaxPicturePixels) {
    return std::unexpected(Status{StatusLevel::Error, "TooLarge",
                                  "a picture of " + size + " pixels is too large: at most " +
                                      std::to_string(largest_side_px) + " on a side and " +
                                      std::to_string(kMaxPicturePixels) + " in all"});
  }
  constexpr int kReadBackBytes = 20;  // colour and depth in floats
  const double bytes = (bytesPerPixel(options.post) + kReadBackBytes) * options.width * options.height;
  if (bytes > kMaxPictureBytes) {
    return std::unexpected(Status{StatusLevel::Error, "TooLarge",
                                  "a picture of " + size + " pixels with these passes needs " +
                                      std::to_string(std::llround(bytes / (1LL << 20))) + " MiB, at most " +
                                      std::to_string(std::llround(kMaxPictureBytes / (1LL << 20))) +
                                      " are taken; make it smaller or take fewer samples"});
  }
  return {};
}

void takeOptions(ViewPipeline& pipeline, const RenderOptions& options) {
  pipeline.setBackground(options.background.a < 1.0F ? kBlack : options.background);
  pipeline.setPointWay(options.points);
  pipeline.setBlendLimits(options.blend);
  pipeline.setPointLimits(options.point_limits);
  pipeline.setPostChain(options.post);
}

std::expected<void, Status> drawPicture(ViewPipeline& pipeline, const RenderOptions& options) {
  takeOptions(pipeline, options);
  return pipeline.renderLinear(options.width, options.height);
}

PictureReader::PictureReader(ViewPipeline& pipeline, RenderOptions options)
    : pipeline_(pipeline),
      options_(std::move(options)),
      rows_(static_cast<int>(std::max<std::size_t>(1, kPixelsAStep / static_cast<std::size_t>(options_.width)))),
      bands_((options_.height + rows_ - 1) / rows_) {
  const bool has_alpha = options_.background.a < 1.0F;
  const std::size_t pixels = static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(options_.height);
  steps_ = has_alpha ? 2 * bands_ + 1 : bands_;
  picture_ = {.width = options_.width, .height = options_.height, .rgba = {}, .depth_m = {}, .has_alpha = has_alpha};
  picture_.rgba.reserve(4 * pixels);
  picture_.depth_m.reserve(pixels);
}

std::expected<void, Status> PictureReader::step() {
  if (isDone()) {
    return {};
  }
  if (steps_done_ < bands_) {
    readBand(steps_done_);
  } else if (steps_done_ > bands_) {
    readBandOnWhite(steps_done_ - bands_ - 1);
  } else {
    pipeline_.setBackground(kWhite);
    if (const auto drawn = pipeline_.renderLinear(options_.width, options_.height); !drawn) {
      return std::unexpected(drawn.error());
    }
  }
  ++steps_done_;
  return {};
}

void PictureReader::readBand(int band) {
  const int rows = std::min(rows_, options_.height - band * rows_);
  const int from_below = options_.height - band * rows_ - rows;
  const auto count = static_cast<std::size_t>(rows);
  const std::size_t first = picture_.rgba.size();
  appendFlipped(pipeline_.readColor(from_below, rows), count, picture_.rgba);
  if (!picture_.has_alpha) {
    for (std::size_t i = first + 3; i < picture_.rgba.size(); i += 4) {
      picture_.rgba[i] = 1.0F;  // in the target it is the share that is data
    }
  }
  std::vector<float> depth = pipeline_.readDepth(from_below, rows);
  std::ranges::transform(depth, depth.begin(), MetresFromDepth{pipeline_.projectionMatrix()});
  appendFlipped(depth, count, picture_.depth_m);
}

void PictureReader::readBandOnWhite(int band) {
  const int rows = std::min(rows_, options_.height - band * rows_);
  std::vector<float> on_white;
  appendFlipped(pipeline_.readColor(options_.height - band * rows_ - rows, rows), static_cast<std::size_t>(rows),
                on_white);
  const std::size_t row_floats = std::size_t{4} * static_cast<std::size_t>(options_.width);
  findAlpha(std::span(picture_.rgba).subspan(row_floats * static_cast<std::size_t>(band * rows_), on_white.size()),
            on_white, options_.background);
}

std::expected<Picture, Status> readPicture(ViewPipeline& pipeline, const RenderOptions& options) {
  PictureReader reader(pipeline, options);
  while (!reader.isDone()) {
    if (const auto done = reader.step(); !done) {
      return std::unexpected(done.error());
    }
  }
  return reader.take();
}

}  // namespace stillframe::scenegraph
