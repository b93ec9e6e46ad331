#pragma once

#include <osg/StateSet>

namespace stillframe::scenegraph {

/// Makes what `state` draws opaque (the default), or blended with what lies behind it by its fragments' alpha.
///
/// The one place where this is decided, for every layer. Blended things are drawn after opaque ones. Alpha of the
/// target stays that of an opaque picture. What uses sfLitOutput() calls this once at least, since a program keeps the
/// value of a uniform that the next thing drawn does not set. Order among flat things on one plane is the caller's, by
/// a render bin set afterwards. GUI thread.
void setBlended(osg::StateSet& state, bool is_blended);

}  // namespace stillframe::scenegraph
