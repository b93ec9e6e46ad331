#include "tests/viewer/shown_widget.h"

#include <QMouseEvent>
#include <QTest>

#include "tests/viewer/viewer_support.h"

namespace stillframe::test {

using namespace tf::literals;

ShownWidgetTest::ShownWidgetTest() : dataset_(makeRobotDataset()) {
  widget_.resize(static_cast<int>(kSize.width_px), static_cast<int>(kSize.height_px));
  widget_.setSmoothMoves(false);
  widget_.setDataset(dataset_, *executor_);
  widget_.scene()->addDefaultLayers();
  widget_.setTime(tf::TimePoint{2_s});
  widget_.show();
  if (!QTest::qWaitForWindowExposed(&widget_)) {
    ADD_FAILURE() << "no window";
  }
  settle();
}

void ShownWidgetTest::TearDown() { EXPECT_EQ(widget_.glMessages(), 0U) << "OpenGL debug output must be silent"; }

void ShownWidgetTest::goTo(std::int64_t time_ns) {
  widget_.setTime(tf::TimePoint{time_ns});
  settle();
}

void ShownWidgetTest::key(int key, Qt::KeyboardModifiers modifiers) {
  QTest::keyClick(&widget_, static_cast<Qt::Key>(key), modifiers);
}

void ShownWidgetTest::hover(QPointF place) {
  QMouseEvent event(QEvent::MouseMove, place, widget_.mapToGlobal(place), Qt::NoButton, {}, {});
  QCoreApplication::sendEvent(&widget_, &event);
  settle();
}

void ShownWidgetTest::click(QPointF place, Qt::KeyboardModifiers modifiers) {
  QTest::mouseClick(&widget_, Qt::LeftButton, modifiers, place.toPoint());
  settle();
}

QPointF ShownWidgetTest::pixelOf(const std::string& frame, const glm::dvec3& point_in_frame) {
  const auto pose = widget_.scene()->frames().fixedFromFrame(frame);
  const auto at =
      pose ? scenegraph::toScreen(widget_.shownView(), kSize, tf::transformPoint(*pose, point_in_frame)) : std::nullopt;
  return at ? QPointF(at->position_px.x, at->position_px.y) : QPointF(-1e9, -1e9);
}

}  // namespace stillframe::test
