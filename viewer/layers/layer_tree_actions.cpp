// What can be done with the layers of a LayerTree: from its menu, its keys, and the buttons above it.
#include <QClipboard>
#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QMenu>
#include <algorithm>

#include "scenegraph/layer_list.h"
#include "viewer/layers/layer_tree.h"

namespace stillframe::viewer {

void LayerTree::addLayer(const std::string& id) {
  if (scene_ == nullptr) {
    return;
  }
  std::string added = id;
  if (const scenegraph::LayerSlot* const present = scene_->findLayer(id)) {
    added = scene_->duplicateLayer(*present).id;
  } else if (const auto slot = scene_->addLayer(id); !slot) {
    Q_EMIT refused(QString::fromStdString(slot.error().message));
    return;
  }
  refresh();
  selectLayer(added);
  Q_EMIT changed(tr("add %1").arg(QString::fromStdString(added)), {});
}

void LayerTree::duplicateCurrent() {
  if (const scenegraph::LayerSlot* const slot = currentSlot()) {
    const std::string id = scene_->duplicateLayer(*slot).id;
    refresh();
    selectLayer(id);
    Q_EMIT changed(tr("duplicate %1").arg(QString::fromStdString(slot->title)), {});
  }
}

void LayerTree::removeCurrent() {
  const scenegraph::LayerSlot* const slot = currentSlot();
  if (slot == nullptr) {
    return;
  }
  const QString name = layerName(*slot);
  const int place = indexOfTopLevelItem(item(slot->id));
  scene_->removeLayer(std::string(slot->id));
  refresh();
  setCurrentItem(topLevelItem(std::min(place, topLevelItemCount() - 1)));
  Q_EMIT changed(tr("remove %1").arg(name), {});
}

void LayerTree::renameCurrent() {
  if (QTreeWidgetItem* const row = item(currentLayer())) {
    editItem(row, 0);
  }
}

void LayerTree::moveCurrent(int places) {
  const auto row = std::ranges::find(rows_, currentLayer(), &Row::id);
  if (row != rows_.end()) {
    const auto last = static_cast<std::ptrdiff_t>(rows_.size()) - 1;
    moveLayer(std::string(row->id),
              static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row - rows_.begin() + places, 0, last)));
  }
}

void LayerTree::moveLayer(const std::string& id, std::size_t place) {
  if (scene_ == nullptr) {
    return;
  }
  std::vector<std::string> ids;
  for (const auto& slot : scene_->layers()) {
    ids.push_back(slot->id);
  }
  const auto from = std::ranges::find(ids, id);
  if (from == ids.end() || from - ids.begin() == static_cast<std::ptrdiff_t>(place)) {
    return;
  }
  ids.erase(from);
  ids.insert(ids.begin() + static_cast<std::ptrdiff_t>(std::min(place, ids.size())), id);
  scene_->arrangeLayers(ids);
  refresh();
  selectLayer(id);
  Q_EMIT changed(tr("move %1").arg(layerName(*scene_->findLayer(id))), {});
}

void LayerTree::showOnlyCurrent() {
  const scenegraph::LayerSlot* const only = currentSlot();
  if (only == nullptr) {
    return;
  }
  for (const auto& slot : scene_->layers()) {
    slot->layer->setVisible(slot.get() == only);
  }
  refresh();
  Q_EMIT changed(tr("show only %1").arg(layerName(*only)), {});
}

void LayerTree::showAllLayers() {
  if (scene_ == nullptr) {
    return;
  }
  for (const auto& slot : scene_->layers()) {
    slot->layer->setVisible(true);
  }
  refresh();
  Q_EMIT changed(tr("show all layers"), {});
}

void LayerTree::resetCurrent() {
  if (const scenegraph::LayerSlot* const slot = currentSlot()) {
    scenegraph::SettingTexts settings = slot->type->create(slot->topic)->settings();
    for (const scenegraph::SettingSpec& spec : slot->layer->settingSpecs()) {
      if (spec.kind == scenegraph::SettingKind::Bool && !spec.group.empty()) {
        settings.try_emplace(spec.key, scenegraph::settingText(true));  // what the data alone has begins switched on
      }
    }
    (void)slot->layer->applySettings(settings);  // the type's own
    refresh();
    Q_EMIT changed(tr("reset %1").arg(layerName(*slot)), {});
  }
}

void LayerTree::copyStatus(const std::string& id) const {
  const scenegraph::Status& status = scene_->findLayer(id)->layer->status();
  const std::string line = id + ": " + status.code + (status.message.empty() ? "" : ": " + status.message);
  QGuiApplication::clipboard()->setText(QString::fromStdString(line));
}

void LayerTree::contextMenuEvent(QContextMenuEvent* event) {
  const std::string id = currentLayer();
  if (id.empty() || itemAt(event->pos()) == nullptr) {
    return;
  }
  QMenu menu(this);
  const auto add = [&](const QString& text, const QKeySequence& keys, auto&& action) {
    QAction* const entry = menu.addAction(text, this, action);
    entry->setShortcut(keys);
    return entry;
  };
  add(tr("Rename"), Qt::Key_F2, [this] { renameCurrent(); });
  add(tr("Duplicate"), Qt::CTRL | Qt::Key_D, [this] { duplicateCurrent(); });
  add(tr("Remove"), Qt::Key_Delete, [this] { removeCurrent(); });
  menu.addSeparator();
  add(tr("Move up"), Qt::CTRL | Qt::Key_Up, [this] { moveCurrent(-1); });
  add(tr("Move down"), Qt::CTRL | Qt::Key_Down, [this] { moveCurrent(1); });
  menu.addSeparator();
  add(tr("Show only this"), {}, [this] { showOnlyCurrent(); });
  add(tr("Show all"), {}, [this] { showAllLayers(); });
  add(tr("Reset settings"), {}, [this] { resetCurrent(); });
  add(tr("Copy status"), {}, [this, id] { copyStatus(id); });
  menu.exec(event->globalPos());
}

}  // namespace stillframe::viewer
