#include "viewer/layers/layer_tree.h"

#include <QDropEvent>
#include <QHeaderView>
#include <QLocale>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSignalBlocker>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "scenegraph/how_many.h"
#include "scenegraph/layer_cost.h"
#include "scenegraph/layer_list.h"
#include "viewer/layers/editor_keys.h"
#include "viewer/layers/histogram_feed.h"
#include "viewer/layers/layer_delegate.h"
#include "viewer/layers/range_editor.h"
#include "viewer/layers/setting_rows.h"

namespace stillframe::viewer {
namespace {

using scenegraph::StatusLevel;

QString toQString(std::string_view text) { return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size())); }

/// Without "'TOPIC' at TIME s: ": the row is of that topic, and the time is the tracker's or a little earlier.
QString reason(const QString& sentence) {
  static const QRegularExpression place(QStringLiteral("^'[^']*' at -?\\d+\\.\\d+ s: "));
  return QString(sentence).remove(place);
}

/// A sentence as long as a row has room for; the rest is beneath it, and in the tool tip.
QString beginning(const QString& sentence) {
  constexpr qsizetype kMost = 110;
  if (sentence.size() <= kMost) {
    return sentence;
  }
  const qsizetype space = sentence.lastIndexOf(QLatin1Char(' '), kMost);
  return sentence.left(space > kMost / 2 ? space : kMost) + QStringLiteral(" ...");
}

}  // namespace

QString layerName(const scenegraph::LayerSlot& slot) {
  const bool is_builtin = slot.type->consumes == scenegraph::ObjectType::None;
  if (!is_builtin || slot.title != slot.id) {
    return QString::fromStdString(slot.title);
  }
  return toQString(slot.type->label) + QString::fromStdString(slot.id.substr(slot.topic.size()));  // of a copy: "#2"
}

QString counted(std::uint64_t count, std::string_view plural) {
  return QLocale().toString(static_cast<qulonglong>(count)) + QLatin1Char(' ') +
         QString::fromStdString(scenegraph::nounOf(count, plural));
}

QString statusLine(const scenegraph::Layer& layer) {
  if (!layer.isVisible()) {
    return {};
  }
  const scenegraph::Status& status = layer.status();
  if (status.level >= StatusLevel::Warn) {
    return beginning(reason(QString::fromStdString(status.message.empty() ? status.code : status.message)));
  }
  QStringList parts;
  if (const auto counts = layer.counts(); !counts.empty()) {
    const auto& [name, count] = counts.front();
    parts << counted(count, name);
  }
  if (status.level == StatusLevel::Info) {
    parts << QString::fromStdString(status.code);
  }
  return parts.join(QStringLiteral(", "));
}

LayerTree::LayerTree(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(2);
  setHeaderHidden(true);
  setUniformRowHeights(false);
  setIndentation(14);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setDragDropMode(QAbstractItemView::InternalMove);
  setEditTriggers(QAbstractItemView::EditKeyPressed);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  header()->setSectionResizeMode(0, QHeaderView::Interactive);
  header()->setStretchLastSection(true);
  header()->resizeSection(0, 128);
  setTextElideMode(Qt::ElideMiddle);
  setWordWrap(true);
  setItemDelegate(new LayerDelegate(*this));
  new EditorKeys(*this);
  connect(header(), &QHeaderView::sectionResized, this, &LayerTree::scheduleDelayedItemsLayout);
  connect(this, &QTreeWidget::itemChanged, this, &LayerTree::onItemChanged);
  connect(this, &QTreeWidget::itemExpanded, this, [this](const QTreeWidgetItem* opened) {
    if (const auto row = std::ranges::find(rows_, opened, &Row::item); row != rows_.end()) {
      showDetails(*row, *scene_->findLayer(row->id));
      if (currentLayer() != row->id) {
        selectLayer(row->id);  // what is opened is meant by the buttons, too
      }
    }
  });
}

void LayerTree::setScene(scenegraph::Scene* scene) {
  clearRows();
  scene_ = scene;
  refresh();
}

void LayerTree::clearRows() {
  const QSignalBlocker blocker(this);
  for (const Row& row : rows_) {
    delete row.settings;
  }
  rows_.clear();
  draw_times_.clear();
  clear();
}

void LayerTree::refresh() {
  const QSignalBlocker blocker(this);
  if (scene_ == nullptr) {
    return;
  }
  const auto& layers = scene_->layers();
  const auto is_row_of = [](const Row& row, const auto& slot) { return row.layer == slot->layer.get(); };
  // Layers are appended as topics appear; anything else (a removal, another order) rebuilds.
  const int scrolled = verticalScrollBar()->value();
  const bool is_new =
      rows_.size() > layers.size() || !std::equal(rows_.begin(), rows_.end(), layers.begin(), is_row_of);
  if (is_new) {
    rebuild();
  }
  for (std::size_t i = rows_.size(); i < layers.size(); ++i) {
    rows_.push_back(addRow(*layers[i]));
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const auto state = row.layer->isVisible() ? Qt::Checked : Qt::Unchecked;
    if (row.item->checkState(0) != state) {
      row.item->setCheckState(0, state);
    }
    if (const QString name = layerName(*layers[i]); row.item->text(0) != name) {
      row.item->setText(0, name);
    }
    showStatus(row);
    if (row.item->isExpanded()) {
      showDetails(row, *layers[i]);
    }
  }
  if (is_new) {
    executeDelayedItemsLayout();  // before it, nothing is as far down as it was
    verticalScrollBar()->setValue(scrolled);
  }
}

/// What is worth its price only while somebody looks: the settings, whose widgets are many, the cost, and the values
/// behind the range.
void LayerTree::showDetails(const Row& row, const scenegraph::LayerSlot& slot) {
  showSettings(row);
  scenegraph::LayerCost cost = scenegraph::layerCost(slot);
  if (draw_times_.size() == rows_.size() && measured_revision_ == scene_->settingsRevision()) {
    cost.draw_ms = draw_times_[static_cast<std::size_t>(indexOfTopLevelItem(row.item))];
  }
  const QString text = QString::fromStdString(scenegraph::costText(cost));
  if (row.cost->text(0) != text) {
    row.cost->setText(0, text);
    scheduleDelayedItemsLayout();  // it may take another line
  }
  if (RangeEditor* const range = row.settings->range()) {
    const auto legend = row.layer->legend();
    range->setLegend(legend);
    if (auto work = legend ? row.layer->histogramWork() : nullptr) {
      row.histograms->request(std::move(work), scene_->executor());
    } else {
      range->setHistogram({});
    }
  }
}

void LayerTree::showSettings(const Row& row) { row.settings->show(row.layer->settingSpecs(), row.layer->settings()); }

void LayerTree::setDrawTimes(std::vector<std::optional<double>> times) {
  draw_times_ = std::move(times);
  measured_revision_ = scene_ == nullptr ? 0 : scene_->settingsRevision();
  refresh();
}

void LayerTree::rebuild() {
  std::set<std::string> open;
  std::map<std::string, std::set<std::string>> groups;
  for (const Row& row : rows_) {
    groups[row.id] = row.settings->openGroups();
    if (row.item->isExpanded()) {
      open.insert(row.id);
    }
  }
  const std::string current = currentLayer();
  clearRows();
  for (const auto& slot : scene_->layers()) {
    rows_.push_back(addRow(*slot));
    rows_.back().item->setExpanded(open.contains(slot->id));
    rows_.back().settings->setOpenGroups(groups[slot->id]);
  }
  setCurrentItem(item(current));
}

LayerTree::Row LayerTree::addRow(const scenegraph::LayerSlot& slot) {
  Row row{.id = slot.id, .layer = slot.layer.get(), .item = new QTreeWidgetItem(this)};
  row.item->setText(0, layerName(slot));
  row.item->setToolTip(0, QString::fromStdString(slot.id) + QStringLiteral("\n") + toQString(slot.type->label));
  row.item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable | Qt::ItemIsSelectable | Qt::ItemIsEditable |
                     Qt::ItemIsDragEnabled);
  row.item->setCheckState(0, Qt::Checked);
  row.note = new QTreeWidgetItem(row.item);
  row.note->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  row.note->setFirstColumnSpanned(true);
  row.note->setData(0, LayerDelegate::kIsNote, true);
  row.cost = new QTreeWidgetItem(row.item);
  row.cost->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  row.cost->setFirstColumnSpanned(true);
  row.cost->setData(0, LayerDelegate::kIsNote, true);
  row.cost->setToolTip(0, tr("What the layer costs; Draw times above takes the time to draw it, too"));
  row.settings = new SettingRows(*this, *row.item);
  row.histograms = new HistogramFeed(row.settings);
  connect(row.histograms, &HistogramFeed::counted, row.settings,
          [settings = row.settings](const scenegraph::ValueHistogram& histogram) {
            if (RangeEditor* const range = settings->range()) {
              range->setHistogram(histogram);
            }
          });
  connect(
      row.settings, &SettingRows::edited, this,
      [this, id = slot.id](const scenegraph::SettingTexts& texts, const QString& label) { apply(id, texts, label); });
  return row;
}

void LayerTree::showStatus(const Row& row) {
  const scenegraph::Status& status = row.layer->status();
  const QString line = statusLine(*row.layer);
  const int level = row.layer->isVisible() ? static_cast<int>(status.level) : -1;
  const QString note = level > static_cast<int>(StatusLevel::Ok) ? QString::fromStdString(status.message) : QString();
  if (row.item->text(1) == line && row.item->data(1, Qt::UserRole) == level && !row.item->icon(1).isNull() &&
      row.note->text(0) == note) {
    return;
  }
  row.item->setText(1, line);
  row.item->setData(1, Qt::UserRole, level);
  row.item->setIcon(1, statusIcon(level));
  row.note->setText(0, note);
  row.note->setHidden(note.isEmpty());
  scheduleDelayedItemsLayout();
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

const LayerTree::Row* LayerTree::findRow(const std::string& id) const {
  const auto found = std::ranges::find(rows_, id, &Row::id);
  return found == rows_.end() ? nullptr : &*found;
}

QTreeWidgetItem* LayerTree::item(const std::string& id) const {
  const Row* const row = findRow(id);
  return row == nullptr ? nullptr : row->item;
}

SettingRows* LayerTree::settingRows(const std::string& id) const {
  const Row* const row = findRow(id);
  if (row == nullptr) {
    return nullptr;
  }
  showSettings(*row);
  return row->settings;
}

std::string LayerTree::currentLayer() const {
  QTreeWidgetItem* top = currentItem();
  while (top != nullptr && top->parent() != nullptr) {
    top = top->parent();
  }
  const auto found = std::ranges::find(rows_, top, &Row::item);
  return top == nullptr || found == rows_.end() ? std::string() : found->id;
}

scenegraph::LayerSlot* LayerTree::currentSlot() const {
  return scene_ == nullptr ? nullptr : scene_->findLayer(currentLayer());
}

void LayerTree::selectLayer(const std::string& id) {
  QTreeWidgetItem* const row = item(id);
  setCurrentItem(row);
  if (row != nullptr) {
    scrollToItem(row);  // the current one already has not been scrolled to by that
  }
}

void LayerTree::onItemChanged(QTreeWidgetItem* item) {
  for (const Row& row : rows_) {
    if (row.item == item) {
      takeRow(row);
      return;
    }
    if (row.item == item->parent() || (item->parent() != nullptr && row.item == item->parent()->parent())) {
      row.settings->takeCheck(item);
      return;
    }
  }
}

void LayerTree::takeRow(const Row& row) {
  const bool is_wanted = row.item->checkState(0) == Qt::Checked;
  if (row.layer->isVisible() != is_wanted) {
    row.layer->setVisible(is_wanted);
    const QString name = row.item->text(0);
    refresh();
    Q_EMIT changed(is_wanted ? tr("show %1").arg(name) : tr("hide %1").arg(name), {});
    return;
  }
  scenegraph::LayerSlot& slot = *scene_->findLayer(row.id);
  if (row.item->text(0) != layerName(slot)) {
    (void)scenegraph::applyLayerSettings({{"title", row.item->text(0).trimmed().toStdString()}}, slot);
    refresh();
    Q_EMIT changed(tr("rename %1").arg(layerName(slot)), {});
  }
}

void LayerTree::apply(const std::string& id, const scenegraph::SettingTexts& texts, const QString& label) {
  const Row* const row = findRow(id);
  const auto applied = row->layer->applySettings(texts);
  if (applied) {
    Q_EMIT changed(tr("%1 of %2").arg(label, row->item->text(0)),
                   QString::fromStdString(id + "\n" + texts.begin()->first));
  } else {
    Q_EMIT refused(QString::fromStdString(applied.error().message));
  }
  refresh();  // other settings may follow from these; what was refused goes back
}

void LayerTree::dropEvent(QDropEvent* event) {
  // The list moves, not the rows: those are built from it anew, with their widgets.
  event->setDropAction(Qt::IgnoreAction);
  event->accept();
  const std::string dragged = currentLayer();
  QTreeWidgetItem* target = itemAt(event->position().toPoint());
  while (target != nullptr && target->parent() != nullptr) {
    target = target->parent();
  }
  std::size_t place = target == nullptr ? rows_.size() : static_cast<std::size_t>(indexOfTopLevelItem(target));
  if (dropIndicatorPosition() == QAbstractItemView::BelowItem) {
    ++place;
  }
  const auto from = std::ranges::find(rows_, dragged, &Row::id) - rows_.begin();
  place -= static_cast<std::size_t>(from) < place ? 1 : 0;
  QMetaObject::invokeMethod(this, [this, dragged, place] { moveLayer(dragged, place); }, Qt::QueuedConnection);
}

}  // namespace stillframe::viewer
