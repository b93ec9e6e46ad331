#include "viewer/window/icons.h"

#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QPixmap>

namespace stillframe::viewer {
namespace {

constexpr qreal kSize = 48.0;  // side of what draw() fills

void triangle(QPainter& painter, qreal x, qreal width) {
  const QPointF points[] = {{x, 10.0}, {x, 38.0}, {x + width, 24.0}};
  painter.drawPolygon(points, 3);
}

void draw(QPainter& painter, const QPen& pen, TransportIcon icon) {
  const auto outline = [&] {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(pen);
  };
  switch (icon) {
    case TransportIcon::Play:
      triangle(painter, 13, 26);
      return;
    case TransportIcon::Pause:
      painter.drawRect(12, 10, 9, 28);
      painter.drawRect(27, 10, 9, 28);
      return;
    case TransportIcon::StepBack:
      painter.drawRect(11, 10, 5, 28);
      triangle(painter, 38, -20);
      return;
    case TransportIcon::StepForward:
      painter.drawRect(32, 10, 5, 28);
      triangle(painter, 10, 20);
      return;
    case TransportIcon::Loop: {
      outline();
      painter.drawArc(QRectF(11, 11, 26, 26), 60 * 16, 285 * 16);
      painter.setBrush(pen.color());
      painter.setPen(Qt::NoPen);
      const QPointF head[] = {{27.0, 4.0}, {27.0, 20.0}, {38.0, 12.0}};
      painter.drawPolygon(head, 3);
      return;
    }
    case TransportIcon::Recenter:
      outline();
      painter.drawEllipse(QPointF(24, 24), 11, 11);
      painter.drawLine(24, 4, 24, 16);
      painter.drawLine(24, 32, 24, 44);
      painter.drawLine(4, 24, 16, 24);
      painter.drawLine(32, 24, 44, 24);
      return;
    case TransportIcon::Target:
      outline();
      painter.drawEllipse(QPointF(24, 24), 17, 17);
      painter.drawEllipse(QPointF(24, 24), 8, 8);
      painter.drawPoint(24, 24);
      return;
    case TransportIcon::SplitRight:
      outline();
      painter.drawRect(7, 10, 34, 28);
      painter.drawLine(24, 10, 24, 38);
      return;
    case TransportIcon::SplitBelow:
      outline();
      painter.drawRect(7, 10, 34, 28);
      painter.drawLine(7, 24, 41, 24);
      return;
    case TransportIcon::Detach:
      outline();
      painter.drawPolyline(QPolygonF({{22, 12}, {8, 12}, {8, 40}, {36, 40}, {36, 26}}));
      painter.drawLine(20, 28, 40, 8);
      painter.drawPolyline(QPolygonF({{28, 8}, {40, 8}, {40, 20}}));
      return;
    case TransportIcon::Grip:
      for (const int x : {16, 26}) {
        for (const int y : {9, 21, 33}) {
          painter.drawEllipse(x, y, 6, 6);
        }
      }
      return;
    case TransportIcon::Close:
      outline();
      painter.drawLine(13, 13, 35, 35);
      painter.drawLine(35, 13, 13, 35);
      return;
    case TransportIcon::Layers:
      outline();
      for (const qreal y : {13.0, 24.0, 35.0}) {
        painter.drawLine(QPointF(9, y), QPointF(12, y));
        painter.drawLine(QPointF(20, y), QPointF(40, y));
      }
      return;
    case TransportIcon::Effects:
      outline();
      painter.drawEllipse(QPointF(24, 24), 15, 15);
      painter.setBrush(pen.color());
      painter.drawPie(QRectF(9, 9, 30, 30), 90 * 16, 180 * 16);
      return;
    case TransportIcon::More:
      outline();
      for (const qreal x : {10.0, 26.0}) {
        painter.drawPolyline(QPolygonF({{x, 12.0}, {x + 12.0, 24.0}, {x, 36.0}}));
      }
      return;
    case TransportIcon::Legend:
      painter.drawRect(QRectF(8, 12, 16, 12));
      outline();
      painter.drawRect(QRectF(8, 12, 32, 12));
      for (const qreal x : {8.0, 24.0, 40.0}) {
        painter.drawLine(QPointF(x, 31), QPointF(x, 36));
      }
      return;
  }
}

/// Draws at the very size and in the very colours that are asked for: sharp at any scale, right in any theme.
class TransportEngine : public QIconEngine {
 public:
  explicit TransportEngine(TransportIcon icon) : icon_(icon) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State /*state*/) override {
    const auto group = mode == QIcon::Disabled ? QPalette::Disabled : QPalette::Normal;
    const QColor color = QGuiApplication::palette().color(group, QPalette::WindowText);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->translate(rect.topLeft());
    painter->scale(rect.width() / kSize, rect.height() / kSize);
    painter->setBrush(color);
    painter->setPen(Qt::NoPen);
    draw(*painter, QPen(color, 3.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin), icon_);
    painter->restore();
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap pixmap(size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    paint(&painter, QRect(QPoint(0, 0), size), mode, state);
    return pixmap;
  }
  [[nodiscard]] QIconEngine* clone() const override { return new TransportEngine(icon_); }

 private:
  TransportIcon icon_;
};

}  // namespace

QIcon transportIcon(TransportIcon icon) { return QIcon(new TransportEngine(icon)); }

}  // namespace stillframe::viewer
