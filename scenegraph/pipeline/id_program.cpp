#include "scenegraph/pipeline/id_program.h"

#include <cctype>
#include <osg/Shader>

#include "generated/stillframe_render/shaders.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;

bool isOfWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The text after its #version line, which must stay the first.
std::string afterVersion(const std::string& text, const std::string& added) {
  const std::size_t at = text.find("#version");
  const std::size_t end = at == std::string::npos ? std::string::npos : text.find('\n', at);
  return end == std::string::npos ? added + text : text.substr(0, end + 1) + added + text.substr(end + 1);
}

osg::ref_ptr<osg::Program> link(const std::string& name, const std::string& vertex, const std::string& fragment) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(name);
  program->addShader(
      new osg::Shader{osg::Shader::VERTEX, replaceWord(vertex, "main", "sf_scene_main") + glsl::k_id_vert});
  std::string scene = replaceWord(fragment, "main", "sf_scene_main");
  scene = afterVersion(replaceWord(scene, "gl_FragColor", "sf_scene_color"), "vec4 sf_scene_color = vec4(1.0);\n");
  program->addShader(new osg::Shader{osg::Shader::FRAGMENT, scene + glsl::k_id_frag});
  return program;
}

}  // namespace

std::string replaceWord(const std::string& text, const std::string& word, const std::string& by) {
  std::string made;
  std::size_t from = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) {
    const bool begins = at == 0 || !isOfWord(text[at - 1]);
    const bool ends = at + word.size() == text.size() || !isOfWord(text[at + word.size()]);
    if (begins && ends) {
      made += text.substr(from, at - from) + by;
      from = at + word.size();
    }
  }
  return made + text.substr(from);
}

osg::ref_ptr<osg::Program> makeIdProgram(const osg::Program& program) {
  const osg::Shader* vertex = nullptr;
  const osg::Shader* fragment = nullptr;
  for (unsigned i = 0; i < program.getNumShaders(); ++i) {
    const osg::Shader* const shader = program.getShader(i);
    (shader->getType() == osg::Shader::VERTEX ? vertex : fragment) = shader;
  }
  if (vertex == nullptr || fragment == nullptr || program.getNumShaders() != 2) {
    return nullptr;
  }
  const osg::ref_ptr<osg::Program> made =
      link("id of " + program.getName(), vertex->getShaderSource(), fragment->getShaderSource());
  for (const auto& [name, location] : program.getAttribBindingList()) {
    made->addBindAttribLocation(name, location);
  }
  return made;
}

osg::ref_ptr<osg::Program> makePlainIdProgram() {
  return link("id", "#version 450 compatibility\nvoid main() { gl_Position = ftransform(); gl_PointSize = 1.0; }\n",
              "#version 450 compatibility\nvoid main() {}\n");
}

}  // namespace stillframe::scenegraph
