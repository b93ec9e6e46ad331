#pragma once

#include <QWidget>
#include <optional>

#include "live_robot.h"

namespace host_example {

/// One value over time, with the tracker as a line: a click or a drag asks for another time. GUI thread.
class Plot : public QWidget {
  Q_OBJECT

 public:
  explicit Plot(QWidget* parent = nullptr);

  void setValue(std::optional<Value> value);
  void setRange(stillframe::tf::TimePoint first, stillframe::tf::TimePoint last);
  void setTime(stillframe::tf::TimePoint time);

  [[nodiscard]] stillframe::tf::TimePoint timeAt(double x) const;
  [[nodiscard]] double xAt(stillframe::tf::TimePoint time) const;

 Q_SIGNALS:
  void seekRequested(stillframe::tf::TimePoint time);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  std::optional<Value> value_;
  stillframe::tf::TimePoint first_;
  stillframe::tf::TimePoint last_;
  stillframe::tf::TimePoint time_;
};

}  // namespace host_example
