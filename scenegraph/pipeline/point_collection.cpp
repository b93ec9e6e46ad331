#include "scenegraph/pipeline/point_collection.h"

#include <glm/gtc/type_ptr.hpp>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Transform>
#include <ranges>

#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/point_boxes.h"

namespace stillframe::scenegraph {
namespace {

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
  [[nodiscard]] bool has(const char* name) const { return state_.getUniform(name) != nullptr; }
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

const osg::FloatArray* valuesOf(const osg::Geometry& geometry) {
  return dynamic_cast<const osg::FloatArray*>(geometry.getVertexAttribArray(kPointValueAttribute));
}

std::span<const float> spanOf(const osg::FloatArray& array) { return {array.asVector().data(), array.size()}; }

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
    if (const osg::FloatArray* const values = valuesOf(geometry)) {
      made.values = spanOf(*values);
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
    } else {
      batch.size *= pixelRatio();
    }
    batch.is_round = uniforms.get("u_round_points", false);
    if (uniforms.has("u_unit")) {
      const osg::FloatArray* const depths = valuesOf(geometry);
      if (depths == nullptr || depths->size() != vertices->size()) {
        return;
      }
      batch.depths = spanOf(*depths);
      batch.unit = uniforms.get("u_unit", 1.0F);
      batch.farthest = uniforms.get("u_max_depth", 0.0F);
    } else {
      batch.boxes = knownBoxes(*vertices);
    }
    collected.batches.push_back(batch);
    collected.arrays.push_back({.positions = vertices,
                                .rgba = geometry.getColorArray(),
                                .values = geometry.getVertexAttribArray(kPointValueAttribute)});
    collected.colors.push_back(colorsOf(geometry, uniforms));
    collected.paths.push_back(getNodePath());
    collected.count += vertices->size();
  }

  PointCollection collected;

 private:
  /// What Scene::setView() has set on its root; 1 where nobody has.
  [[nodiscard]] float pixelRatio() const {
    for (const osg::Node* const node : getNodePath()) {
      if (node->getStateSet() != nullptr && node->getStateSet()->getUniform("u_pixel_ratio") != nullptr) {
        return Uniforms(*node->getStateSet()).get("u_pixel_ratio", 1.0F);
      }
    }
    return 1.0F;
  }
  [[nodiscard]] const osg::StateSet* stateOfPath() const {
    for (const osg::Node* const node : std::views::reverse(getNodePath())) {
      const osg::StateSet* const state = node->getStateSet();
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

}  // namespace

PointCollection collectPoints(osg::Node& root, const osg::Matrixd& eye_from_fixed, const osg::Matrixd& clip_from_eye,
                              int height_px) {
  PointCollector collector(eye_from_fixed, clip_from_eye, height_px);
  root.accept(collector);
  return std::move(collector.collected);
}

}  // namespace stillframe::scenegraph
