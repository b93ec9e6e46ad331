#pragma once

#include <QObject>
#include <QTreeWidget>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scenegraph/settings.h"

namespace stillframe::viewer {

class RangeEditor;
class SettingEditor;

/// The settings of one layer as rows beneath its own: an editor each, the range of colours in one, and what comes many
/// times (namespaces, links) as rows with a check box beneath a row that switches all of them. GUI thread.
class SettingRows : public QObject {
  Q_OBJECT

 public:
  /// Rows beneath `parent`, which belongs to `tree` and outlives this.
  SettingRows(QTreeWidget& tree, QTreeWidgetItem& parent);

  /// Shows these settings without telling anybody; makes rows anew only when the specs need other widgets.
  void show(const std::vector<scenegraph::SettingSpec>& specs, const scenegraph::SettingTexts& texts);
  /// The user has clicked a check box. Returns whether `item` is a row of this.
  bool takeCheck(QTreeWidgetItem* item);

  [[nodiscard]] SettingEditor* editor(const std::string& key) const;
  /// nullptr for a layer that colours nothing by value.
  [[nodiscard]] RangeEditor* range() const noexcept { return range_; }
  /// Groups whose row is open. Those named stay open, or are opened when they come; the others are closed.
  [[nodiscard]] std::set<std::string> openGroups() const;
  void setOpenGroups(std::set<std::string> names);
  /// The row of a thing ("Links", "wheel"), or of a group ("Links", ""); nullptr when there is none.
  [[nodiscard]] QTreeWidgetItem* row(const std::string& group, const std::string& item) const;

 Q_SIGNALS:
  /// The user has chosen these, of what is called `label`.
  void edited(const stillframe::scenegraph::SettingTexts& texts, const QString& label);

 private:
  struct Thing {
    QTreeWidgetItem* item = nullptr;
    std::string switch_key;  // of the check box; "" without one
  };
  struct Group {
    QTreeWidgetItem* item = nullptr;
    std::map<std::string, Thing> things;
  };
  void build();
  QTreeWidgetItem* addRow(QTreeWidgetItem& parent, const std::string& label, const std::string& help);
  void addThing(const scenegraph::SettingSpec& spec);
  void addEditor(QTreeWidgetItem& item, const scenegraph::SettingSpec& spec);
  void addRange(QTreeWidgetItem& item);
  void showChecks(const scenegraph::SettingTexts& texts);

  QTreeWidget& tree_;
  QTreeWidgetItem& parent_;
  std::vector<scenegraph::SettingSpec> specs_;
  std::vector<QTreeWidgetItem*> items_;  // beneath parent_
  std::map<std::string, SettingEditor*> editors_;
  std::map<std::string, Group> groups_;
  std::set<std::string> open_;  // of those that are not there yet, too
  RangeEditor* range_ = nullptr;
};

}  // namespace stillframe::viewer
