#include "viewer/window/picture_saver.h"

#include <QCoreApplication>
#include <QPixmap>
#include <QTimer>
#include <QWidget>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr int kTimeToSayMs = 30;  // for the window to paint what it says of the picture

}  // namespace

PictureSaver::PictureSaver(scenegraph::Executor& executor, QObject* parent) : QObject(parent), executor_(executor) {}

void PictureSaver::saveView(SceneWidget& view, PictureRequest request, const QString& file) {
  request.is_scene_linear = file.endsWith(QStringLiteral(".exr"), Qt::CaseInsensitive);
  ++pending_;
  jobs_.push_back({.view = &view, .request = request, .file = file});
  Q_EMIT started(request.width_px, request.height_px);
  if (jobs_.size() == 1) {
    QTimer::singleShot(kTimeToSayMs, this, &PictureSaver::drawNext);
  }
}

void PictureSaver::fail(const QString& message) {
  --pending_;
  Q_EMIT failed(message);
}

void PictureSaver::drawNext() {
  if (jobs_.empty() || jobs_.front().is_begun) {
    return;
  }
  Job& job = jobs_.front();
  const auto begun = job.view == nullptr ? std::unexpected(scenegraph::Status{.message = "the view was closed"})
                                         : job.view->beginPicture(job.request);
  if (begun) {
    job.is_begun = true;
    QTimer::singleShot(0, this, &PictureSaver::step);
    return;
  }
  jobs_.pop_front();
  QTimer::singleShot(0, this, &PictureSaver::drawNext);
  fail(QString::fromStdString(begun.error().message));
}

void PictureSaver::step() {
  if (jobs_.empty() || !jobs_.front().is_begun) {
    return;  // the one that this was for was given up
  }
  const Job job = jobs_.front();
  const auto share = job.view == nullptr ? std::unexpected(scenegraph::Status{.message = "the view was closed"})
                                         : job.view->continuePicture();
  if (share && *share < 1.0) {
    Q_EMIT progressed(*share);
    QTimer::singleShot(0, this, &PictureSaver::step);
    return;
  }
  jobs_.pop_front();
  QTimer::singleShot(0, this, &PictureSaver::drawNext);
  scenegraph::Picture picture = job.view == nullptr ? scenegraph::Picture{} : job.view->endPicture();
  if (!share) {
    fail(QString::fromStdString(share.error().message));
    return;
  }
  const Token is_cancelled = is_cancelled_;
  Q_EMIT drawn();
  const auto shared = std::make_shared<const scenegraph::Picture>(std::move(picture));
  write(
      [shared, path = std::filesystem::path(job.file.toStdString()),
       is_exr = job.request.is_scene_linear](const scenegraph::WriteProgress& progress) {
        return is_exr ? scenegraph::writeExr(*shared, path, progress) : scenegraph::writePng(*shared, path, progress);
      },
      is_cancelled, job.file, {job.request.width_px, job.request.height_px});
}

void PictureSaver::cancel() {
  is_cancelled_->store(true);
  is_cancelled_ = std::make_shared<std::atomic<bool>>(false);
  if (!jobs_.empty() && jobs_.front().is_begun && jobs_.front().view != nullptr) {
    jobs_.front().view->endPicture();
  }
  for (; !jobs_.empty(); jobs_.pop_front()) {
    --pending_;
    Q_EMIT cancelled();
  }
}

void PictureSaver::saveWindow(QWidget& window, const QString& file) {
  ++pending_;
  // Before anything is said of it: that would be in the picture.
  const QImage image = window.grab().toImage().convertToFormat(QImage::Format_RGB888);
  Q_EMIT started(window.width(), window.height());
  scenegraph::BytePicture picture{.width = image.width(), .height = image.height(), .rgb = {}};
  for (int y = 0; y < image.height(); ++y) {
    picture.rgb.insert(picture.rgb.end(), image.constScanLine(y),
                       image.constScanLine(y) + std::ptrdiff_t{3} * image.width());
  }
  write([shared = std::make_shared<const scenegraph::BytePicture>(std::move(picture)),
         path = std::filesystem::path(file.toStdString())](
            const scenegraph::WriteProgress& progress) { return scenegraph::writePng(*shared, path, progress); },
        is_cancelled_, file, image.size());
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): kept by the worker
void PictureSaver::write(Work work, Token is_cancelled, const QString& file, QSize size) {
  // Answers come back as events of the application, which outlives the workers; we may be gone by then.
  const auto tell = [self = QPointer<PictureSaver>(this)](const auto& what) {
    QMetaObject::invokeMethod(
        QCoreApplication::instance(),
        [self, what] {
          if (self != nullptr) {
            what(*self);
          }
        },
        Qt::QueuedConnection);
  };
  executor_.submit([tell, is_cancelled = std::move(is_cancelled), work = std::move(work), file, size] {
    const auto result = work([&](double share) {
      tell([share](PictureSaver& self) { Q_EMIT self.progressed(share); });
      return !is_cancelled->load();
    });
    tell([=, was_cancelled = is_cancelled->load()](PictureSaver& self) {
      if (!result && !was_cancelled) {
        self.fail(QString::fromStdString(result.error().message));
        return;
      }
      --self.pending_;
      if (result) {
        Q_EMIT self.saved(file, size.width(), size.height());
      } else {
        Q_EMIT self.cancelled();
      }
    });
  });
}

}  // namespace stillframe::viewer
