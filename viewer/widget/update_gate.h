#pragma once

#include <functional>
#include <memory>

namespace stillframe::viewer {

/// Brings requests from any thread to one callback on the GUI thread, many requests to one call.
///
/// request() may be called from any thread, also after the gate's owner is gone: it does nothing then. The callback
/// runs from the event loop, once for all requests made before it starts. Made and destroyed on the GUI thread.
class UpdateGate {
 public:
  explicit UpdateGate(std::function<void()> callback);
  ~UpdateGate();
  UpdateGate(const UpdateGate&) = delete;
  UpdateGate& operator=(const UpdateGate&) = delete;

  void request() const;
  /// The same as a value that workers may keep.
  [[nodiscard]] std::function<void()> requester() const;

 private:
  struct State;
  static void post(const std::shared_ptr<State>& state);
  std::shared_ptr<State> state_;
};

}  // namespace stillframe::viewer
