#pragma once

#include <QMainWindow>
#include <filesystem>
#include <memory>
#include <vector>

#include "scenegraph/executor.h"
#include "viewer/frames/frame_memory.h"
#include "viewer/time/time_text.h"
#include "viewer/view/view_panel.h"
#include "viewer/window/dataset_loader.h"
#include "viewer/window/inspector.h"
#include "viewer/window/view_set.h"

class QMenu;
class QProgressBar;

namespace stillframe::viewer {

class FrameTree;
class InspectDock;
class MessageBar;
class TimeBar;

/// The standalone inspector: views side by side over one recording, time bar, frame tree, messages.
///
/// Knows no file format: recordings come from the opener. Owns the tracker time (TimeBar) and hands it to every view;
/// views share nothing else but the dataset. GUI thread.
class InspectorWindow : public QMainWindow {
  Q_OBJECT

 public:
  InspectorWindow(RecordingOpener opener, InspectorOptions options, QWidget* parent = nullptr);
  ~InspectorWindow() override;

  /// Opens recordings in place of the present one, which stays when they cannot be read.
  void openFiles(std::vector<std::filesystem::path> files);
  /// Adds a view in the state of `like`, beside or below it; without one, a fresh view at the end.
  ViewPanel& addView(ViewPanel* like = nullptr, Qt::Orientation orientation = Qt::Horizontal);
  void closeView(ViewPanel& panel);

  /// All views with their windows, places and states.
  [[nodiscard]] scenegraph::Layout layout() const;
  /// Replaces the views by those of `layout`, over the same recording; tells what it could not restore.
  void restore(const scenegraph::Layout& layout);
  /// The same with files. A layout that cannot be read changes nothing; both tell why in the message bar.
  bool openLayout(const std::filesystem::path& file);
  bool saveLayout(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<ViewPanel*>& views() const noexcept { return views_->views(); }
  [[nodiscard]] ViewSet& viewSet() noexcept { return *views_; }
  /// The view that had the focus last: what the frames panel is about.
  [[nodiscard]] ViewPanel& activeView() noexcept { return views_->active(); }
  [[nodiscard]] TimeBar& timeBar() noexcept { return *time_bar_; }
  [[nodiscard]] FrameTree& frameTree() noexcept { return *frame_tree_; }
  [[nodiscard]] InspectDock& inspect() noexcept { return *inspect_; }
  [[nodiscard]] MessageBar& messageBar() noexcept { return *messages_; }
  [[nodiscard]] const std::shared_ptr<scenegraph::Dataset>& dataset() const noexcept { return dataset_; }
  [[nodiscard]] bool isLoading() const noexcept { return is_loading_; }
  /// Whether everything is loaded, decoded and drawn, down to the last point.
  [[nodiscard]] bool isComplete() const;

 Q_SIGNALS:
  /// The recording is loaded to its end.
  void loaded();

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void buildMenus();
  void buildLayoutMenu(QMenu& file);
  void buildViewMenu();
  void buildShortcuts(QWidget& window);
  void focusNextView(int step);
  void focusNextPanel(int step);
  void onOpened(const std::shared_ptr<scenegraph::Dataset>& dataset);
  void onProgress(double fraction);
  void onArranged();
  void onLoaded();
  void onFailed(const scenegraph::Status& status);
  void takeRange();
  void addViews(int count);
  void fillView(ViewPanel& panel);
  void connectView(ViewPanel& panel);
  void connectFrames();
  void tellNotRestored();
  [[nodiscard]] QStringList openingRemarks() const;
  void setLoading(bool is_loading);
  void takeScreenshotWhenComplete();
  /// Ends the program with exit code 1: nobody is there to read a message bar.
  void failUnattended(const QString& message);

  InspectorOptions options_;
  std::unique_ptr<scenegraph::Executor> executor_;  // outlives the views: see the destructor
  std::shared_ptr<scenegraph::Dataset> dataset_;
  DatasetLoader* loader_ = nullptr;
  bool is_loading_ = false;
  bool is_time_untouched_ = true;
  FrameMemory frame_memory_;  // before the views, which use it

  MessageBar* messages_ = nullptr;
  ViewSet* views_ = nullptr;
  TimeBar* time_bar_ = nullptr;
  FrameTree* frame_tree_ = nullptr;
  InspectDock* inspect_ = nullptr;
  QProgressBar* progress_ = nullptr;
};

}  // namespace stillframe::viewer
