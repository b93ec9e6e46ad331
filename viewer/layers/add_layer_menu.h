#pragma once

#include <QMenu>

#include "scenegraph/scene.h"

class QLineEdit;
class QListWidget;

namespace stillframe::viewer {

/// What layers can be added: topics without one first, then second layers of the others, found by typing a part of the
/// name. GUI thread.
class AddLayerMenu : public QMenu {
  Q_OBJECT

 public:
  explicit AddLayerMenu(QWidget* parent = nullptr);

  /// Lists what `scene` has; nullptr: nothing.
  void fill(const scenegraph::Scene* scene);
  [[nodiscard]] QLineEdit& search() noexcept { return *search_; }
  [[nodiscard]] QListWidget& list() noexcept { return *list_; }

 Q_SIGNALS:
  /// A topic or a built-in; where it has a layer already, another one is meant.
  void chosen(const QString& id);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void filter(const QString& text);
  void choose();

  QLineEdit* search_ = nullptr;
  QListWidget* list_ = nullptr;
};

}  // namespace stillframe::viewer
