#pragma once

#include <QObject>
#include <QString>
#include <expected>
#include <functional>
#include <memory>

#include "scenegraph/executor.h"
#include "scenegraph/status.h"
#include "viewer/widget/picture_request.h"

class QWidget;

namespace stillframe::viewer {

class SceneWidget;

/// Saves pictures of views and windows as files. Drawing is done at once, on the GUI thread; encoding and writing,
/// which take longer, on a worker. GUI thread. `executor` must outlive it; files under way are written to their end.
class PictureSaver : public QObject {
  Q_OBJECT

 public:
  explicit PictureSaver(scenegraph::Executor& executor, QObject* parent = nullptr);

  /// .exr (scene-linear, with depth), or .png whatever else the name ends in.
  void saveView(SceneWidget& view, PictureRequest request, const QString& file);
  /// All of the widget as it is on the screen, in its pixels.
  void saveWindow(QWidget& window, const QString& file);
  /// Pictures that are being written.
  [[nodiscard]] int pending() const noexcept { return pending_; }

 Q_SIGNALS:
  void started();
  void saved(const QString& file, int width_px, int height_px);
  void failed(const QString& message);

 private:
  void write(std::function<std::expected<void, scenegraph::Status>()> work, const QString& file, int width, int height);

  scenegraph::Executor& executor_;
  int pending_ = 0;
};

}  // namespace stillframe::viewer
