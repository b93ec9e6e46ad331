#include "viewer/widget/gl_format.h"

#include <QCoreApplication>
#include <QString>
#include <osg/Notify>

namespace stillframe::viewer {
namespace {

class LogHandler : public osg::NotifyHandler {
 public:
  void notify(osg::NotifySeverity severity, const char* message) override {
    const QString text = QString::fromUtf8(message).trimmed();
    if (severity <= osg::WARN) {
      qCWarning(glLog).noquote() << text;
    } else {
      qCInfo(glLog).noquote() << text;
    }
  }
};

}  // namespace

Q_LOGGING_CATEGORY(glLog, "stillframe.gl")

QSurfaceFormat glFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CompatibilityProfile);
  format.setOption(QSurfaceFormat::DeprecatedFunctions);
  format.setOption(QSurfaceFormat::DebugContext);
  format.setDepthBufferSize(0);
  format.setStencilBufferSize(0);
  format.setSwapInterval(1);
  return format;
}

void prepareApplication() {
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QSurfaceFormat::setDefaultFormat(glFormat());
  osg::setNotifyHandler(new LogHandler);
}

}  // namespace stillframe::viewer
