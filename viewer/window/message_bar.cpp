#include "viewer/window/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "viewer/window/icons.h"

namespace stillframe::viewer {

MessageBar::MessageBar(QWidget* parent) : QFrame(parent) {
  setObjectName(QStringLiteral("messageBar"));
  setAutoFillBackground(true);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 4, 4, 4);
  label_ = new QLabel(this);
  label_->setWordWrap(true);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label_->setTextFormat(Qt::PlainText);
  layout->addWidget(label_, 1);
  auto* close = new QToolButton(this);
  close->setAutoRaise(true);
  close->setIcon(transportIcon(TransportIcon::Close));
  close->setToolTip(tr("Close this message"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  layout->addWidget(close, 0, Qt::AlignTop);
  hide();
}

void MessageBar::showMessage(scenegraph::StatusLevel level, const QString& text) {
  const bool is_error = level == scenegraph::StatusLevel::Error;
  QPalette colors = palette();
  colors.setColor(QPalette::Window, is_error ? QColor(0x8c, 0x2b, 0x26) : QColor(0x7a, 0x58, 0x12));
  colors.setColor(QPalette::WindowText, Qt::white);
  setPalette(colors);
  label_->setPalette(colors);
  label_->setText(text);
  show();
}

QString MessageBar::text() const { return isHidden() ? QString() : label_->text(); }

}  // namespace stillframe::viewer
