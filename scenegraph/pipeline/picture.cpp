#include "scenegraph/pipeline/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// Top row first, in place.
void flipRows(std::vector<float>& values, std::size_t rows) {
  const auto stride = static_cast<std::ptrdiff_t>(values.size() / rows);
  for (auto low = values.begin(), high = values.end() - stride; low < high; low += stride, high -= stride) {
    std::swap_ranges(low, low + stride, high);
  }
}

/// `rgba` on black and `on_white` become premultiplied colours over `background`, itself premultiplied by its alpha.
void findAlpha(std::vector<float>& rgba, const std::vector<float>& on_white, const Color& background) {
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

std::expected<void, Status> drawPicture(ViewPipeline& pipeline, const RenderOptions& options) {
  pipeline.setBackground(options.background.a < 1.0F ? kBlack : options.background);
  pipeline.setPointWay(options.points);
  pipeline.setBlendLimits(options.blend);
  pipeline.setPointLimits(options.point_limits);
  pipeline.setPostChain(options.post);
  return pipeline.renderLinear(options.width, options.height);
}

std::expected<Picture, Status> readPicture(ViewPipeline& pipeline, const RenderOptions& options) {
  LinearFrame frame = pipeline.readLinear();
  const bool has_alpha = options.background.a < 1.0F;
  if (has_alpha) {
    pipeline.setBackground(kWhite);
    if (const auto drawn = pipeline.renderLinear(options.width, options.height); !drawn) {
      return std::unexpected(drawn.error());
    }
    findAlpha(frame.rgba, pipeline.readLinear().rgba, options.background);
  } else {
    for (std::size_t i = 3; i < frame.rgba.size(); i += 4) {
      frame.rgba[i] = 1.0F;  // in the target it is the share that is data
    }
  }
  Picture picture{.width = options.width,
                  .height = options.height,
                  .rgba = std::move(frame.rgba),
                  .depth_m = std::move(frame.depth),
                  .has_alpha = has_alpha};
  const auto rows = static_cast<std::size_t>(options.height);
  flipRows(picture.rgba, rows);
  flipRows(picture.depth_m, rows);
  std::ranges::transform(picture.depth_m, picture.depth_m.begin(), MetresFromDepth{pipeline.projectionMatrix()});
  return picture;
}

}  // namespace stillframe::scenegraph
