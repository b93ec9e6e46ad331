#include "viewer/layers/legend_overlay.h"

#include <QEvent>
#include <QImage>
#include <QPixmap>

namespace stillframe::viewer {
namespace {

constexpr int kMargin = 10;

}  // namespace

LegendOverlay::LegendOverlay(QWidget& view) : QLabel(&view) {
  setObjectName(QStringLiteral("legend"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  hide();
  view.installEventFilter(this);
}

void LegendOverlay::refresh(const scenegraph::Scene* scene) {
  auto entries = scene == nullptr || !is_enabled_ ? std::vector<nodes::LegendEntry>() : nodes::legendEntries(*scene);
  if (entries != entries_) {
    entries_ = std::move(entries);
    draw();
  }
}

void LegendOverlay::setEnabledByUser(bool enabled) {
  is_enabled_ = enabled;
  if (!enabled) {
    refresh(nullptr);
  }
}

void LegendOverlay::draw() {
  const QWidget& view = *parentWidget();
  const double ratio = devicePixelRatioF();
  const QSize size_px = view.size() * ratio;
  const nodes::LegendPicture picture = nodes::drawFittingLegends(entries_, ratio, size_px.width(), size_px.height());
  setVisible(!picture.isEmpty());
  if (picture.isEmpty()) {
    return;
  }
  QPixmap pixmap =
      QPixmap::fromImage(QImage(picture.rgba.data(), picture.width, picture.height, QImage::Format_RGBA8888));
  pixmap.setDevicePixelRatio(ratio);
  setPixmap(pixmap);
  resize(pixmap.deviceIndependentSize().toSize());
  move(view.width() - width() - kMargin, view.height() - height() - kMargin);
  lower();  // beneath what is measured
}

bool LegendOverlay::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) {
    draw();
  }
  return QLabel::eventFilter(watched, event);
}

}  // namespace stillframe::viewer
