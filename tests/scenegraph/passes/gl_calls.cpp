// The names below are found here before those of the OpenGL library, by OSG too, and pass each call on.
#include "tests/scenegraph/passes/gl_calls.h"

#include <dlfcn.h>

#include <GL/gl.h>

namespace stillframe::scenegraph {
namespace {

GlCalls& counted() {
  static GlCalls calls;
  return calls;
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

GlCalls GlCalls::count() { return counted(); }

}  // namespace stillframe::scenegraph

using stillframe::scenegraph::counted;
using stillframe::scenegraph::next;

extern "C" {

void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
  static auto* const pass_on = next<void(GLenum, GLint, GLsizei)>("glDrawArrays");
  ++counted().draws;
  pass_on(mode, first, count);
}

void glDrawElements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
  static auto* const pass_on = next<void(GLenum, GLsizei, GLenum, const void*)>("glDrawElements");
  ++counted().draws;
  pass_on(mode, count, type, indices);
}

void glClear(GLbitfield mask) {
  static auto* const pass_on = next<void(GLbitfield)>("glClear");
  ++counted().clears;
  pass_on(mask);
}

void glBindTexture(GLenum target, GLuint texture) {
  static auto* const pass_on = next<void(GLenum, GLuint)>("glBindTexture");
  ++counted().texture_binds;
  pass_on(target, texture);
}

void glTexImage2D(GLenum target, GLint level, GLint internal_format, GLsizei width, GLsizei height, GLint border,
                  GLenum format, GLenum type, const void* pixels) {
  static auto* const pass_on =
      next<void(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*)>("glTexImage2D");
  ++counted().texture_makes;
  pass_on(target, level, internal_format, width, height, border, format, type, pixels);
}

void glViewport(GLint x, GLint y, GLsizei width, GLsizei height) {
  static auto* const pass_on = next<void(GLint, GLint, GLsizei, GLsizei)>("glViewport");
  ++counted().viewports;
  pass_on(x, y, width, height);
}

void glEnable(GLenum capability) {
  static auto* const pass_on = next<void(GLenum)>("glEnable");
  ++counted().switches;
  pass_on(capability);
}

void glDisable(GLenum capability) {
  static auto* const pass_on = next<void(GLenum)>("glDisable");
  ++counted().switches;
  pass_on(capability);
}

}  // extern "C"
