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

/// Saves pictures of views and windows as files. Views are drawn on the GUI thread, a moment after they are asked for,
/// so that the window can say so first: a huge picture takes its time. Encoding and writing are done on a worker. GUI
/// thread. `executor` must outlive it; files under way are written to their end.
class PictureSaver : public QObject {
  Q_OBJECT

 public:
  explicit PictureSaver(scenegraph::Executor& executor, QObject* parent = nullptr);

  /// .exr (scene-linear, with depth), or .png whatever else the name ends in.
  void saveView(SceneWidget& view, PictureRequest request, const QString& file);
  /// All of the widget as it is on the screen, in its pixels.
  void saveWindow(QWidget& window, const QString& file);
  /// Pictures that are being drawn or written.
  [[nodiscard]] int pending() const noexcept { return pending_; }

 Q_SIGNALS:
  /// Each request begins with this, before anything is drawn, and ends with saved() or failed().
  void started(int width_px, int height_px);
  /// The picture is drawn; it is being written.
  void drawn();
  void saved(const QString& file, int width_px, int height_px);
  void failed(const QString& message);

 private:
  void drawView(SceneWidget& view, const PictureRequest& request, const QString& file);
  void fail(const QString& message);
  void write(std::function<std::expected<void, scenegraph::Status>()> work, const QString& file, int width, int height);

  scenegraph::Executor& executor_;
  int pending_ = 0;
};

}  // namespace stillframe::viewer
