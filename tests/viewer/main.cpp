#include <gtest/gtest.h>

#include <QSettings>
#include <QTemporaryDir>

#include "viewer/widget/gl_format.h"
#include "viewer/widget/gl_view.h"
#include "viewer/window/stall_monitor.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  // What a person has set on this machine is neither read nor changed.
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
  stillframe::viewer::prepareApplication();
  if (qEnvironmentVariable("STILLFRAME_TEST_VIEWS") == QStringLiteral("composed")) {
    stillframe::viewer::GlView::setWay(stillframe::viewer::ViewWay::Composed);
  }
  const stillframe::viewer::MonitoredApplication app(argc, argv);
  return RUN_ALL_TESTS();
}
