#include "viewer/window/picture_saver.h"

#include <QCoreApplication>
#include <QPixmap>
#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "scenegraph/export/picture_io.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr int kTimeToSayMs = 30;  // for the window to paint what it says of the picture

}  // namespace

PictureSaver::PictureSaver(scenegraph::Executor& executor, QObject* parent) : QObject(parent), executor_(executor) {}

void PictureSaver::saveView(SceneWidget& view, PictureRequest request, const QString& file) {
  request.is_scene_linear = file.endsWith(QStringLiteral(".exr"), Qt::CaseInsensitive);
  ++pending_;
  Q_EMIT started(request.width_px, request.height_px);
  QTimer::singleShot(kTimeToSayMs, this, [this, shown = QPointer<SceneWidget>(&view), request, file] {
    if (shown == nullptr) {
      fail(tr("The view was closed before its picture was drawn"));
    } else {
      drawView(*shown, request, file);
    }
  });
}

void PictureSaver::fail(const QString& message) {
  --pending_;
  Q_EMIT failed(message);
}

void PictureSaver::drawView(SceneWidget& view, const PictureRequest& request, const QString& file) {
  auto picture = view.takePicture(request);
  if (!picture) {
    fail(QString::fromStdString(picture.error().message));
    return;
  }
  Q_EMIT drawn();
  const auto shared = std::make_shared<const scenegraph::Picture>(std::move(*picture));
  write(
      [shared, path = std::filesystem::path(file.toStdString()), is_exr = request.is_scene_linear] {
        return is_exr ? scenegraph::writeExr(*shared, path) : scenegraph::writePng(*shared, path);
      },
      file, request.width_px, request.height_px);
}

void PictureSaver::saveWindow(QWidget& window, const QString& file) {
  ++pending_;
  Q_EMIT started(window.width(), window.height());
  const QImage image = window.grab().toImage().convertToFormat(QImage::Format_RGB888);
  scenegraph::BytePicture picture{.width = image.width(), .height = image.height(), .rgb = {}};
  for (int y = 0; y < image.height(); ++y) {
    picture.rgb.insert(picture.rgb.end(), image.constScanLine(y),
                       image.constScanLine(y) + std::ptrdiff_t{3} * image.width());
  }
  write([shared = std::make_shared<const scenegraph::BytePicture>(std::move(picture)),
         path = std::filesystem::path(file.toStdString())] { return scenegraph::writePng(*shared, path); },
        file, image.width(), image.height());
}

void PictureSaver::write(std::function<std::expected<void, scenegraph::Status>()> work, const QString& file, int width,
                         int height) {
  // The answer comes back as an event of the application, which outlives the workers; we may be gone by then.
  executor_.submit([self = QPointer<PictureSaver>(this), work = std::move(work), file, width, height] {
    const auto result = work();
    QMetaObject::invokeMethod(
        QCoreApplication::instance(),
        [self, result, file, width, height] {
          if (self == nullptr) {
            return;
          }
          if (result) {
            --self->pending_;
            Q_EMIT self->saved(file, width, height);
          } else {
            self->fail(QString::fromStdString(result.error().message));
          }
        },
        Qt::QueuedConnection);
  });
}

}  // namespace stillframe::viewer
