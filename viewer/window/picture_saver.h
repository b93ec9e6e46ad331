#pragma once

#include <QObject>
#include <QPointer>
#include <QSize>
#include <QString>
#include <atomic>
#include <deque>
#include <expected>
#include <functional>
#include <memory>

#include "scenegraph/executor.h"
#include "scenegraph/export/picture_io.h"
#include "scenegraph/status.h"
#include "viewer/widget/picture_request.h"

class QWidget;

namespace stillframe::viewer {

class SceneWidget;

/// Saves pictures of views and windows as files. Views are drawn on the GUI thread, one picture after the other and
/// each in steps from the event loop, a moment after it is asked for, so that the window can say so first: a huge
/// picture takes its time. Encoding and writing are done on a worker. GUI thread. `executor` must outlive it; files
/// under way are written to their end, unless cancel() is called.
class PictureSaver : public QObject {
  Q_OBJECT

 public:
  explicit PictureSaver(scenegraph::Executor& executor, QObject* parent = nullptr);

  /// .exr (scene-linear, with depth), or .png whatever else the name ends in.
  void saveView(SceneWidget& view, PictureRequest request, const QString& file);
  /// All of the widget as it is on the screen, in its pixels.
  void saveWindow(QWidget& window, const QString& file);
  /// Gives up whatever is being drawn or written; files that were there stay. Each ends with cancelled().
  void cancel();
  /// Pictures that are being drawn or written.
  [[nodiscard]] int pending() const noexcept { return pending_; }

 Q_SIGNALS:
  /// Each request begins with this, before anything is drawn, and ends with saved(), failed() or cancelled().
  void started(int width_px, int height_px);
  /// How much is done of the picture that is being drawn, or that is being written.
  void progressed(double share);
  /// The picture is drawn; it is being written.
  void drawn();
  void saved(const QString& file, int width_px, int height_px);
  void failed(const QString& message);
  void cancelled();

 private:
  struct Job {
    QPointer<SceneWidget> view;
    PictureRequest request;
    QString file;
    bool is_begun = false;
  };
  using Token = std::shared_ptr<std::atomic<bool>>;
  using Work = std::function<std::expected<void, scenegraph::Status>(const scenegraph::WriteProgress& progress)>;
  void drawNext();
  void step();
  void fail(const QString& message);
  void write(Work work, Token is_cancelled, const QString& file, QSize size);

  scenegraph::Executor& executor_;
  std::deque<Job> jobs_;                                             // to be drawn; the first is under way
  Token is_cancelled_ = std::make_shared<std::atomic<bool>>(false);  // of what is pending
  int pending_ = 0;
};

}  // namespace stillframe::viewer
