#pragma once

#include <QByteArray>
#include <QObject>
#include <vector>

#include "scenegraph/layout/window_layout.h"
#include "viewer/window/view_area.h"

namespace stillframe::viewer {

class FrameMemory;
class ViewWindow;

/// The views of an inspector: those in its main window, and those in windows of their own. Makes, moves and deletes
/// them; one is the active one. The main window keeps one view at least. GUI thread.
class ViewSet : public QObject {
  Q_OBJECT

 public:
  /// `main` and `memory` must outlive the set, or clear().
  ViewSet(ViewArea& main, FrameMemory& memory, QObject* parent = nullptr);
  ~ViewSet() override;

  /// In the order in which they were made.
  [[nodiscard]] const std::vector<ViewPanel*>& views() const noexcept { return views_; }
  [[nodiscard]] const std::vector<ViewWindow*>& windows() const noexcept { return windows_; }
  /// The view that had the focus last; there is one from the first add() or arrange() on.
  [[nodiscard]] ViewPanel& active() noexcept { return *active_; }

  /// A fresh view beside another; added() comes before it is shown.
  ViewPanel& add(ViewPanel* beside = nullptr, Side side = Side::Right);
  /// Closes a view, and its window with the last one in it. False: it is the last of the main window.
  bool close(ViewPanel& panel);
  /// Into a window of its own. False as for close().
  bool detach(ViewPanel& panel);
  /// To a side of another view, in whatever window. False as for close(), or when both are one.
  bool move(ViewPanel& panel, ViewPanel& beside, Side side);

  /// The arrangement of all windows; the first is the main one, whose docks and size are the caller's.
  [[nodiscard]] scenegraph::Layout layout() const;
  /// Replaces all views and windows by those of `layout`. The active view has the focus, and its window is the active
  /// one, whether a window manager runs or not.
  void arrange(const scenegraph::Layout& layout);
  /// Windows of detached views say which views they have, and of what recording.
  void nameWindows();
  /// Deletes all views and windows.
  void clear();

 Q_SIGNALS:
  /// A view without data; what it shows is restored next.
  void added(stillframe::viewer::ViewPanel* panel);
  void windowAdded(stillframe::viewer::ViewWindow* window);
  void activeChanged();
  /// What was asked for is not done: one sentence.
  void refused(const QString& message);
  /// Views were added, moved, closed, or restored.
  void arranged();

 private:
  ViewPanel& make();
  [[nodiscard]] ViewArea& areaOf(const ViewPanel& panel) const;
  bool takeOut(ViewPanel& panel);
  ViewWindow& openWindow(const scenegraph::WindowLayout& place, bool is_activated);
  void closeEmptyWindows();
  void finishArranging();
  void markActive();
  void drag(ViewPanel& panel);
  void activate(ViewPanel& panel);
  void onDropped(const QByteArray& token, ViewPanel& beside, Side side);

  ViewArea& main_;
  FrameMemory& memory_;
  std::vector<ViewPanel*> views_;
  std::vector<ViewWindow*> windows_;
  ViewPanel* active_ = nullptr;         // one of views_
  scenegraph::XmlElement source_;       // of the layout that was restored
  scenegraph::XmlElement main_source_;  // and of its main window
};

}  // namespace stillframe::viewer
