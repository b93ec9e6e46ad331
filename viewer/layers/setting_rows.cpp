#include "viewer/layers/setting_rows.h"

#include <QSignalBlocker>
#include <utility>

#include "viewer/layers/range_editor.h"
#include "viewer/layers/setting_editor.h"
#include "viewer/widget/tab_order.h"

namespace stillframe::viewer {

using scenegraph::SettingKind;
using scenegraph::SettingSpec;
using scenegraph::SettingTexts;

SettingRows::SettingRows(QTreeWidget& tree, QTreeWidgetItem& parent) : QObject(&tree), tree_(tree), parent_(parent) {}

void SettingRows::show(const std::vector<SettingSpec>& specs, const SettingTexts& texts) {
  const QSignalBlocker blocker(&tree_);
  if (!isSameSpecs(specs, specs_)) {
    specs_ = specs;
    build();
  }
  for (const auto& [key, editor] : editors_) {
    if (const auto text = texts.find(key); text != texts.end()) {
      editor->setText(text->second);
    }
  }
  if (range_ != nullptr) {
    range_->setTexts(texts);
  }
  showChecks(texts);
}

void SettingRows::build() {
  open_ = openGroups();
  for (QTreeWidgetItem* const item : items_) {
    delete item;  // takes its widget and what is beneath along
  }
  items_.clear();
  editors_.clear();
  groups_.clear();
  range_ = nullptr;
  const bool has_range = RangeEditor::isFor(specs_);
  for (const SettingSpec& spec : specs_) {
    if (!spec.group.empty()) {
      addThing(spec);
    } else if (!has_range || !RangeEditor::covers(spec.key)) {
      addEditor(*addRow(parent_, spec.label, spec.help), spec);
    } else if (range_ == nullptr) {
      addRange(*addRow(parent_, tr("Range").toStdString(), spec.help));
    }
  }
  for (const auto& [name, group] : groups_) {
    group.item->setText(0, QStringLiteral("%1 (%2)").arg(QString::fromStdString(name)).arg(group.things.size()));
    group.item->setExpanded(open_.contains(name));
  }
  orderTabs(tree_);
}

QTreeWidgetItem* SettingRows::addRow(QTreeWidgetItem& parent, const std::string& label, const std::string& help) {
  auto* item = new QTreeWidgetItem(&parent);
  item->setText(0, QString::fromStdString(label));
  item->setToolTip(0, QString::fromStdString(help));
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  if (&parent == &parent_) {
    items_.push_back(item);
  }
  return item;
}

void SettingRows::addThing(const SettingSpec& spec) {
  Group& group = groups_[spec.group];
  if (group.item == nullptr) {
    group.item = addRow(parent_, spec.group, tr("All of them on or off").toStdString());
    group.item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    group.item->setCheckState(0, Qt::Checked);
  }
  Thing& thing = group.things[spec.item];
  if (thing.item == nullptr) {
    thing.item = addRow(*group.item, spec.item, spec.help);
  }
  if (spec.kind == SettingKind::Bool && thing.switch_key.empty()) {
    thing.switch_key = spec.key;
    thing.item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    thing.item->setCheckState(0, Qt::Checked);
  } else if (tree_.itemWidget(thing.item, 1) == nullptr) {
    addEditor(*thing.item, spec);
  } else {
    addEditor(*addRow(*thing.item, spec.label, spec.help), spec);
  }
}

void SettingRows::addEditor(QTreeWidgetItem& item, const SettingSpec& spec) {
  auto* editor = new SettingEditor(spec, {});
  tree_.setItemWidget(&item, 1, editor);
  editors_[spec.key] = editor;
  connect(editor, &SettingEditor::edited, this,
          [this, label = QString::fromStdString(spec.label)](const QString& key, const QString& text) {
            Q_EMIT edited({{key.toStdString(), text.toStdString()}}, label);
          });
}

void SettingRows::addRange(QTreeWidgetItem& item) {
  range_ = new RangeEditor(specs_);
  tree_.setItemWidget(&item, 1, range_);
  connect(range_, &RangeEditor::edited, this, [this](const SettingTexts& texts) { Q_EMIT edited(texts, tr("Range")); });
}

void SettingRows::showChecks(const SettingTexts& texts) {
  for (const auto& [name, group] : groups_) {
    std::size_t on = 0;
    std::size_t switches = 0;
    for (const auto& [thing_name, thing] : group.things) {
      const auto text = texts.find(thing.switch_key);
      if (text == texts.end()) {
        continue;
      }
      const bool is_on = text->second == scenegraph::settingText(true);
      ++switches;
      on += is_on ? 1 : 0;
      thing.item->setCheckState(0, is_on ? Qt::Checked : Qt::Unchecked);
    }
    group.item->setCheckState(0, on == 0 && switches > 0 ? Qt::Unchecked
                                 : on < switches         ? Qt::PartiallyChecked
                                                         : Qt::Checked);
  }
}

bool SettingRows::takeCheck(QTreeWidgetItem* item) {
  const std::string text = scenegraph::settingText(item->checkState(0) == Qt::Checked);
  for (const auto& [name, group] : groups_) {
    SettingTexts texts;
    for (const auto& [thing_name, thing] : group.things) {
      if (!thing.switch_key.empty() && (group.item == item || thing.item == item)) {
        texts[thing.switch_key] = text;
      }
    }
    if (group.item == item || !texts.empty()) {
      Q_EMIT edited(texts, item->text(0));
      return true;
    }
  }
  return false;
}

std::set<std::string> SettingRows::openGroups() const {
  std::set<std::string> names = open_;
  for (const auto& [name, group] : groups_) {
    group.item->isExpanded() ? (void)names.insert(name) : (void)names.erase(name);
  }
  return names;
}

void SettingRows::setOpenGroups(std::set<std::string> names) {
  open_ = std::move(names);
  for (const auto& [name, group] : groups_) {
    group.item->setExpanded(open_.contains(name));
  }
}

SettingEditor* SettingRows::editor(const std::string& key) const {
  const auto found = editors_.find(key);
  return found == editors_.end() ? nullptr : found->second;
}

QTreeWidgetItem* SettingRows::row(const std::string& group, const std::string& item) const {
  const auto found = groups_.find(group);
  if (found == groups_.end() || item.empty()) {
    return found == groups_.end() ? nullptr : found->second.item;
  }
  const auto thing = found->second.things.find(item);
  return thing == found->second.things.end() ? nullptr : thing->second.item;
}

}  // namespace stillframe::viewer
