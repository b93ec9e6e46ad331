#include "scenegraph/blending.h"

#include <osg/BlendFunc>
#include <osg/ref_ptr>

namespace stillframe::scenegraph {

void setBlended(osg::StateSet& state, bool is_blended) {
  state.getOrCreateUniform("u_is_blended", osg::Uniform::FLOAT)->set(is_blended ? 1.0F : 0.0F);
  if (is_blended) {
    const osg::ref_ptr<osg::BlendFunc> over =
        new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    state.setAttributeAndModes(over, osg::StateAttribute::ON);
    state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
  } else {
    state.removeAttribute(osg::StateAttribute::BLENDFUNC);
    state.removeMode(GL_BLEND);
    state.setRenderingHint(osg::StateSet::DEFAULT_BIN);
  }
}

}  // namespace stillframe::scenegraph
