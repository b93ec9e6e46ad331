#pragma once

#include <QTreeWidget>
#include <map>
#include <string>
#include <vector>

#include "scenegraph/scene.h"

namespace stillframe::viewer {

class SettingEditor;

/// The layers of one view: a row each with a check box, its status as icon and text, and its settings beneath.
///
/// Everything is built from the Layer interface; no type of layer is known here. GUI thread. refresh() compares before
/// it writes, so that it may be called on every tick.
class LayerPanel : public QTreeWidget {
  Q_OBJECT

 public:
  explicit LayerPanel(QWidget* parent = nullptr);

  /// Shows the layers of `scene` from now on; nullptr empties the panel. The scene must outlive this or the next call.
  void setScene(scenegraph::Scene* scene);
  /// Takes over new layers, statuses, counts, choices and values.
  void refresh();

 Q_SIGNALS:
  /// The user has switched or set something; the scene needs an update.
  void changed();
  /// A setting was refused: one sentence.
  void refused(const QString& message);

 private:
  struct Row {
    scenegraph::Layer* layer = nullptr;
    QTreeWidgetItem* item = nullptr;
    std::vector<scenegraph::SettingSpec> specs;
    std::map<std::string, SettingEditor*> editors;
  };
  Row addRow(const scenegraph::LayerSlot& slot);
  void showStatus(const Row& row) const;
  void buildEditors(Row& row);
  void onItemChanged(QTreeWidgetItem* item);

  scenegraph::Scene* scene_ = nullptr;
  std::vector<Row> rows_;
};

/// What a row says beside its name: why nothing is drawn, else how much is and the code of a note ("39,712 points,
/// PointsDropped"); the tool tip has the sentence.
[[nodiscard]] QString statusLine(const scenegraph::Layer& layer);

}  // namespace stillframe::viewer
