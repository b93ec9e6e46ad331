#pragma once

#include <QByteArray>
#include <QWidget>
#include <cstdint>
#include <functional>
#include <vector>

#include "scenegraph/layout/window_layout.h"

class QRubberBand;
class QSplitter;

namespace stillframe::viewer {

class ViewPanel;

/// On which side of a view another one goes.
enum class Side : std::uint8_t { Left, Right, Above, Below };

/// The views of one window, in splitters within each other, which can be dragged apart. Owns none of them. GUI thread.
class ViewArea : public QWidget {
  Q_OBJECT

 public:
  explicit ViewArea(QWidget* parent = nullptr);

  /// Puts `panel` beside one that is here, half its room for each; without one at the right end of all.
  void insert(ViewPanel& panel, ViewPanel* beside = nullptr, Side side = Side::Right);
  /// Takes `panel` out; it has no parent then. Splitters that hold nothing to split go too.
  void take(ViewPanel& panel);
  /// From left to right and from top to bottom.
  [[nodiscard]] std::vector<ViewPanel*> panels() const;

  [[nodiscard]] scenegraph::Place place() const;
  /// Builds an arrangement of the panels that `make` gives, into an empty area.
  void arrange(const scenegraph::Place& place, const std::function<ViewPanel&(const scenegraph::ViewLayout&)>& make);

  /// What a dragged view is known by, in this process alone.
  [[nodiscard]] static QByteArray token(const ViewPanel& panel);
  static constexpr const char* kMimeType = "application/x-stillframe-view";

 Q_SIGNALS:
  /// The view of that token was dropped at a side of `beside`.
  void dropped(const QByteArray& token, stillframe::viewer::ViewPanel* beside, stillframe::viewer::Side side);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  struct Target {
    ViewPanel* panel = nullptr;
    Side side = Side::Right;
  };
  [[nodiscard]] Target targetAt(QPoint position) const;
  void showTarget(const Target& target);

  QSplitter* root_ = nullptr;
  QRubberBand* band_ = nullptr;
};

}  // namespace stillframe::viewer
