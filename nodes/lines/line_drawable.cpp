#include "nodes/lines/line_drawable.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <osg/PrimitiveSet>
#include <osg/StateSet>
#include <osg/TextureBuffer>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/texel_formats.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

/// Segments an instance, at most: measured on llvmpipe, more gain nothing and make an exported file longer.
constexpr std::size_t kMostInBatch = 256;
constexpr std::size_t kLeastInBatch = 2;  // eight vertices, for the corners of the bound

constexpr unsigned kPointsUnit = 0;
constexpr unsigned kStylesUnit = 1;
constexpr unsigned kChannelUnit = 2;

// How it is coloured, as the shader knows it.
constexpr int kOneColor = 0;
constexpr int kColors = 1;
constexpr int kValues = 2;

}  // namespace

LineDrawable::LineDrawable()
    : geometry_(scenegraph::makeGeometry()),
      batch_(new osg::Uniform("u_batch", 1)),
      point_count_(new osg::Uniform("u_point_count", 0)),
      blends_(new osg::Uniform("u_blends", false)),
      opacity_(new osg::Uniform("u_opacity", 1.0F)),
      depth_pull_(new osg::Uniform("u_depth_pull", 0.0F)),
      coloring_(*geometry_->getOrCreateStateSet()) {
  namespace shaders = shaders::stillframe_nodes;
  osg::StateSet& state = *geometry_->getOrCreateStateSet();
  state.setAttributeAndModes(scenegraph::makeProgram("polyline", shaders::k_polyline_vert, shaders::k_polyline_frag));
  for (const auto& uniform : {batch_, point_count_, blends_, opacity_, depth_pull_}) {
    state.addUniform(uniform);
  }
  coloring_.setFlatColor({});
  geometry_->setName("lines");
}

void LineDrawable::clear() { set({}); }

void LineDrawable::bind(unsigned unit, const char* sampler, osg::Array* texels, GLint format) {
  osg::StateSet& state = *geometry_->getOrCreateStateSet();
  osg::ref_ptr<osg::TextureBuffer> texture = new osg::TextureBuffer(texels);
  texture->setInternalFormat(format);
  state.setTextureAttribute(unit, texture);
  state.getOrCreateUniform(sampler, osg::Uniform::SAMPLER_BUFFER)->set(static_cast<int>(unit));
}

void LineDrawable::set(const LineArrays& arrays) {
  osg::StateSet& state = *geometry_->getOrCreateStateSet();
  for (const unsigned unit : {kPointsUnit, kStylesUnit, kChannelUnit}) {
    state.removeTextureAttribute(unit, osg::StateAttribute::TEXTURE);
  }
  for (const char* const sampler : {"u_points", "u_styles", "u_colors", "u_values"}) {
    state.removeUniform(sampler);
  }
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setVertexArray(nullptr);
  geometry_->dirtyBound();
  styles_ = points_ = nullptr;
  const std::uint64_t needed =
      arrays.segments == 0 ? 0 : std::max<std::uint64_t>(arrays.points->size(), arrays.styles->size());
  texels_too_many_ = needed > buffer_texels_ ? needed : 0;
  if (arrays.segments == 0 || texels_too_many_ > 0) {
    return;
  }
  points_ = arrays.points;
  styles_ = new osg::Vec4Array(arrays.styles->begin(), arrays.styles->end());
  bind(kPointsUnit, "u_points", arrays.points, kRgba32f);
  bind(kStylesUnit, "u_styles", styles_, kRgba32f);
  if (arrays.colors.valid()) {
    bind(kChannelUnit, "u_colors", arrays.colors, kRgba8);
  } else if (arrays.values.valid()) {
    bind(kChannelUnit, "u_values", arrays.values, kR32f);
  }
  mode_ = arrays.colors.valid() ? kColors : arrays.values.valid() ? kValues : kOneColor;
  coloring_.setMode(mode_, map_);
  blend();

  const std::size_t pairs = arrays.points->size() - 1;
  const std::size_t batch = std::clamp(std::bit_ceil(pairs), kLeastInBatch, kMostInBatch);
  // The vertices only hold the bound: the shader goes by their number.
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
  for (std::size_t i = 0; i < 4 * batch; ++i) {
    vertices->push_back(osg::Vec3(arrays.box.corner(static_cast<unsigned>(i % 8))));
  }
  for (std::size_t i = 0; i < batch; ++i) {
    for (const std::size_t corner : {0U, 2U, 1U, 1U, 2U, 3U}) {
      triangles->push_back(static_cast<GLushort>(4 * i + corner));
    }
  }
  triangles->setNumInstances(static_cast<int>((pairs + batch - 1) / batch));
  geometry_->setVertexArray(vertices);
  geometry_->addPrimitiveSet(triangles);
  batch_->set(static_cast<int>(batch));
  point_count_->set(static_cast<int>(arrays.points->size()));
}

void LineDrawable::setStyle(std::size_t index, const LineStyle& style) {
  if (!styles_.valid() || index >= styles_->size()) {
    return;
  }
  const osg::Vec4 texel = styleTexel(style);
  if ((*styles_)[index] != texel) {
    (*styles_)[index] = texel;
    styles_->dirty();
  }
}

void LineDrawable::setColor(const scenegraph::Color& color) {
  coloring_.setFlatColor(color);
  color_alpha_ = color.a;
  blend();
}

void LineDrawable::setOpacity(double opacity, bool has_alpha) {
  opacity_now_ = opacity;
  has_alpha_ = has_alpha;
  blend();
}

void LineDrawable::setDepthPull(double half_widths) { depth_pull_->set(static_cast<float>(half_widths)); }

void LineDrawable::setValueColors(const std::string& colormap, const RangeMap& map, const scenegraph::Color& missing) {
  map_ = map;
  coloring_.setColormap(colormap);
  coloring_.setMissingColor(missing);
  coloring_.setMode(mode_, map_);
}

std::optional<LineDrawable::SegmentHit> LineDrawable::segmentAt(const scenegraph::PickHit& hit) const {
  int batch = 1;
  batch_->get(batch);
  // Two triangles a segment.
  const std::size_t end = std::size_t{hit.instance} * static_cast<std::size_t>(batch) + hit.primitive / 2 + 1;
  if (!points_.valid() || end >= points_->size()) {
    return std::nullopt;
  }
  const auto at = [&](std::size_t i) {
    const osg::Vec4& point = (*points_)[i];
    const osg::Vec3d in_frame = osg::Vec3d(point.x(), point.y(), point.z()) * hit.frame_from_local;
    return glm::dvec3(in_frame.x(), in_frame.y(), in_frame.z());
  };
  // The nearest points of two lines, on the segment clamped to its ends.
  const glm::dvec3 start = at(end - 1);
  const glm::dvec3 way = at(end) - start;
  const glm::dvec3 sight = glm::normalize(hit.ray_in_frame.direction);
  const glm::dvec3 across = way - glm::dot(way, sight) * sight;
  const glm::dvec3 to_ray = hit.ray_in_frame.origin - start;
  const double square = glm::dot(across, across);
  const double t = square > 0.0 ? std::clamp(glm::dot(to_ray, across) / square, 0.0, 1.0) : 0.0;
  return SegmentHit{end, t > 0.5, start + t * way};
}

void LineDrawable::blend() {
  const double opacity = opacity_now_ * (mode_ == kOneColor ? color_alpha_ : 1.0);
  const bool blends = opacity < 1.0 || has_alpha_;
  opacity_->set(static_cast<float>(opacity));
  blends_->set(blends);
  scenegraph::setBlended(*geometry_->getOrCreateStateSet(), blends);
}

}  // namespace stillframe::nodes
