#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace stillframe::scenegraph {

/// Collects the driver's debug messages (KHR_debug) of one context: each is counted, the first ones are kept and
/// logged.
///
/// Everything above severity NOTIFICATION counts: errors, undefined behaviour, performance warnings. A test that draws
/// fails when count() is not zero. Works on any context that is current; only one made with the debug flag is sure to
/// report all. Thread of the context only.
class GlDebugLog {
 public:
  GlDebugLog();
  /// Does not touch the context: it may be gone. uninstall() before, when it lives on.
  ~GlDebugLog();
  GlDebugLog(const GlDebugLog&) = delete;
  GlDebugLog& operator=(const GlDebugLog&) = delete;

  /// Takes over the messages of the context that is current. Without KHR_debug nothing is ever reported.
  void install();
  /// Gives the messages of the context that is current back to nobody.
  void uninstall();

  [[nodiscard]] std::size_t count() const noexcept;
  /// The first kKept messages since the last clear(), "severity: text".
  [[nodiscard]] const std::vector<std::string>& messages() const noexcept;
  void clear();

  static constexpr std::size_t kKept = 32;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stillframe::scenegraph
