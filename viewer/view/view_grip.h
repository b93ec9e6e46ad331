#pragma once

#include <QLabel>
#include <QPoint>

namespace stillframe::viewer {

/// The handle that a view is dragged by. GUI thread.
class ViewGrip : public QLabel {
  Q_OBJECT

 public:
  explicit ViewGrip(QWidget* parent = nullptr);

 Q_SIGNALS:
  /// The left button is down on it and the cursor has gone as far as a drag takes to begin.
  void dragged();

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  QPoint pressed_at_;
};

}  // namespace stillframe::viewer
