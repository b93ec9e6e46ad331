#pragma once

#include <cstdint>
#include <optional>
#include <osg/Geometry>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <string>

#include "nodes/coloring_state.h"
#include "nodes/lines/line_arrays.h"
#include "nodes/points/value_range.h"
#include "scenegraph/layer.h"
#include "scenegraph/pick/pick_hit.h"
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

  /// What the driver takes in one texture buffer; lines that need more are not drawn by the next set().
  void setBufferTexels(std::uint64_t texels) { buffer_texels_ = texels; }
  /// What those of the last set() need, where that is more than the driver takes; else 0.
  [[nodiscard]] std::uint64_t texelsTooMany() const noexcept { return texels_too_many_; }
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
  /// Draws as if so many half widths nearer, so that both halves of a line that lies on a surface are seen: 4 does
  /// for surfaces that are seen under 15 degrees and more. 0 is exact.
  void setDepthPull(double half_widths);
  /// Colours of Channel::Values: `map` takes a value to 0..1 over the colormap of that name.
  void setValueColors(const std::string& colormap, const RangeMap& map, const scenegraph::Color& missing);
  /// The segment that is hit, by the number of the point where it ends (in LineArrays::points), and where on it, in the
  /// frame of the parent of the node above: the nearest point to the line of sight.
  struct SegmentHit {
    std::size_t end = 0;
    bool is_nearer_to_end = false;
    glm::dvec3 point_in_frame{0.0};
  };
  [[nodiscard]] std::optional<SegmentHit> segmentAt(const scenegraph::PickHit& hit) const;

 private:
  void blend();
  void bind(unsigned unit, const char* sampler, osg::Array* texels, GLint format);

  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Vec4Array> points_;
  osg::ref_ptr<osg::Vec4Array> styles_;
  osg::ref_ptr<osg::Uniform> batch_;
  osg::ref_ptr<osg::Uniform> point_count_;
  osg::ref_ptr<osg::Uniform> blends_;
  osg::ref_ptr<osg::Uniform> opacity_;
  osg::ref_ptr<osg::Uniform> depth_pull_;
  ColoringState coloring_;
  int mode_ = 0;
  RangeMap map_;
  double opacity_now_ = 1.0;
  double color_alpha_ = 1.0;
  bool has_alpha_ = false;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
  std::uint64_t texels_too_many_ = 0;
};

}  // namespace stillframe::nodes
