#include "viewer/layers/layer_panel.h"

#include <QApplication>
#include <QHeaderView>
#include <QLocale>
#include <QPainter>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <algorithm>

#include "viewer/layers/setting_editor.h"

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

QIcon dotIcon(const QColor& color) {
  QPixmap pixmap(24, 24);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(color);
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(5, 5, 14, 14);
  return QIcon(pixmap);
}

/// Lets rows grow with their status, which is a sentence: QTreeView itself reckons with one line.
class StatusDelegate : public QStyledItemDelegate {
 public:
  explicit StatusDelegate(QTreeWidget& tree) : QStyledItemDelegate(&tree), tree_(tree) {}

  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QSize hint = QStyledItemDelegate::sizeHint(option, index);
    if (index.column() == 1 && !index.parent().isValid()) {
      constexpr int kIconAndMargins = 30;
      const int width = std::max(40, tree_.columnWidth(1) - kIconAndMargins);
      const QRect text = option.fontMetrics.boundingRect(QRect(0, 0, width, 10'000), Qt::TextWordWrap,
                                                         index.data(Qt::DisplayRole).toString());
      hint.setHeight(std::max(hint.height(), text.height() + 4));
    }
    return hint;
  }

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (index.column() == 0) {
      option->features &= ~QStyleOptionViewItem::WrapText;
    } else {
      option->textElideMode = Qt::ElideNone;
    }
  }

 private:
  QTreeWidget& tree_;
};

}  // namespace

QString statusLine(const scenegraph::Layer& layer) {
  if (!layer.isVisible()) {
    return {};
  }
  const scenegraph::Status& status = layer.status();
  if (status.level >= StatusLevel::Warn) {
    return QString::fromStdString(status.message.empty() ? status.code : status.message);
  }
  QStringList parts;
  if (const auto counts = layer.counts(); !counts.empty()) {
    const auto& [name, count] = counts.front();
    parts << QLocale().toString(static_cast<qulonglong>(count)) + QLatin1Char(' ') + QString::fromStdString(name);
  }
  if (status.level == StatusLevel::Info) {
    parts << QString::fromStdString(status.code);
  }
  return parts.join(QStringLiteral(", "));
}

LayerPanel::LayerPanel(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(2);
  setHeaderHidden(true);
  setUniformRowHeights(false);
  setIndentation(14);
  setSelectionMode(QAbstractItemView::NoSelection);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  header()->setSectionResizeMode(0, QHeaderView::Interactive);
  header()->setStretchLastSection(true);
  header()->resizeSection(0, 128);
  setTextElideMode(Qt::ElideMiddle);
  setWordWrap(true);
  setItemDelegate(new StatusDelegate(*this));
  connect(header(), &QHeaderView::sectionResized, this, &LayerPanel::scheduleDelayedItemsLayout);
  connect(this, &QTreeWidget::itemChanged, this, &LayerPanel::onItemChanged);
}

void LayerPanel::setScene(scenegraph::Scene* scene) {
  rows_.clear();
  clear();
  scene_ = scene;
  refresh();
}

void LayerPanel::refresh() {
  const QSignalBlocker blocker(this);
  if (scene_ == nullptr) {
    return;
  }
  const auto& layers = scene_->layers();
  // Layers are appended as topics appear; anything else (a removal) rebuilds.
  bool is_prefix = rows_.size() <= layers.size();
  for (std::size_t i = 0; is_prefix && i < rows_.size(); ++i) {
    is_prefix = rows_[i].layer == layers[i]->layer.get();
  }
  if (!is_prefix) {
    rows_.clear();
    clear();
  }
  for (std::size_t i = rows_.size(); i < layers.size(); ++i) {
    rows_.push_back(addRow(*layers[i]));
  }
  for (Row& row : rows_) {
    const auto state = row.layer->isVisible() ? Qt::Checked : Qt::Unchecked;
    if (row.item->checkState(0) != state) {
      row.item->setCheckState(0, state);
    }
    showStatus(row);
    buildEditors(row);
  }
}

LayerPanel::Row LayerPanel::addRow(const scenegraph::LayerSlot& slot) {
  Row row;
  row.layer = slot.layer.get();
  row.item = new QTreeWidgetItem(this);
  const QString label = QString::fromUtf8(slot.type->label.data(), static_cast<qsizetype>(slot.type->label.size()));
  const bool is_builtin = slot.type->consumes == scenegraph::ObjectType::None && slot.title == slot.topic;
  row.item->setText(0, is_builtin ? label : QString::fromStdString(slot.title));
  row.item->setToolTip(0, is_builtin ? label : QString::fromStdString(slot.topic) + QStringLiteral("\n") + label);
  row.item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable);
  row.item->setCheckState(0, Qt::Checked);
  return row;
}

void LayerPanel::showStatus(const Row& row) const {
  const scenegraph::Status& status = row.layer->status();
  const QString line = statusLine(*row.layer);
  const int level = row.layer->isVisible() ? static_cast<int>(status.level) : -1;
  if (row.item->text(1) == line && row.item->data(1, Qt::UserRole) == level && !row.item->icon(1).isNull()) {
    return;
  }
  row.item->setText(1, line);
  row.item->setData(1, Qt::UserRole, level);
  row.item->setIcon(1, dotIcon(level < 0 ? QColor(Qt::gray) : levelColor(status.level)));
  QString tip = QString::fromStdString(status.code);
  if (!status.message.empty()) {
    tip += QStringLiteral(": ") + QString::fromStdString(status.message);
  }
  for (const auto& [name, count] : row.layer->counts()) {
    tip += QStringLiteral("\n%1: %2")
               .arg(QString::fromStdString(name), QLocale().toString(static_cast<qulonglong>(count)));
  }
  row.item->setToolTip(1, tip);
}

void LayerPanel::buildEditors(Row& row) {
  const auto texts = row.layer->settings();
  auto specs = row.layer->settingSpecs();
  if (!isSameSpecs(specs, row.specs)) {
    qDeleteAll(row.item->takeChildren());
    row.editors.clear();
    for (const auto& spec : specs) {
      const auto text = texts.find(spec.key);
      auto* item = new QTreeWidgetItem(row.item);
      item->setText(0, QString::fromStdString(spec.label));
      item->setToolTip(0, QString::fromStdString(spec.help));
      item->setFlags(Qt::ItemIsEnabled);
      auto* editor = new SettingEditor(spec, text == texts.end() ? std::string() : text->second);
      setItemWidget(item, 1, editor);
      row.editors[spec.key] = editor;
      connect(editor, &SettingEditor::edited, this,
              [this, editor, layer = row.layer](const QString& key, const QString& value) {
                const auto applied = layer->applySettings({{key.toStdString(), value.toStdString()}});
                if (!applied) {
                  Q_EMIT refused(QString::fromStdString(applied.error().message));
                  const auto kept = layer->settings();
                  const auto old = kept.find(key.toStdString());
                  editor->setText(old == kept.end() ? std::string() : old->second);
                  return;
                }
                Q_EMIT changed();
              });
    }
    row.specs = std::move(specs);
  }
  for (const auto& [key, editor] : row.editors) {
    const auto text = texts.find(key);
    if (text != texts.end()) {
      editor->setText(text->second);
    }
  }
}

void LayerPanel::onItemChanged(QTreeWidgetItem* item) {
  for (const Row& row : rows_) {
    if (row.item == item) {
      const bool is_wanted = item->checkState(0) == Qt::Checked;
      if (row.layer->isVisible() != is_wanted) {
        row.layer->setVisible(is_wanted);
        Q_EMIT changed();
      }
      return;
    }
  }
}

}  // namespace stillframe::viewer
