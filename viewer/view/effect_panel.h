#pragma once

#include <QTreeWidget>
#include <map>
#include <string>

#include "scenegraph/passes/view_effects.h"

namespace stillframe::viewer {

class SettingEditor;

/// The effects of a view: a check box each, and its settings beneath. Shows and edits a value of its own; whoever draws
/// takes it from changed(). GUI thread.
class EffectPanel : public QTreeWidget {
  Q_OBJECT

 public:
  explicit EffectPanel(QWidget* parent = nullptr);

  [[nodiscard]] const scenegraph::ViewEffects& effects() const noexcept { return effects_; }
  /// Shows `effects` without telling anybody.
  void setEffects(const scenegraph::ViewEffects& effects);
  /// The row of an effect, nullptr when there is none of that name.
  [[nodiscard]] QTreeWidgetItem* item(const std::string& effect) const;
  [[nodiscard]] SettingEditor* editor(const std::string& effect, const std::string& key) const;

 Q_SIGNALS:
  /// The user has switched or set something.
  void changed();
  void refused(const QString& message);

 private:
  struct Row {
    QTreeWidgetItem* item = nullptr;
    std::map<std::string, SettingEditor*> editors;
  };
  void addRow(const scenegraph::EffectType& type);
  void onItemChanged(QTreeWidgetItem* item);
  void showAll();

  scenegraph::ViewEffects effects_;
  std::map<std::string, Row> rows_;
};

}  // namespace stillframe::viewer
