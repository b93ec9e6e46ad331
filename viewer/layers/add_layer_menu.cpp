#include "viewer/layers/add_layer_menu.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QVBoxLayout>
#include <QWidgetAction>
#include <algorithm>
#include <string>
#include <vector>

namespace stillframe::viewer {

AddLayerMenu::AddLayerMenu(QWidget* parent) : QMenu(parent), search_(new QLineEdit), list_(new QListWidget) {
  auto* page = new QWidget(this);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addWidget(search_);
  layout->addWidget(list_);
  search_->setPlaceholderText(tr("Search"));
  list_->setMinimumSize(300, 220);
  list_->setUniformItemSizes(true);
  auto* action = new QWidgetAction(this);
  action->setDefaultWidget(page);
  addAction(action);
  search_->installEventFilter(this);
  connect(search_, &QLineEdit::textChanged, this, &AddLayerMenu::filter);
  connect(search_, &QLineEdit::returnPressed, this, &AddLayerMenu::choose);
  connect(list_, &QListWidget::itemClicked, this, &AddLayerMenu::choose);
}

void AddLayerMenu::fill(const scenegraph::Scene* scene) {
  list_->clear();
  search_->clear();
  search_->setFocus();
  if (scene == nullptr) {
    return;
  }
  std::vector<std::string> topics = scene->drawableTopics();
  const auto has_layer = [&](const std::string& topic) {
    return std::ranges::any_of(scene->layers(), [&](const auto& slot) { return slot->topic == topic; });
  };
  std::ranges::stable_partition(topics, [&](const std::string& topic) { return !has_layer(topic); });
  for (const std::string& topic : topics) {
    const QString name = QString::fromStdString(topic);
    auto* item = new QListWidgetItem(has_layer(topic) ? tr("%1 (another)").arg(name) : name, list_);
    item->setData(Qt::UserRole, name);
  }
  list_->setCurrentRow(0);
}

void AddLayerMenu::filter(const QString& text) {
  QListWidgetItem* first = nullptr;
  for (int i = 0; i < list_->count(); ++i) {
    QListWidgetItem* const item = list_->item(i);
    item->setHidden(!item->text().contains(text, Qt::CaseInsensitive));
    first = first == nullptr && !item->isHidden() ? item : first;
  }
  list_->setCurrentItem(first);
}

void AddLayerMenu::choose() {
  const QListWidgetItem* const item = list_->currentItem();
  if (item != nullptr && !item->isHidden()) {
    const QString id = item->data(Qt::UserRole).toString();
    close();
    Q_EMIT chosen(id);
  }
}

/// The arrows move in the list while the user types.
bool AddLayerMenu::eventFilter(QObject* watched, QEvent* event) {
  if (watched == search_ && event->type() == QEvent::KeyPress) {
    const int step = static_cast<QKeyEvent*>(event)->key() == Qt::Key_Down ? 1
                     : static_cast<QKeyEvent*>(event)->key() == Qt::Key_Up ? -1
                                                                           : 0;
    if (step != 0) {
      for (int row = list_->currentRow() + step; row >= 0 && row < list_->count(); row += step) {
        if (!list_->item(row)->isHidden()) {
          list_->setCurrentRow(row);
          break;
        }
      }
      return true;
    }
  }
  return QMenu::eventFilter(watched, event);
}

}  // namespace stillframe::viewer
