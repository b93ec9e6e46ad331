#include "viewer/view/effect_panel.h"

#include <QHeaderView>
#include <QSignalBlocker>

#include "viewer/layers/editor_keys.h"
#include "viewer/layers/setting_editor.h"

namespace stillframe::viewer {
namespace {

QString toQString(std::string_view text) { return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size())); }

}  // namespace

EffectPanel::EffectPanel(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(2);
  setHeaderHidden(true);
  setIndentation(14);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  header()->setStretchLastSection(true);
  header()->resizeSection(0, 128);
  for (const scenegraph::EffectType& type : scenegraph::effectTypes()) {
    addRow(type);
  }
  showAll();
  new EditorKeys(*this);
  connect(this, &QTreeWidget::itemChanged, this, &EffectPanel::onItemChanged);
}

void EffectPanel::addRow(const scenegraph::EffectType& type) {
  const std::string name(type.name);
  Row& row = rows_[name];
  row.item = new QTreeWidgetItem(this);
  row.item->setText(0, toQString(type.label));
  row.item->setToolTip(0, toQString(type.help));
  row.item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
  row.item->setFirstColumnSpanned(true);
  for (const scenegraph::SettingSpec& spec : type.specs) {
    auto* item = new QTreeWidgetItem(row.item);
    item->setText(0, QString::fromStdString(spec.label));
    item->setToolTip(0, QString::fromStdString(spec.help));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    auto* editor = new SettingEditor(spec, type.defaults.at(spec.key));
    setItemWidget(item, 1, editor);
    row.editors[spec.key] = editor;
    connect(editor, &SettingEditor::edited, this, [this, name](const QString& key, const QString& text) {
      if (const auto applied = effects_.apply(name, {{key.toStdString(), text.toStdString()}}); !applied) {
        Q_EMIT refused(QString::fromStdString(applied.error().message));
        showAll();
        return;
      }
      Q_EMIT changed();
    });
  }
}

void EffectPanel::setEffects(const scenegraph::ViewEffects& effects) {
  effects_ = effects;
  showAll();
}

QTreeWidgetItem* EffectPanel::item(const std::string& effect) const {
  const auto found = rows_.find(effect);
  return found == rows_.end() ? nullptr : found->second.item;
}

SettingEditor* EffectPanel::editor(const std::string& effect, const std::string& key) const {
  const auto found = rows_.find(effect);
  if (found == rows_.end() || !found->second.editors.contains(key)) {
    return nullptr;
  }
  return found->second.editors.at(key);
}

void EffectPanel::showAll() {
  const QSignalBlocker blocker(this);
  for (const auto& [name, row] : rows_) {
    row.item->setCheckState(0, effects_.isOn(name) ? Qt::Checked : Qt::Unchecked);
    const scenegraph::SettingTexts settings = effects_.settings(name);
    for (const auto& [key, editor] : row.editors) {
      editor->setText(settings.at(key));
    }
  }
}

void EffectPanel::onItemChanged(QTreeWidgetItem* item) {
  for (const auto& [name, row] : rows_) {
    const bool is_wanted = item->checkState(0) == Qt::Checked;
    if (row.item == item && effects_.isOn(name) != is_wanted) {
      effects_.setOn(name, is_wanted);
      item->setExpanded(is_wanted);
      Q_EMIT changed();
      return;
    }
  }
}

}  // namespace stillframe::viewer
