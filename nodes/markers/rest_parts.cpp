#include "nodes/markers/rest_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "nodes/markers/entity_shapes.h"
#include "nodes/osg_math.h"
#include "nodes/primitives/triangle_area.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Color;
using scenegraph::EntityColor;
using scenegraph::LinePrimitive;
using scenegraph::LineType;
using scenegraph::SceneEntity;
using scenegraph::TrianglePrimitive;

Color toColor(const EntityColor& color) { return {color.r, color.g, color.b, color.a}; }

/// The colour of a vertex: its own where there is one.
const EntityColor& colorOf(const auto& primitive, std::size_t vertex) {
  return vertex < primitive.colors.size() ? primitive.colors[vertex] : primitive.color;
}

bool isTranslucent(const auto& primitive) {
  return primitive.colors.empty()
             ? primitive.color.a < 1.0F
             : std::ranges::any_of(primitive.colors, [](const EntityColor& color) { return color.a < 1.0F; });
}

/// Vertices in the order in which they are drawn; nullopt when an index leads nowhere.
std::optional<std::size_t> orderedCount(const auto& primitive) {
  const bool is_sound =
      std::ranges::all_of(primitive.indices, [&](std::uint32_t index) { return index < primitive.points.size(); });
  return !is_sound ? std::nullopt
                   : std::optional(primitive.indices.empty() ? primitive.points.size() : primitive.indices.size());
}

std::size_t vertexAt(const auto& primitive, std::size_t i) {
  return primitive.indices.empty() ? i : primitive.indices[i];
}

LineBuilder::Kind kindOf(LineType type) {
  switch (type) {
    case LineType::Strip:
      return LineBuilder::Kind::Strip;
    case LineType::Loop:
      return LineBuilder::Kind::Loop;
    case LineType::List:
      break;
  }
  return LineBuilder::Kind::List;
}

/// False when it cannot be drawn whole.
bool addLine(const LinePrimitive& line, LineBuilder& out) {
  const auto count = orderedCount(line);
  if (!count || !std::isfinite(line.thickness) || !tf::isFinite(line.pose)) {
    return false;
  }
  const tf::RigidTransform pose = soundPose(line.pose);
  out.begin(kindOf(line.type), {.width = std::abs(line.thickness), .in_metres = !line.is_scale_invariant});
  for (std::size_t i = 0; i < *count; ++i) {
    const std::size_t vertex = vertexAt(line, i);
    out.add(pose.rotation * line.points[vertex] + pose.translation, toBytes(toColor(colorOf(line, vertex))));
  }
  out.end();
  return true;
}

/// Axes whose thickness is in pixels.
void addAxes(const scenegraph::AxesPrimitive& axes, LineBuilder& out) {
  const tf::RigidTransform pose = soundPose(axes.pose);
  constexpr std::array<std::array<std::uint8_t, 4>, 3> kColors{
      {{235, 52, 52, 255}, {52, 200, 68, 255}, {64, 110, 255, 255}}};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 end(0.0);
    end[axis] = axes.length;
    const auto& c = kColors[static_cast<std::size_t>(axis)];
    const osg::Vec4ub color(c[0], c[1], c[2], c[3]);
    out.begin(LineBuilder::Kind::List, {.width = std::abs(axes.thickness), .in_metres = false});
    out.add(pose.translation, color);
    out.add(pose.rotation * end + pose.translation, color);
    out.end();
  }
}

/// How many triangles could not be drawn, or show nothing where none of them has an area.
std::size_t addTriangles(const TrianglePrimitive& triangles, TriangleDrawable& out) {
  const auto count = orderedCount(triangles);
  if (!count) {
    return 1;
  }
  const tf::RigidTransform pose = soundPose(triangles.pose);
  std::size_t unsound = 0;
  bool has_area = false;
  for (std::size_t i = 0; i + 2 < *count; i += 3) {
    std::array<glm::dvec3, 3> corners{};
    std::array<Color, 3> colors;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t vertex = vertexAt(triangles, i + k);
      corners[k] = pose.rotation * triangles.points[vertex] + pose.translation;
      colors[k] = toColor(colorOf(triangles, vertex));
    }
    // As RViz: colours of their own are shown as they are.
    unsound += out.add(corners, colors, triangles.colors.empty()) ? 0 : 1;
    has_area = has_area || hasArea(corners[0], corners[1], corners[2]);
  }
  return has_area ? unsound : *count / 3;
}

}  // namespace

RestParts::RestParts(const std::string& name, TextMaker& texts) : text_maker_(texts) {
  for (const std::size_t i : {0U, 1U}) {
    strokes_[i].node = new osg::MatrixTransform;
    strokes_[i].node->setName(name);
    strokes_[i].lines = std::make_unique<LineDrawable>();
    strokes_[i].node->addChild(strokes_[i].lines->geometry());
    surfaces_[i] = std::make_unique<TriangleDrawable>(name);
  }
}

void RestParts::set(std::size_t slot, std::shared_ptr<const SceneEntity> entity) {
  const auto known = entities_.find(slot);
  const auto touch = [&](const SceneEntity& changed) {
    if (!changed.models.empty() || std::ranges::any_of(changed.triangles, isTextured)) {
      models_.touch();
    }
    const bool has_axes = std::ranges::any_of(changed.axes, &scenegraph::AxesPrimitive::is_scale_invariant);
    has_new_lines_ = has_new_lines_ || !changed.lines.empty() || has_axes;
    has_new_triangles_ = has_new_triangles_ || !changed.triangles.empty();
  };
  if (known != entities_.end()) {
    touch(*known->second);
    dropTexts(slot);
    entities_.erase(known);
  }
  if (entity != nullptr) {
    touch(*entity);
    entities_.emplace(slot, std::move(entity));
    makeTexts(slot);
  }
}

void RestParts::setLook(double opacity, bool shows_texts) {
  if (shows_texts != shows_texts_ || opacity != opacity_) {
    shows_texts_ = shows_texts;
    opacity_ = opacity;
    has_new_look_ = true;
    for (const auto& [slot, entity] : entities_) {
      dropTexts(slot);
      makeTexts(slot);
    }
  }
}

void RestParts::setBufferTexels(std::uint64_t texels) {
  for (const Strokes& strokes : strokes_) {
    strokes.lines->setBufferTexels(texels);
  }
  has_new_lines_ = true;
}

std::uint64_t RestParts::texelsTooMany() const noexcept {
  return std::max(strokes_[0].lines->texelsTooMany(), strokes_[1].lines->texelsTooMany());
}

void RestParts::makeTexts(std::size_t slot) {
  const SceneEntity& entity = *entities_.at(slot);
  if (entity.texts.empty() || !shows_texts_) {
    return;
  }
  Texts made;
  made.count = entity.texts.size();
  text_count_ += made.count;
  made.node = new osg::Group;
  for (const scenegraph::TextPrimitive& text : entity.texts) {
    const tf::RigidTransform pose = soundPose(text.pose);
    const double size = std::abs(text.font_size);
    const glm::dvec3& at = pose.translation;
    const bool is_placed = tf::isFinite(pose) && std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < kReach_m;
    if (text.text.empty() || !is_placed || !(size > 0.0 && size < 1e6) || !(text.color.a > 0.0F)) {
      continue;
    }
    Color color = toColor(text.color);
    color.a *= static_cast<float>(opacity_);
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(toOsg(pose));
    place->addChild(text_maker_.make(text.text, {.height = size,
                                                 .is_in_pixels = text.is_scale_invariant,
                                                 .faces_viewer = text.is_billboard,
                                                 .is_centred = true,
                                                 .color = color}));
    made.node->addChild(place);
    const double reach = text.is_scale_invariant ? 0.0 : 0.5 * size;
    made.box.expandBy(toOsg(at - glm::dvec3(reach)));
    made.box.expandBy(toOsg(at + glm::dvec3(reach)));
  }
  texts_.emplace(slot, std::move(made));
}

void RestParts::dropTexts(std::size_t slot) {
  const auto found = texts_.find(slot);
  if (found != texts_.end()) {
    text_count_ -= found->second.count;
    texts_.erase(found);
  }
}

void RestParts::makeLines() {
  unsound_lines_ = 0;
  lines_box_.init();
  // Relative to the first point: lines far from the frame's origin keep their millimetres.
  std::optional<glm::dvec3> origin;
  for (const auto& [slot, entity] : entities_) {
    for (const LinePrimitive& line : entity->lines) {
      if (!origin && !line.points.empty()) {
        const tf::RigidTransform pose = soundPose(line.pose);
        const glm::dvec3 first = pose.rotation * line.points.front() + pose.translation;
        origin = glm::length(first) < kReach_m ? std::optional(glm::round(first)) : std::nullopt;
      }
    }
  }
  const glm::dvec3 at = origin.value_or(glm::dvec3(0.0));
  for (const std::size_t i : {0U, 1U}) {
    Strokes& strokes = strokes_[i];
    LineBuilder builder(at, LineBuilder::Channel::Colors);
    strokes.ends.clear();
    for (const auto& [slot, entity] : entities_) {
      for (const LinePrimitive& line : entity->lines) {
        if (isTranslucent(line) == (i == 1)) {
          unsound_lines_ += addLine(line, builder) ? 0 : 1;
        }
      }
      for (const scenegraph::AxesPrimitive& axes : entity->axes) {
        if (axes.is_scale_invariant && i == 0) {
          addAxes(axes, builder);
        }
      }
      strokes.ends.emplace_back(builder.size(), slot);
    }
    const LineArrays arrays = builder.take();
    unsound_lines_ += arrays.not_finite + arrays.out_of_reach;
    strokes.lines->set(arrays);
    strokes.is_drawn = arrays.segments > 0 && strokes.lines->texelsTooMany() == 0;
    strokes.node->setMatrix(osg::Matrixd::translate(toOsg(at)));
    if (strokes.is_drawn) {
      lines_box_.expandBy(toOsg(at) + arrays.box._min);
      lines_box_.expandBy(toOsg(at) + arrays.box._max);
    }
  }
}

void RestParts::makeTriangles() {
  unsound_triangles_ = 0;
  for (const std::size_t i : {0U, 1U}) {
    TriangleDrawable& surface = *surfaces_[i];
    surface.clear();
    surface_ends_[i].clear();
    for (const auto& [slot, entity] : entities_) {
      for (const TrianglePrimitive& triangles : entity->triangles) {
        if (!isTextured(triangles) && isTranslucent(triangles) == (i == 1)) {
          unsound_triangles_ += addTriangles(triangles, surface);
        }
      }
      surface_ends_[i].emplace_back(surface.size(), slot);
    }
    surface.commit();
  }
}

void RestParts::commit() {
  models_.commit(entities_);
  if (has_new_lines_) {
    makeLines();
  }
  if (has_new_triangles_) {
    makeTriangles();
  }
  if (has_new_look_) {
    models_.setOpacity(opacity_);
    for (const std::size_t i : {0U, 1U}) {
      strokes_[i].lines->setOpacity(opacity_, i == 1);
      surfaces_[i]->setOpacity(opacity_);
      surfaces_[i]->setBlended(i == 1 || opacity_ < 1.0);
    }
  }
  has_new_lines_ = has_new_triangles_ = has_new_look_ = false;
  unsound_ = unsound_lines_ + unsound_triangles_ + models_.unsound();
  box_ = lines_box_;
  box_.expandBy(models_.box());
  for (const auto& surface : surfaces_) {
    box_.expandBy(surface->box());
  }
  // The first so many are drawn, by slot: which ones does not depend on what came before.
  std::size_t left = kMostTexts;
  texts_left_out_ = 0;
  for (const auto& [slot, texts] : texts_) {
    const bool is_drawn = texts.count <= left;
    left -= is_drawn ? texts.count : left;
    texts_left_out_ += is_drawn ? 0 : texts.count;
    texts.node->setNodeMask(is_drawn ? ~0U : 0U);
    box_.expandBy(texts.box);
  }
}

void RestParts::list(std::vector<osg::Node*>& nodes) const {
  for (const std::size_t i : {0U, 1U}) {
    if (strokes_[i].is_drawn) {
      nodes.push_back(strokes_[i].node);
    }
    if (surfaces_[i]->size() > 0) {
      nodes.push_back(&surfaces_[i]->node());
    }
  }
  if (models_.size() > 0) {
    nodes.push_back(&models_.node());
  }
  for (const auto& [slot, texts] : texts_) {
    nodes.push_back(texts.node);
  }
}

std::size_t RestParts::drawCalls() const noexcept {
  std::size_t calls = text_count_ + models_.size();
  for (const std::size_t i : {0U, 1U}) {
    calls += (strokes_[i].is_drawn ? 1U : 0U) + (surfaces_[i]->size() > 0 ? 1U : 0U);
  }
  return calls;
}

}  // namespace stillframe::nodes
