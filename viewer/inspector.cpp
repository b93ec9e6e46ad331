#include "viewer/inspector.h"

#include <QApplication>

#include "viewer/gl_format.h"
#include "viewer/inspector_window.h"

namespace stillframe::viewer {

int runInspector(int argc, char** argv, const InspectorOptions& options, const RecordingOpener& opener) {
  prepareApplication();
  QApplication app(argc, argv);
  QApplication::setApplicationName(QStringLiteral("Stillframe"));
  QApplication::setOrganizationName(QStringLiteral("Stillframe"));
  InspectorWindow window(opener, options);
  window.show();
  return QApplication::exec();
}

}  // namespace stillframe::viewer
