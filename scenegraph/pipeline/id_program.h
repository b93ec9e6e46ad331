#pragma once

#include <osg/Program>
#include <osg/ref_ptr>
#include <string>

namespace stillframe::scenegraph {

/// A scene program that writes which part of a drawable a pixel shows, instead of its colour: the same vertices, the
/// same fragments left out, the same depth. Its own shaders' texts with another main() round theirs, so that no layer
/// writes a second shader.
///
/// Fragments of opacity 0 are left out. Points that do not touch `u_id_window` (left, bottom, right, top, -1 to 1 over
/// the picture) are dropped before they are rasterised; `u_id_pixel` is the size of a pixel there. `u_id_drawable` is
/// written first, then gl_InstanceID, gl_PrimitiveID and gl_VertexID. A program without both shaders gives nullptr.
[[nodiscard]] osg::ref_ptr<osg::Program> makeIdProgram(const osg::Program& program);

/// The program for a drawable that has none.
[[nodiscard]] osg::ref_ptr<osg::Program> makePlainIdProgram();

/// `text` with `word` replaced where it stands alone.
[[nodiscard]] std::string replaceWord(const std::string& text, const std::string& word, const std::string& by);

}  // namespace stillframe::scenegraph
