#include "scenegraph/pipeline/point_stage.h"

#include <algorithm>
#include <chrono>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osg/Transform>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/geometry.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

/// The uniforms of one cloud's state, by name.
class Uniforms {
 public:
  explicit Uniforms(const osg::StateSet& state) : state_(state) {}

  template <typename Value>
  [[nodiscard]] Value get(const char* name, const Value& otherwise) const {
    Value value = otherwise;
    const osg::Uniform* const uniform = state_.getUniform(name);
    return uniform != nullptr && uniform->get(value) ? value : otherwise;
  }
  [[nodiscard]] glm::vec3 color(const char* name) const {
    const auto value = get(name, osg::Vec3());
    return {value.x(), value.y(), value.z()};
  }
  [[nodiscard]] std::vector<glm::vec3> colors(const char* name) const {
    std::vector<glm::vec3> found;
    const osg::Uniform* const uniform = state_.getUniform(name);
    for (unsigned i = 0; uniform != nullptr && i < uniform->getNumElements(); ++i) {
      osg::Vec3 value;
      uniform->getElement(i, value);
      found.emplace_back(value.x(), value.y(), value.z());
    }
    return found;
  }

 private:
  const osg::StateSet& state_;
};

PointColors colorsOf(const osg::Geometry& geometry, const Uniforms& uniforms) {
  PointColors made;
  made.mode = static_cast<PointColors::Mode>(uniforms.get("u_color_mode", 0));
  made.flat = uniforms.color("u_flat_color");
  made.missing = uniforms.color("u_missing_color");
  if (made.mode == PointColors::Mode::Rgb) {
    if (const auto* const bytes = dynamic_cast<const osg::Vec4ubArray*>(geometry.getColorArray())) {
      made.rgba = {static_cast<const std::uint8_t*>(bytes->getDataPointer()), bytes->size() * 4};
    }
  } else if (made.mode == PointColors::Mode::Value) {
    if (const auto* const values =
            dynamic_cast<const osg::FloatArray*>(geometry.getVertexAttribArray(kPointValueAttribute))) {
      made.values = {values->asVector().data(), values->size()};
    }
    const auto map = uniforms.get("u_value", osg::Vec2());
    made.value_map = {map.x(), map.y()};
  } else if (made.mode == PointColors::Mode::Axis) {
    const auto map = uniforms.get("u_axis", osg::Vec4());
    made.axis_map = {map.x(), map.y(), map.z(), map.w()};
  }
  if (made.mode == PointColors::Mode::Value || made.mode == PointColors::Mode::Axis) {
    made.colormap = uniforms.colors("u_colormap");
  }
  return made;
}

/// All points beneath a node, where they are, and what they look like.
class PointCollector : public osg::NodeVisitor {
 public:
  PointCollector(const osg::Matrixd& eye_from_fixed, const osg::Matrixd& clip_from_eye, int height_px)
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN),
        eye_from_here_(eye_from_fixed),
        clip_from_eye_(clip_from_eye),
        height_px_(height_px) {}

  void apply(osg::Transform& transform) override {
    const osg::Matrixd outside = eye_from_here_;
    transform.computeLocalToWorldMatrix(eye_from_here_, this);
    traverse(transform);
    eye_from_here_ = outside;
  }

  void apply(osg::Geometry& geometry) override {
    if (geometry.getNodeMask() != kOpaquePoints) {
      return;
    }
    const auto* const vertices = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    const osg::StateSet* const state = stateOfPath();
    if (vertices == nullptr || vertices->empty() || state == nullptr) {
      return;
    }
    const Uniforms uniforms(*state);
    PointBatch batch;
    batch.positions = {static_cast<const float*>(vertices->getDataPointer()), std::size_t{3} * vertices->size()};
    batch.clip_from_points = glm::make_mat4((eye_from_here_ * clip_from_eye_).ptr());
    batch.size = uniforms.get("u_point_size", 1.0F);
    batch.is_size_in_metres = uniforms.get("u_size_in_metres", false);
    if (batch.is_size_in_metres) {
      batch.size *= 0.5F * static_cast<float>(height_px_) * static_cast<float>(clip_from_eye_(1, 1));
    }
    batch.is_round = uniforms.get("u_round_points", false);
    batches.push_back(batch);
    arrays.emplace_back(vertices);
    colors.push_back(colorsOf(geometry, uniforms));
    count += vertices->size();
  }

  std::vector<PointBatch> batches;
  std::vector<osg::ref_ptr<const osg::Array>> arrays;
  std::vector<PointColors> colors;
  std::size_t count = 0;

 private:
  [[nodiscard]] const osg::StateSet* stateOfPath() const {
    for (auto node = getNodePath().rbegin(); node != getNodePath().rend(); ++node) {
      const osg::StateSet* const state = (*node)->getStateSet();
      if (state != nullptr && state->getUniform("u_color_mode") != nullptr) {
        return state;
      }
    }
    return nullptr;
  }

  osg::Matrixd eye_from_here_;
  osg::Matrixd clip_from_eye_;
  int height_px_;
};

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
      triangle_(makeGeometry()),
      color_(new osg::Image),
      depth_(new osg::Image) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back({-1.0F, -1.0F, 0.0F});
  vertices->push_back({3.0F, -1.0F, 0.0F});
  vertices->push_back({-1.0F, 3.0F, 0.0F});
  triangle_->setVertexArray(vertices);
  triangle_->addPrimitiveSet(new osg::DrawArrays{GL_TRIANGLES, 0, 3});
  triangle_->setCullingActive(false);
  triangle_->setNodeMask(0);
  osg::StateSet& state = *triangle_->getOrCreateStateSet();
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

PointProgress PointStage::draw(osg::Group& root, const osg::Matrixd& eye_from_fixed, const osg::Matrixd& clip_from_eye,
                               int width_px, int height_px, double budget_ms) {
  PointCollector collector(eye_from_fixed, clip_from_eye, height_px);
  root.accept(collector);
  triangle_->setNodeMask(collector.count > 0 ? ~0U : 0U);
  if (collector.count == 0) {
    batches_.clear();
    arrays_.clear();
    return {};
  }
  const auto start = Clock::now();
  if (collector.batches != batches_ || raster_.widthPx() != width_px || raster_.heightPx() != height_px) {
    startAnew(collector.batches, std::move(collector.arrays), width_px, height_px);
  }
  PointProgress progress{.points = collector.count};
  if (passes_ < kPassesOfSample) {
    const std::uint32_t more = affordablePasses(collector.count, budget_ms);
    const auto before = Clock::now();
    raster_.draw(batches_, {passes_, passes_ + more});
    passes_ += more;
    progress.raster_ms = milliseconds(Clock::now() - start);
    const double drawn = static_cast<double>(collector.count) * more / kPassesOfSample;
    constexpr double kNewest = 0.5;  // of the mean: soon right after a change, no slave of one slow frame
    points_per_ms_ += kNewest * (drawn / std::max(milliseconds(Clock::now() - before), 1e-3) - points_per_ms_);
  }
  progress.share = static_cast<double>(passes_) / kPassesOfSample;
  const auto drawn = Clock::now();
  resize(width_px, height_px);
  const std::size_t pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  raster_.resolve(PointShading(batches_, collector.colors),
                  {reinterpret_cast<std::uint16_t*>(color_->data()), 4 * pixels},
                  {reinterpret_cast<float*>(depth_->data()), pixels});
  color_->dirty();
  depth_->dirty();
  progress.resolve_ms = milliseconds(Clock::now() - drawn);
  return progress;
}

}  // namespace stillframe::scenegraph
