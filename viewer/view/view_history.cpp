#include "viewer/view/view_history.h"

#include <QElapsedTimer>
#include <utility>

namespace stillframe::viewer {
namespace {

constexpr qint64 kGestureMs = 1500;

}  // namespace

class ViewHistory::Step : public QUndoCommand {
 public:
  Step(ViewHistory& history, const QString& what, QString gesture, ViewSettings before, ViewSettings after)
      : QUndoCommand(what),
        history_(history),
        gesture_(std::move(gesture)),
        before_(std::move(before)),
        after_(std::move(after)) {
    made_.start();
  }
  void undo() override { go(after_, before_); }
  void redo() override {
    if (std::exchange(is_done_, true)) {  // not when it is pushed: the user has done it
      go(before_, after_);
    }
  }
  [[nodiscard]] int id() const override { return gesture_.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* next) override {
    const auto& later = static_cast<const Step&>(*next);
    const bool has_other_change = later.before_ != after_;  // something came by itself in between
    if (later.gesture_ != gesture_ || has_other_change || made_.elapsed() > kGestureMs) {
      return false;
    }
    after_ = later.after_;
    made_.restart();
    setObsolete(after_ == before_);
    return true;
  }

 private:
  void go(const ViewSettings& from, const ViewSettings& to) {
    history_.is_going_ = true;
    history_.change_(from, to);
    history_.is_going_ = false;
    history_.known_ = history_.read_();
  }

  ViewHistory& history_;
  QString gesture_;
  ViewSettings before_;
  ViewSettings after_;
  QElapsedTimer made_;
  bool is_done_ = false;
};

ViewHistory::ViewHistory(Read read, Change change, QObject* parent)
    : QObject(parent), read_(std::move(read)), change_(std::move(change)) {
  constexpr int kMostSteps = 200;
  stack_.setUndoLimit(kMostSteps);
}

void ViewHistory::note(const QString& what, const QString& gesture) {
  if (is_going_) {
    return;
  }
  ViewSettings now = read_();
  if (now != known_) {
    ViewSettings before = std::exchange(known_, now);
    stack_.push(new Step(*this, what, gesture, std::move(before), std::move(now)));
  }
}

void ViewHistory::adopt() {
  if (!is_going_) {
    known_ = read_();
  }
}

void ViewHistory::clear() {
  stack_.clear();
  adopt();
}

}  // namespace stillframe::viewer
