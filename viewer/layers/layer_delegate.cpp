#include "viewer/layers/layer_delegate.h"

#include <QPainter>
#include <QTreeWidget>
#include <algorithm>

#include "scenegraph/status.h"

namespace stillframe::viewer {
namespace {

using scenegraph::StatusLevel;

QColor levelColor(StatusLevel level) {
  switch (level) {
    case StatusLevel::Ok:
      return QColor(0x4c, 0xaf, 0x50);
    case StatusLevel::Info:
      return QColor(0x42, 0x9b, 0xe8);
    case StatusLevel::Warn:
      return QColor(0xf0, 0xa0, 0x30);
    case StatusLevel::Error:
      return QColor(0xe5, 0x53, 0x4b);
  }
  return Qt::gray;
}

}  // namespace

QIcon statusIcon(int level) {
  QPixmap pixmap(24, 24);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(level < 0 ? QColor(Qt::gray) : levelColor(static_cast<StatusLevel>(level)));
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(5, 5, 14, 14);
  return QIcon(pixmap);
}

LayerDelegate::LayerDelegate(QTreeWidget& tree) : QStyledItemDelegate(&tree), tree_(tree) {}

QSize LayerDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  QSize hint = QStyledItemDelegate::sizeHint(option, index);
  const bool is_note = index.data(kIsNote).toBool();
  const bool is_status = index.column() == 1 && !index.parent().isValid();
  if (is_note || is_status) {
    constexpr int kIconAndMargins = 30;
    const int room = is_note ? tree_.viewport()->width() - 2 * tree_.indentation() : tree_.columnWidth(1);
    const QRect text = option.fontMetrics.boundingRect(QRect(0, 0, std::max(40, room - kIconAndMargins), 10'000),
                                                       Qt::TextWordWrap, index.data(Qt::DisplayRole).toString());
    hint.setHeight(std::max(hint.height(), text.height() + 4));
    hint.setWidth(std::min(hint.width(), room));
  }
  return hint;
}

QWidget* LayerDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                                     const QModelIndex& index) const {
  return index.column() == 0 ? QStyledItemDelegate::createEditor(parent, option, index) : nullptr;
}

void LayerDelegate::initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const {
  QStyledItemDelegate::initStyleOption(option, index);
  if (index.data(kIsNote).toBool()) {
    option->textElideMode = Qt::ElideNone;
    option->font.setItalic(true);
  } else if (index.column() == 0) {
    option->features &= ~QStyleOptionViewItem::WrapText;
  } else {
    option->textElideMode = Qt::ElideNone;
  }
}

}  // namespace stillframe::viewer
