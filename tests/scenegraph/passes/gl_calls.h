#pragma once

#include <ostream>

namespace stillframe::scenegraph {

/// Calls into OpenGL since the program started: gl_calls.cpp stands between OSG and the driver in the program that
/// links it.
struct GlCalls {
  int draws = 0;          ///< glDrawArrays, glDrawElements
  int clears = 0;         ///< glClear
  int texture_binds = 0;  ///< glBindTexture
  int texture_makes = 0;  ///< glTexImage2D
  int viewports = 0;      ///< glViewport
  int switches = 0;       ///< glEnable, glDisable

  [[nodiscard]] static GlCalls count();
  friend bool operator==(const GlCalls&, const GlCalls&) = default;
  friend GlCalls operator-(const GlCalls& a, const GlCalls& b) {
    return {a.draws - b.draws,
            a.clears - b.clears,
            a.texture_binds - b.texture_binds,
            a.texture_makes - b.texture_makes,
            a.viewports - b.viewports,
            a.switches - b.switches};
  }
};

inline std::ostream& operator<<(std::ostream& out, const GlCalls& calls) {
  return out << calls.draws << " draws, " << calls.clears << " clears, " << calls.texture_binds << " texture binds, "
             << calls.texture_makes << " textures, " << calls.viewports << " viewports, " << calls.switches
             << " switches";
}

}  // namespace stillframe::scenegraph
