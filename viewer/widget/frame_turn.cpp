#include "viewer/widget/frame_turn.h"

#include <QCoreApplication>
#include <QObject>
#include <QPointer>
#include <algorithm>
#include <utility>
#include <vector>

namespace stillframe::viewer {

/// Who waits; there is one of it, the application's.
class FrameTurns : public QObject {
 public:
  /// nullptr when there is no application any more.
  static FrameTurns* ofAll() {
    static QPointer<FrameTurns> turns;
    if (turns == nullptr && QCoreApplication::instance() != nullptr) {
      turns = new FrameTurns(QCoreApplication::instance());
    }
    return turns;
  }

  void ask(FrameTurn& turn) {
    if (std::ranges::find(waiting_, &turn) == waiting_.end()) {
      waiting_.push_back(&turn);
    }
    waits_ = waits_ && under_way_ != &turn;
    post();
  }

  void forget(const FrameTurn& turn) {
    std::erase(waiting_, &turn);
    last_ = last_ == &turn ? nullptr : last_;
    if (under_way_ == &turn) {
      under_way_ = nullptr;
      waits_ = false;
      post();
    }
  }

 private:
  explicit FrameTurns(QObject* parent) : QObject(parent) { setObjectName(QStringLiteral("a step of a frame")); }

  void post() {
    const bool has_steps = under_way_ != nullptr ? !waits_ : !waiting_.empty();
    if (has_steps && !std::exchange(is_posted_, true)) {
      QMetaObject::invokeMethod(this, [this] { step(); }, Qt::QueuedConnection);
    }
  }

  FrameTurn* next() {
    if (under_way_ != nullptr) {
      return under_way_;
    }
    auto chosen =
        std::ranges::find_if(waiting_, [this](const FrameTurn* turn) { return turn != last_ && turn->is_favoured_(); });
    chosen = chosen == waiting_.end() ? std::ranges::find_if(waiting_, [this](auto* turn) { return turn != last_; })
                                      : chosen;
    chosen = chosen == waiting_.end() ? waiting_.begin() : chosen;
    return chosen == waiting_.end() ? nullptr : *chosen;
  }

  void step() {
    is_posted_ = false;  // before the step: what is asked for during it comes in another event
    FrameTurn* const turn = next();
    if (turn == nullptr) {
      return;
    }
    std::erase(waiting_, turn);
    last_ = turn;
    under_way_ = turn;
    const FrameTurn::Step done = turn->step_();
    if (under_way_ == turn) {  // and not forgotten meanwhile
      under_way_ = done == FrameTurn::Step::Over ? nullptr : turn;
      // Who is asked again during the step does not wait.
      waits_ = done == FrameTurn::Step::Waits && std::ranges::find(waiting_, turn) == waiting_.end();
    }
    post();
  }

  std::vector<FrameTurn*> waiting_;  // in the order of asking
  FrameTurn* under_way_ = nullptr;   // whose frame has been begun
  bool waits_ = false;               // until that asks again
  FrameTurn* last_ = nullptr;        // that had a step
  bool is_posted_ = false;
};

FrameTurn::FrameTurn(std::function<Step()> step, std::function<bool()> is_favoured)
    : step_(std::move(step)), is_favoured_(std::move(is_favoured)) {}

FrameTurn::~FrameTurn() {
  if (FrameTurns* const turns = FrameTurns::ofAll()) {
    turns->forget(*this);
  }
}

void FrameTurn::ask() {
  if (FrameTurns* const turns = FrameTurns::ofAll()) {
    turns->ask(*this);
  }
}

}  // namespace stillframe::viewer
