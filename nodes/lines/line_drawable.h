#pragma once

#include <osg/Geometry>
#include <osg/Texture>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include "nodes/lines/line_arrays.h"
#include "nodes/points/colormap.h"
#include "nodes/points/value_range.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Lines of any width in pixels or metres, in one draw call of stock OSG classes.
///
/// Points lie in texture buffers and the vertex shader makes a rectangle on the screen of each segment: 16 bytes a
/// point, no rewriting when the camera moves. Width, colour and range are uniforms or one texel. Joints are round,
/// without gaps or spikes, and blended once; ends are cut straight. Lines in metres face the camera, as RViz's do.
///
/// Hang geometry() beneath a MatrixTransform that holds the builder's origin. GUI thread; the arrays may be shared by
/// any number of drawables and are not written, but for the styles, which each drawable copies.
class LineDrawable {
 public:
  LineDrawable();
  [[nodiscard]] osg::Geometry* geometry() const noexcept { return geometry_.get(); }

  /// What is drawn from now on; colours by the arrays' channel, else the colour of setColor().
  void set(const LineArrays& arrays);
  /// Nothing is drawn, and nothing held.
  void clear();
  /// Replaces the style that the builder numbered so, in order of first use. Costs one texel.
  void setStyle(std::size_t index, const LineStyle& style);
  /// Of lines without a channel; sRGB. Its alpha counts, and setOpacity() besides.
  void setColor(const scenegraph::Color& color);
  /// 1 hides what is behind. `has_alpha`: the points' own alpha counts, which needs blending too.
  void setOpacity(double opacity, bool has_alpha = false);
  /// Colours of Channel::Values: `map` takes a value to 0..1 over the colormap.
  void setValueColors(const Colormap& colormap, const RangeMap& map, const scenegraph::Color& missing);

 private:
  void bind(unsigned unit, const char* sampler, osg::Array* texels, GLint format);

  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Vec4Array> styles_;
  osg::ref_ptr<osg::Uniform> batch_;
  osg::ref_ptr<osg::Uniform> point_count_;
  osg::ref_ptr<osg::Uniform> mode_;
  osg::ref_ptr<osg::Uniform> color_;
  osg::ref_ptr<osg::Uniform> opacity_;
  osg::ref_ptr<osg::Uniform> value_;
  osg::ref_ptr<osg::Uniform> colormap_;
  osg::ref_ptr<osg::Uniform> missing_color_;
  double opacity_now_ = 1.0;
  double color_alpha_ = 1.0;
  bool has_alpha_ = false;
  void blend();
};

}  // namespace stillframe::nodes
