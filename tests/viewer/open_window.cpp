#include "tests/viewer/open_window.h"

#include <QTest>
#include <utility>
#include <vector>

#include "tests/viewer/viewer_support.h"

namespace stillframe::test {

void OpenWindowTest::TearDown() {
  for (viewer::ViewPanel* const panel : window_ == nullptr ? std::vector<viewer::ViewPanel*>() : window_->views()) {
    EXPECT_EQ(panel->view().glMessages(), 0U);
  }
}

void OpenWindowTest::show(viewer::InspectorOptions options) {
  window_ = std::make_unique<viewer::InspectorWindow>(fakeOpener(), std::move(options));
  window_->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
}

void OpenWindowTest::open(viewer::InspectorOptions options) {
  show(std::move(options));
  complete();
}

void OpenWindowTest::complete() {
  ASSERT_TRUE(waitFor([&] { return window_->isComplete(); }));
  settle();
}

void OpenWindowTest::activate() {
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
}

}  // namespace stillframe::test
