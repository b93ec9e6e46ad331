#pragma once

#include <osg/Node>
#include <osg/ref_ptr>
#include <string>

#include "nodes/text/text_parts.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Makes the names beside the frames: upright text of a height in pixels, over everything else. GUI thread.
class FrameLabels {
 public:
  [[nodiscard]] osg::ref_ptr<osg::Node> make(const std::string& name, double height_px, const scenegraph::Color& color);
  /// Height of a line in pixels of the target. Costs nothing when it is that already.
  static void setHeight(osg::Node& label, double height_px);
  /// Changes what a label says; its lines, parted by newlines, grow upwards. Costs nothing when it says so already.
  static void setText(osg::Node& label, const std::string& text, const scenegraph::Color& color);

 private:
  TextParts parts_{TextParts::Place::OverAll};  // half a name is none
};

}  // namespace stillframe::nodes
