#pragma once

#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <string>

#include "nodes/points/value_range.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// The uniforms of coloring.glsl in a layer's state. GUI thread.
class ColoringState {
 public:
  explicit ColoringState(osg::StateSet& state);

  /// An unknown name is the first colormap.
  void setColormap(const std::string& name);
  void setFlatColor(const scenegraph::Color& color);
  void setMissingColor(const scenegraph::Color& color);
  /// `mode`: the layer's enum; t = value * scale + bias of the stored values.
  void setMode(int mode, const RangeMap& map);

 private:
  osg::ref_ptr<osg::Uniform> mode_;
  osg::ref_ptr<osg::Uniform> value_;
  osg::ref_ptr<osg::Uniform> colormap_;
  osg::ref_ptr<osg::Uniform> flat_color_;
  osg::ref_ptr<osg::Uniform> missing_color_;
};

/// GL_PROGRAM_POINT_SIZE; OSG's headers name it only for some profiles.
inline constexpr unsigned kProgramPointSize = 0x8642;

}  // namespace stillframe::nodes
