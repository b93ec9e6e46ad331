#pragma once

#include <osg/Node>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <osgText/Font>
#include <string>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Makes the names beside the frames: upright text of a height in pixels. The font is looked for with the first label:
/// DejaVu or Liberation where Debian installs them, else the one built into OSG. GUI thread.
class FrameLabels {
 public:
  [[nodiscard]] osg::ref_ptr<osg::Node> make(const std::string& name, double height_px, const scenegraph::Color& color);
  /// Changes what a label says; its lines, parted by newlines, grow upwards. Costs nothing when it says so already.
  static void setText(osg::Node& label, const std::string& text, const scenegraph::Color& color);

 private:
  bool has_looked_ = false;
  osg::ref_ptr<osgText::Font> font_;
  osg::ref_ptr<osg::StateSet> state_;
};

}  // namespace stillframe::nodes
