#pragma once

#include <QTreeWidget>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/scene.h"

namespace stillframe::viewer {

class HistogramFeed;
class SettingRows;

/// The layers of one view: a row each with a check box, its status as icon and text, and beneath it what the status
/// means and its settings. Rows are dragged to another place, renamed (F2), and have a menu.
///
/// Everything is built from the Layer interface; no type of layer is known here. GUI thread. refresh() compares before
/// it writes, so that it may be called on every tick.
class LayerTree : public QTreeWidget {
  Q_OBJECT

 public:
  explicit LayerTree(QWidget* parent = nullptr);

  /// Shows the layers of `scene` from now on; nullptr empties the tree. The scene must outlive this or the next call.
  void setScene(scenegraph::Scene* scene);
  /// Takes over layers, titles, statuses, counts, choices and values.
  void refresh();

  /// Id of the layer that is selected, or that the selected row belongs to; "" for none.
  [[nodiscard]] std::string currentLayer() const;
  void selectLayer(const std::string& id);
  [[nodiscard]] QTreeWidgetItem* item(const std::string& id) const;
  /// The rows of its settings, up to date; they are made when the row is opened, or here. nullptr for no such layer.
  [[nodiscard]] SettingRows* settingRows(const std::string& id) const;
  /// What each layer took to draw by itself, in the layers' order, for their rows to show; until the next change.
  void setDrawTimes(std::vector<std::optional<double>> times);

 public Q_SLOTS:
  /// What these do, they do to the current layer; nothing without one.
  void duplicateCurrent();
  void removeCurrent();
  void renameCurrent();
  /// So many places down the list.
  void moveCurrent(int places);
  /// To the place of the layer that is now at `place`.
  void moveLayer(const std::string& id, std::size_t place);
  void showOnlyCurrent();
  void showAllLayers();
  /// As a new layer of its type has them.
  void resetCurrent();
  void addLayer(const std::string& id);

 Q_SIGNALS:
  /// The user has changed something; the scene needs an update. `what` names it; steps of one `gesture`, if it is not
  /// empty, are one.
  void changed(const QString& what, const QString& gesture);
  /// Something was refused: one sentence.
  void refused(const QString& message);

 protected:
  void dropEvent(QDropEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  struct Row {
    std::string id;
    scenegraph::Layer* layer = nullptr;
    QTreeWidgetItem* item = nullptr;
    QTreeWidgetItem* note = nullptr;  // the status in words
    QTreeWidgetItem* cost = nullptr;
    SettingRows* settings = nullptr;
    HistogramFeed* histograms = nullptr;
  };
  void clearRows();
  void rebuild();
  Row addRow(const scenegraph::LayerSlot& slot);
  void showStatus(const Row& row);
  void showDetails(const Row& row, const scenegraph::LayerSlot& slot);
  static void showSettings(const Row& row);
  void onItemChanged(QTreeWidgetItem* item);
  void takeRow(const Row& row);
  void apply(const std::string& id, const scenegraph::SettingTexts& texts, const QString& label);
  [[nodiscard]] const Row* findRow(const std::string& id) const;
  [[nodiscard]] scenegraph::LayerSlot* currentSlot() const;
  void copyStatus(const std::string& id) const;

  scenegraph::Scene* scene_ = nullptr;
  std::vector<Row> rows_;
  std::vector<std::optional<double>> draw_times_;  // by row; empty: not measured
  std::uint64_t measured_revision_ = 0;            // of the scene, that they hold for
};

/// "28,800 points", "1 pose".
[[nodiscard]] QString counted(std::uint64_t count, std::string_view plural);
/// What a row says beside its name: why nothing is drawn, else how much is and the code of a note ("39,712 points,
/// PointsDropped"); the row beneath has the sentence.
[[nodiscard]] QString statusLine(const scenegraph::Layer& layer);
/// What a layer is called: its title, or the type's label for a built-in that has none of its own.
[[nodiscard]] QString layerName(const scenegraph::LayerSlot& slot);

}  // namespace stillframe::viewer
