#pragma once

#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// State of lines in one colour, which is a uniform: setColor() touches nothing else. GUI thread.
class LineState {
 public:
  LineState();
  [[nodiscard]] osg::StateSet* stateSet() const noexcept { return state_.get(); }
  void setColor(const scenegraph::Color& color);

 private:
  osg::ref_ptr<osg::StateSet> state_;
  osg::ref_ptr<osg::Uniform> color_;
};

}  // namespace stillframe::nodes
