#include "scenegraph/geometry.h"

#include <map>
#include <mutex>
#include <osg/Shader>
#include <osg/observer_ptr>
#include <tuple>

#include "generated/stillframe_geometry/shaders.h"

namespace stillframe::scenegraph {
namespace {

/// Of a shader whose first line says the version. Its main() goes by another name where SF_LISTED is defined, so that
/// what it writes can be kept instead.
std::string listable(const std::string& fragment_source) {
  const std::size_t first_line = fragment_source.find('\n') + 1;
  const bool has_own_depth = fragment_source.contains("gl_FragDepth");
  return fragment_source.substr(0, first_line) +
         "#pragma import_defines(SF_LISTED, SF_SAMPLED)\n#ifdef SF_LISTED\n#define main sfMain\n#endif\n" +
         (has_own_depth ? "#define SF_OWN_DEPTH\n" : "") + fragment_source.substr(first_line) +
         shaders::stillframe_geometry::k_listed_glsl;
}

}  // namespace

osg::ref_ptr<osg::Geometry> makeGeometry() {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setUseVertexArrayObject(false);
  return geometry;
}

osg::ref_ptr<osg::Geometry> makeGeometry(const osg::BoundingBox& bound) {
  osg::ref_ptr<osg::Geometry> geometry = makeGeometry();
  geometry->setInitialBound(bound);
  return geometry;
}

osg::ref_ptr<osg::Program> makeProgram(const std::string& name, const std::string& vertex_source,
                                       const std::string& fragment_source) {
  // Only remembers what others hold, so that the last user's release frees the program.
  static std::mutex mutex;
  static std::map<std::tuple<std::string, std::string, std::string>, osg::observer_ptr<osg::Program>> known;
  const std::scoped_lock lock{mutex};
  osg::observer_ptr<osg::Program>& entry = known[{name, vertex_source, fragment_source}];
  osg::ref_ptr<osg::Program> program;
  if (entry.lock(program)) {
    return program;
  }
  program = new osg::Program;
  program->setName(name);
  osg::ref_ptr<osg::Shader> vertex = new osg::Shader{osg::Shader::VERTEX, vertex_source};
  osg::ref_ptr<osg::Shader> fragment = new osg::Shader{osg::Shader::FRAGMENT, listable(fragment_source)};
  vertex->setName(name + ".vert");
  fragment->setName(name + ".frag");
  program->addShader(vertex);
  program->addShader(fragment);
  entry = program;
  return program;
}

}  // namespace stillframe::scenegraph
