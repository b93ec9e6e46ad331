#include "scenegraph/pipeline/point_stage.h"

#include <algorithm>
#include <chrono>
#include <osg/Texture2D>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/full_screen.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

constexpr double kFirstGuess = 2e4;  // points a millisecond, of one slow core

osg::ref_ptr<osg::Texture2D> makeTexture(const osg::ref_ptr<osg::Image>& image, GLint internal_format) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D{image};
  texture->setInternalFormat(internal_format);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setResizeNonPowerOfTwoHint(false);
  texture->setUnRefImageDataAfterApply(false);
  return texture;
}

}  // namespace

PointStage::PointStage(unsigned threads)
    : raster_(threads),
      points_per_ms_(kFirstGuess),
      triangle_(makeFullScreenTriangle(new osg::StateSet)),
      color_(new osg::Image),
      depth_(new osg::Image) {
  triangle_->setNodeMask(0);
  osg::StateSet& state = *triangle_->getStateSet();
  state.setAttributeAndModes(makeProgram("points", glsl::k_full_screen_vert, glsl::k_points_frag));
  state.setTextureAttribute(0, makeTexture(color_, GL_RGBA16F_ARB));
  state.setTextureAttribute(1, makeTexture(depth_, GL_R32F));
  state.addUniform(new osg::Uniform{"u_color", 0});
  state.addUniform(new osg::Uniform{"u_depth", 1});
  constexpr int kBeforeAll = -1000;
  state.setRenderBinDetails(kBeforeAll, "RenderBin");
}

void PointStage::resize(int width_px, int height_px) {
  if (color_->s() != width_px || color_->t() != height_px) {
    color_->allocateImage(width_px, height_px, 1, GL_RGBA, GL_HALF_FLOAT);
    depth_->allocateImage(width_px, height_px, 1, GL_RED, GL_FLOAT);
  }
}

void PointStage::startAnew(const std::vector<PointBatch>& batches, std::vector<osg::ref_ptr<const osg::Array>> arrays,
                           int width_px, int height_px) {
  raster_.begin(width_px, height_px);
  batches_ = batches;
  arrays_ = std::move(arrays);
  passes_ = 0;
}

std::uint32_t PointStage::affordablePasses(std::size_t points, double budget_ms) const {
  const double per_pass = static_cast<double>(points) / kPassesOfSample;
  const double passes = budget_ms * points_per_ms_ / per_pass;
  const std::uint32_t left = kPassesOfSample - passes_;
  return passes < left ? std::max(static_cast<std::uint32_t>(std::max(passes, 0.0)), 1U) : left;
}

PointProgress PointStage::draw(PointCollection points, int width_px, int height_px, double budget_ms) {
  triangle_->setNodeMask(points.count > 0 ? ~0U : 0U);
  if (points.count == 0) {
    batches_.clear();
    arrays_.clear();
    return {};
  }
  const auto start = Clock::now();
  if (points.batches != batches_ || raster_.widthPx() != width_px || raster_.heightPx() != height_px) {
    startAnew(points.batches, std::move(points.arrays), width_px, height_px);
  }
  PointProgress progress{.points = points.count};
  if (passes_ < kPassesOfSample) {
    const std::uint32_t more = affordablePasses(points.count, budget_ms);
    const auto before = Clock::now();
    raster_.draw(batches_, {passes_, passes_ + more});
    passes_ += more;
    progress.raster_ms = milliseconds(Clock::now() - start);
    const double drawn = static_cast<double>(points.count) * more / kPassesOfSample;
    constexpr double kNewest = 0.5;  // of the mean: soon right after a change, no slave of one slow frame
    points_per_ms_ += kNewest * (drawn / std::max(milliseconds(Clock::now() - before), 1e-3) - points_per_ms_);
  }
  progress.share = static_cast<double>(passes_) / kPassesOfSample;
  const auto drawn = Clock::now();
  resize(width_px, height_px);
  const std::size_t pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  raster_.resolve(PointShading(batches_, points.colors), {reinterpret_cast<std::uint16_t*>(color_->data()), 4 * pixels},
                  {reinterpret_cast<float*>(depth_->data()), pixels});
  color_->dirty();
  depth_->dirty();
  progress.resolve_ms = milliseconds(Clock::now() - drawn);
  return progress;
}

std::span<const std::uint64_t> PointStage::keys(PointCollection points, int width_px, int height_px) {
  if (points.batches != batches_ || raster_.widthPx() != width_px || raster_.heightPx() != height_px) {
    startAnew(points.batches, std::move(points.arrays), width_px, height_px);
    raster_.draw(batches_);
    passes_ = kPassesOfSample;
  }
  return raster_.keys();
}

}  // namespace stillframe::scenegraph
