#pragma once

#include <QWidget>

#include "scenegraph/scene.h"

class QToolButton;

namespace stillframe::viewer {

class AddLayerMenu;
class LayerTree;

/// The layers of one view: the tree of them, and above it what adds, duplicates, removes and moves. GUI thread.
class LayerPanel : public QWidget {
  Q_OBJECT

 public:
  explicit LayerPanel(QWidget* parent = nullptr);

  /// Shows the layers of `scene` from now on; nullptr empties the panel. The scene must outlive this or the next call.
  void setScene(scenegraph::Scene* scene);
  /// Takes over what has changed in the scene; cheap when nothing has.
  void refresh();

  [[nodiscard]] LayerTree& tree() noexcept { return *tree_; }
  [[nodiscard]] AddLayerMenu& addMenu() noexcept { return *add_menu_; }

 Q_SIGNALS:
  /// See LayerTree.
  void changed(const QString& what, const QString& gesture);
  void refused(const QString& message);
  /// Somebody wants to know what each layer takes to draw: LayerTree::setDrawTimes().
  void drawTimesRequested();

 private:
  QToolButton* addButton(const char* name, const QString& text, const QString& tip);
  void enableButtons();

  scenegraph::Scene* scene_ = nullptr;
  QWidget* bar_ = nullptr;
  LayerTree* tree_ = nullptr;
  AddLayerMenu* add_menu_ = nullptr;
  QToolButton* duplicate_ = nullptr;
  QToolButton* remove_ = nullptr;
  QToolButton* up_ = nullptr;
  QToolButton* down_ = nullptr;
};

}  // namespace stillframe::viewer
