#include "viewer/widget/gl_view.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLWidget>
#include <QPaintEvent>
#include <QPainter>
#include <algorithm>
#include <optional>
#include <utility>

#include "scenegraph/pipeline/gl_context_info.h"
#include "scenegraph/pipeline/gl_output.h"
#include "viewer/widget/gl_format.h"
#include "viewer/widget/size_px.h"

namespace stillframe::viewer {
namespace {

constexpr QColor kNothing(0x20, 0x22, 0x26);  // where nothing has been drawn yet

ViewWay& wayOfAll() {
  static ViewWay way = ViewWay::Auto;
  return way;
}

/// What was current comes back.
class KeepCurrent {
 public:
  KeepCurrent() : context_(QOpenGLContext::currentContext()), surface_(context_ ? context_->surface() : nullptr) {}
  ~KeepCurrent() {
    if (context_ != nullptr) {
      context_->makeCurrent(surface_);
    }
  }
  KeepCurrent(const KeepCurrent&) = delete;
  KeepCurrent& operator=(const KeepCurrent&) = delete;

 private:
  QOpenGLContext* context_;
  QSurface* surface_;
};

/// Asked of a context, the one that all share where there is one.
bool findSoftware() {
  const KeepCurrent current;
  QOpenGLContext* context = QOpenGLContext::globalShareContext();
  std::optional<QOpenGLContext> own;
  if (context == nullptr) {
    context = &own.emplace();
    context->setFormat(glFormat());
    context->create();
  }
  QOffscreenSurface surface;
  surface.setFormat(context->format());
  surface.create();
  if (!context->isValid() || !context->makeCurrent(&surface)) {
    return false;
  }
  const auto info = scenegraph::inspectCurrentContext();
  context->doneCurrent();
  return info && info->is_software;
}

bool isComposed() {
  if (wayOfAll() != ViewWay::Auto) {
    return wayOfAll() == ViewWay::Composed;
  }
  static const bool is_software = findSoftware();
  return !is_software;
}

}  // namespace

/// Fills the view; what it is asked for goes there.
class GlView::Canvas final : public QOpenGLWidget {
 public:
  explicit Canvas(GlView& view) : QOpenGLWidget(&view), view_(view) {
    setFormat(glFormat());
    setUpdateBehavior(PartialUpdate);  // the last picture stays while the next is drawn
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    connect(this, &QOpenGLWidget::frameSwapped, &view, &GlView::painted);
  }

 protected:
  void initializeGL() override { view_.initializeGL(); }
  void paintGL() override { (void)view_.paintGL(); }
  /// QOpenGLWidget paints within each resize, and once more when the window does: a splitter that settles in three
  /// steps would draw four frames for one that is seen.
  void paintEvent(QPaintEvent* event) override {
    if (view_.mayPaint()) {
      QOpenGLWidget::paintEvent(event);
    }
  }

 private:
  GlView& view_;
};

struct GlView::Own {
  QSurfaceFormat format = glFormat();
  std::unique_ptr<QOffscreenSurface> surface;
  std::unique_ptr<QOpenGLContext> context;  // none before it is wanted
  std::unique_ptr<scenegraph::gl::Output> output;
  QImage image;  // what output holds
  bool has_failed = false;
};

void GlView::setWay(ViewWay way) { wayOfAll() = way; }

GlView::GlView(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAttribute(Qt::WA_NoSystemBackground);
  if (isComposed()) {
    canvas_ = new Canvas(*this);
  } else {
    own_ = std::make_unique<Own>();
  }
}

GlView::~GlView() {
  if (own_ != nullptr && own_->output != nullptr) {
    makeCurrent();
    own_->output.reset();
    doneCurrent();
  }
}

void GlView::setFormat(const QSurfaceFormat& format) {
  if (canvas_ != nullptr) {
    canvas_->setFormat(format);
  } else {
    own_->format = format;
  }
}

QSurfaceFormat GlView::format() const { return canvas_ != nullptr ? canvas_->format() : own_->format; }

QOpenGLContext* GlView::context() const { return canvas_ != nullptr ? canvas_->context() : own_->context.get(); }

void GlView::makeCurrent() {
  if (canvas_ != nullptr) {
    canvas_->makeCurrent();
  } else if (own_->context != nullptr) {
    own_->context->makeCurrent(own_->surface.get());
    if (own_->output != nullptr) {
      own_->output->bind();
    }
  }
}

void GlView::doneCurrent() {
  if (canvas_ != nullptr) {
    canvas_->doneCurrent();
  } else if (own_->context != nullptr) {
    own_->context->doneCurrent();
  }
}

std::uint32_t GlView::defaultFramebufferObject() const {
  if (canvas_ != nullptr) {
    return canvas_->defaultFramebufferObject();
  }
  return own_->output == nullptr ? 0 : own_->output->id();
}

std::unique_ptr<scenegraph::gl::Output>* GlView::ownOutput() {
  return own_ != nullptr && own_->output != nullptr ? &own_->output : nullptr;
}

bool GlView::makeContext() {
  if (own_->context != nullptr || own_->has_failed) {
    return !own_->has_failed;
  }
  auto context = std::make_unique<QOpenGLContext>();
  context->setFormat(own_->format);
  context->setShareContext(QOpenGLContext::globalShareContext());
  if (context->create()) {
    own_->surface = std::make_unique<QOffscreenSurface>();
    own_->surface->setFormat(context->format());
    own_->surface->create();
  }
  own_->has_failed = own_->surface == nullptr || !context->makeCurrent(own_->surface.get());
  if (!own_->has_failed) {
    own_->context = std::move(context);
    renewFramebuffer();
  }
  initializeGL();
  return !own_->has_failed;
}

/// Of the present size, the context being current.
void GlView::renewFramebuffer() {
  const QSize size_px = sizePxOf(*this).expandedTo(QSize(1, 1));
  own_->output.reset();
  own_->output = std::make_unique<scenegraph::gl::Output>(size_px.width(), size_px.height());
  own_->output->bind();
}

void GlView::paintOwn() {
  if (!makeContext()) {
    return;
  }
  makeCurrent();
  if (paintGL()) {
    const scenegraph::gl::Output& output = *own_->output;
    if (own_->image.size() != QSize(output.width(), output.height())) {
      own_->image = QImage(output.width(), output.height(), QImage::Format_RGB32);
    }
    output.read(reinterpret_cast<std::uint32_t*>(own_->image.bits()));
  }
  doneCurrent();
}

QImage GlView::grabShown() {
  if (canvas_ != nullptr) {
    return canvas_->grabFramebuffer();
  }
  paintOwn();
  QImage image = own_->image;
  image.setDevicePixelRatio(devicePixelRatioF());
  return image;
}

void GlView::paintSoon() {
  if (canvas_ != nullptr) {
    canvas_->update();
  } else {
    QWidget::update();
  }
}

bool GlView::event(QEvent* event) {
  const bool is_taken = QWidget::event(event);
  // On a screen with other pixels, without a resize.
  if (event->type() == QEvent::ScreenChangeInternal && own_ != nullptr && own_->output != nullptr &&
      sizePxOf(*this) != QSize(own_->output->width(), own_->output->height())) {
    makeCurrent();
    renewFramebuffer();
    doneCurrent();
  }
  return is_taken;
}

void GlView::childEvent(QChildEvent* event) {
  QWidget::childEvent(event);
  if (canvas_ != nullptr && event->added() && event->child() != canvas_) {
    event->child()->installEventFilter(this);
  }
}

/// The canvas is what all others lie over, the lowest of them too.
bool GlView::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ZOrderChange && canvas_ != nullptr && watched->parent() == this) {
    canvas_->lower();
  }
  return QWidget::eventFilter(watched, event);
}

void GlView::resizeEvent(QResizeEvent* /*event*/) {
  if (canvas_ != nullptr) {
    canvas_->setGeometry(rect());
  } else if (own_->context != nullptr) {
    makeCurrent();
    renewFramebuffer();
    doneCurrent();
  }
}

void GlView::paintEvent(QPaintEvent* event) {
  if (own_ == nullptr) {
    return;
  }
  if (mayPaint()) {
    paintOwn();
  }
  QPainter painter(this);
  QImage& image = own_->image;
  image.setDevicePixelRatio(devicePixelRatioF());
  if (image.isNull() || image.size() != sizePxOf(*this)) {
    painter.fillRect(event->rect(), kNothing);
  }
  painter.drawImage(QPoint(0, 0), image);
  Q_EMIT painted();
}

}  // namespace stillframe::viewer
