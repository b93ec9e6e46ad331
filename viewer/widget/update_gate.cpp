#include "viewer/widget/update_gate.h"

#include <QCoreApplication>
#include <atomic>
#include <utility>

namespace stillframe::viewer {

struct UpdateGate::State {
  std::atomic<bool> is_posted = false;
  std::function<void()> callback;  // GUI thread only; empty once the owner is gone
};

UpdateGate::UpdateGate(std::function<void()> callback) : state_(std::make_shared<State>()) {
  state_->callback = std::move(callback);
}

UpdateGate::~UpdateGate() { state_->callback = nullptr; }

void UpdateGate::request() const { post(state_); }

std::function<void()> UpdateGate::requester() const {
  return [state = state_] { post(state); };
}

void UpdateGate::post(const std::shared_ptr<State>& state) {
  QCoreApplication* app = QCoreApplication::instance();
  if (app == nullptr || state->is_posted.exchange(true)) {
    return;
  }
  QMetaObject::invokeMethod(
      app,
      [state] {
        state->is_posted = false;  // before the call: what is requested during it asks for another
        if (state->callback) {
          state->callback();
        }
      },
      Qt::QueuedConnection);
}

}  // namespace stillframe::viewer
