#include "scenegraph/pipeline/gl_debug.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <osg/Notify>

namespace stillframe::scenegraph {

struct GlDebugLog::State {
  std::size_t count = 0;
  std::vector<std::string> kept;

  static void APIENTRY receive(GLenum /*source*/, GLenum /*type*/, GLuint /*id*/, GLenum severity, GLsizei /*length*/,
                               const GLchar* message, const void* user) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) {
      return;
    }
    auto& state = *static_cast<State*>(const_cast<void*>(user));  // NOLINT: the signature is OpenGL's
    ++state.count;
    if (state.kept.size() < kKept) {
      const char* const word = severity == GL_DEBUG_SEVERITY_HIGH     ? "high"
                               : severity == GL_DEBUG_SEVERITY_MEDIUM ? "medium"
                                                                      : "low";
      state.kept.push_back(std::string(word) + ": " + message);
      OSG_WARN << "OpenGL: " << state.kept.back() << std::endl;
    }
  }
};

GlDebugLog::GlDebugLog() : state_(std::make_unique<State>()) {}
GlDebugLog::~GlDebugLog() = default;

void GlDebugLog::install() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // the callback then runs on this thread, within the call at fault
  glDebugMessageCallback(&State::receive, state_.get());
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

void GlDebugLog::uninstall() { glDebugMessageCallback(nullptr, nullptr); }

std::size_t GlDebugLog::count() const noexcept { return state_->count; }
const std::vector<std::string>& GlDebugLog::messages() const noexcept { return state_->kept; }
void GlDebugLog::clear() {
  state_->count = 0;
  state_->kept.clear();
}

}  // namespace stillframe::scenegraph
