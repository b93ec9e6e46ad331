#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/pipeline/view_pipeline.h"

namespace stillframe::scenegraph {

/// A picture as it left the last pass: linear light, top row first.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<float> rgba;                    ///< scene-linear, 4 a pixel; alpha is 1 unless has_alpha
  std::vector<float> depth_m;                 ///< metres along the view axis; +infinity where nothing was drawn
  std::vector<float> normals = {};            ///< on request: 3 a pixel, in the fixed frame; 0 where nothing was drawn
  std::vector<std::uint32_t> layer_ids = {};  ///< on request: place in layer_names, from 1; 0 where nothing was drawn
  std::vector<std::string> layer_names = {};  ///< of layer_ids
  /// The background was not opaque: alpha is what hides it, and colours are premultiplied by it.
  bool has_alpha = false;
};

/// How large, on what, and through which passes.
struct RenderOptions {
  int width = 1280;
  int height = 720;
  Color background{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};  ///< alpha below 1: the picture has alpha
  PostChain post = {};
  PointWay points = PointWay::Auto;  ///< who draws opaque points
  BlendLimits blend = {};
  PointLimits point_limits = {};  ///< how many points, where they are not drawn by OpenGL
};

/// 32 bytes a pixel are needed without passes: 2 GiB.
inline constexpr long long kMaxPicturePixels = 1LL << 26;
/// Targets and the picture read back; four samples a pixel and all passes stay below it at kMaxPicturePixels.
inline constexpr double kMaxPictureBytes = 6.0 * (1LL << 30);

/// Refuses "BadSize" (not positive) and "TooLarge" (beyond `largest_side_px`, the driver's largest texture, or the two
/// limits above).
std::expected<void, Status> checkPicture(const RenderOptions& options, int largest_side_px);

/// What `pipeline` draws from now on is drawn by these options alone, but for its size.
void takeOptions(ViewPipeline& pipeline, const RenderOptions& options);

/// Draws what `pipeline` looks at into its own targets, takeOptions() included. The context must be current, and the
/// picture checked.
std::expected<void, Status> drawPicture(ViewPipeline& pipeline, const RenderOptions& options);

/// Reads it back. Where the background is not opaque it is drawn again, on white: how much of a pixel hides the
/// background is what the two differ by, whatever made it so: blending, edges between samples, or an effect.
[[nodiscard]] std::expected<Picture, Status> readPicture(ViewPipeline& pipeline, const RenderOptions& options);

/// readPicture() in steps of half a million pixels, some ten milliseconds each, for who must answer meanwhile. Between
/// them nobody else may draw with `pipeline`, which must outlive the reader. With the context current.
class PictureReader {
 public:
  /// Of what drawPicture() has drawn by these options.
  PictureReader(ViewPipeline& pipeline, RenderOptions options);

  /// Does nothing more once isDone().
  std::expected<void, Status> step();
  [[nodiscard]] bool isDone() const noexcept { return steps_done_ == steps_; }
  /// Of the steps, 0 to 1.
  [[nodiscard]] double share() const noexcept { return static_cast<double>(steps_done_) / steps_; }
  /// The picture of all rows that have been read: the whole one when isDone().
  [[nodiscard]] Picture take() { return std::move(picture_); }

 private:
  void readBand(int band);
  void readBandOnWhite(int band);

  ViewPipeline& pipeline_;
  RenderOptions options_;
  Picture picture_;
  int rows_ = 1;   // of a band
  int bands_ = 1;  // from the top
  int steps_ = 1;
  int steps_done_ = 0;
};

}  // namespace stillframe::scenegraph
