#include "viewer/window/inspector.h"

#include <QLoggingCategory>
#include <QString>
#include <cstdio>

#include "viewer/widget/gl_format.h"
#include "viewer/widget/gl_view.h"
#include "viewer/window/inspector_window.h"
#include "viewer/window/stall_monitor.h"

namespace stillframe::viewer {
namespace {

constexpr const char* kPlatform = "QT_QPA_PLATFORM";

/// Lets Qt fall back to a platform without windows where it would abort because the display does not answer.
/// Returns whether it was done: not where the user has chosen a platform.
bool allowNoDisplay() {
  if (qEnvironmentVariableIsSet(kPlatform)) {
    return false;
  }
  qputenv(kPlatform, qEnvironmentVariableIsEmpty("DISPLAY") ? "wayland;offscreen" : "xcb;offscreen");
  QLoggingCategory::setFilterRules(QStringLiteral("qt.qpa.*=false"));  // our own line says it
  return true;
}

}  // namespace

std::expected<int, scenegraph::Status> runInspector(int argc, char** argv, const InspectorOptions& options,
                                                    const RecordingOpener& opener) {
  prepareApplication();
  const bool may_fall_back = allowNoDisplay();
  MonitoredApplication app(argc, argv);
  if (may_fall_back) {
    QLoggingCategory::setFilterRules(QString());
    qunsetenv(kPlatform);
    if (QGuiApplication::platformName() == QLatin1String("offscreen")) {
      const QByteArray display = qgetenv(qEnvironmentVariableIsEmpty("DISPLAY") ? "WAYLAND_DISPLAY" : "DISPLAY");
      return std::unexpected(
          scenegraph::Status{scenegraph::StatusLevel::Error, "NoDisplay",
                             "view needs a display, and '" + display.toStdString() +
                                 "' does not answer; 'stillframe render FILE --out picture.png' needs none"});
    }
  }
  QApplication::setApplicationName(QStringLiteral("Stillframe"));
  QApplication::setOrganizationName(QStringLiteral("Stillframe"));
  applyTheme(options.theme.value_or(rememberedTheme()));
  GlView::setWay(options.way);
  StallMonitor monitor;
  InspectorWindow window(opener, options);
  if (options.reports_stalls) {
    QObject::connect(&window, &InspectorWindow::loaded, &app, [&monitor] {
      std::printf("Until the recording was loaded, %s", monitor.report().c_str());
      monitor = {};
    });
    app.watch(&monitor);
  }
  window.show();
  const int code = QApplication::exec();
  if (options.reports_stalls) {
    app.watch(nullptr);
    std::printf("Since then, %s", monitor.report().c_str());
  }
  return code;
}

}  // namespace stillframe::viewer
