#pragma once

#include <QImage>
#include <QSurfaceFormat>
#include <QWidget>
#include <cstdint>
#include <memory>

#include "viewer/widget/view_way.h"

class QOpenGLContext;
namespace stillframe::scenegraph::gl {
class Output;
}

namespace stillframe::viewer {

/// A widget that OpenGL draws into, whichever way brings that to the screen. GUI thread.
///
/// On hardware a QOpenGLWidget fills it, and Qt composes its window by OpenGL. Where OpenGL is software that takes
/// longer than anything else the window does, for whatever is painted in it: 11 ms each time at 1280x800, up to 50
/// while workers take the cores. There the view has a context of its own, which outlives moves between windows, and
/// what was drawn is read back and painted as an image: 1 to 2 ms, and a window without any OpenGL.
class GlView : public QWidget {
  Q_OBJECT

 public:
  /// Of views made from now on; Auto at first.
  static void setWay(ViewWay way);
  explicit GlView(QWidget* parent = nullptr);
  ~GlView() override;

  /// Of the context; before the widget is shown.
  void setFormat(const QSurfaceFormat& format);
  [[nodiscard]] QSurfaceFormat format() const;
  /// nullptr before it is made, which painting does, and where it cannot be made.
  [[nodiscard]] QOpenGLContext* context() const;
  void makeCurrent();
  void doneCurrent();
  /// What paintGL() draws into, of the widget's size in device pixels; another one after each change of that.
  [[nodiscard]] std::uint32_t defaultFramebufferObject() const;
  /// What there is to see, after paintGL(). No image without a context.
  [[nodiscard]] QImage grabShown();

 Q_SIGNALS:
  /// It has been painted, and may have been before.
  void painted();

 protected:
  /// The context is current and new, or there is none current when none could be made.
  virtual void initializeGL() = 0;
  /// Returns whether the framebuffer holds something else now.
  virtual bool paintGL() = 0;
  /// Whether paintGL() may be called; else what was shown stays.
  [[nodiscard]] virtual bool mayPaint() const = 0;
  /// What stands for the framebuffer where there is no QOpenGLWidget, to be exchanged for another of its size; else
  /// nullptr.
  [[nodiscard]] std::unique_ptr<scenegraph::gl::Output>* ownOutput();
  /// Calls paintGL() from the event loop, and shows what it has drawn.
  void paintSoon();
  bool event(QEvent* event) override;
  void childEvent(QChildEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;  ///< of children
  void resizeEvent(QResizeEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  class Canvas;
  struct Own;
  bool makeContext();
  void renewFramebuffer(), paintOwn();
  Canvas* canvas_ = nullptr;  // ViewWay::Composed
  std::unique_ptr<Own> own_;  // ViewWay::Image
};

}  // namespace stillframe::viewer
