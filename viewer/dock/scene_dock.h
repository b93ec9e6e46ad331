#pragma once

#include <QDomElement>
#include <QWidget>
#include <memory>
#include <vector>

#include "scenegraph/executor.h"
#include "scenegraph/layout/view_layout.h"
#include "scenegraph/pick/scene_pick.h"
#include "scenegraph/store/dataset.h"
#include "viewer/frames/frame_memory.h"

class QComboBox;

namespace stillframe::viewer {

class MessageBar;
class ViewPanel;

/// What the docks of a host share: workers, and the memory of frames chosen by hand. Outlives them. GUI thread.
class DockContext {
 public:
  /// `workers` 0: one less than there are processors.
  explicit DockContext(unsigned workers = 0);

  [[nodiscard]] scenegraph::Executor& executor() noexcept { return *executor_; }
  [[nodiscard]] FrameMemory& frameMemory() noexcept { return frame_memory_; }

 private:
  std::unique_ptr<scenegraph::Executor> executor_;
  FrameMemory frame_memory_;
};

/// The scene as a dock of a host application: the host owns data and time, the dock shows them and asks.
///
/// ```cpp
/// stillframe::viewer::prepareApplication();  // before the QApplication: OpenGL 4.5 compatibility, shared contexts
/// auto* dock = new stillframe::viewer::SceneDock(context);
/// dock->setDatasets({dataset});              // again whenever there are others
/// dock->setTime(tracker_time);               // whenever the host's cursor moves
/// dock->takeGrowth();                        // when the dataset has grown: live, or while a file loads
/// connect(dock, &SceneDock::seekRequested, host, &Host::setTime);
/// ```
/// What is shown is a view of its own: frames, camera, effects and layers, saved by saveState() as one element of the
/// host's layout. A layout may be restored before there is any data; what it names is taken up when it comes. Costs
/// nothing while nothing changes. GUI thread.
class SceneDock : public QWidget {
  Q_OBJECT

 public:
  explicit SceneDock(DockContext& context, QWidget* parent = nullptr);
  ~SceneDock() override;

  /// The recordings and streams there are. The one shown stays while it is among them, else the one that the restored
  /// layout names, else the first; the user chooses among several. The state of the view is kept.
  void setDatasets(std::vector<std::shared_ptr<scenegraph::Dataset>> datasets);
  /// The one shown; nullptr without any.
  [[nodiscard]] const std::shared_ptr<scenegraph::Dataset>& dataset() const noexcept { return shown_; }
  /// The tracker's time, of all its datasets. Cheap: several calls before the next picture are one.
  void setTime(tf::TimePoint time);
  /// The shown dataset has more topics, frames or messages.
  void takeGrowth();

  /// `<Scene3DDock version="1">`: all that the view is.
  [[nodiscard]] QDomElement saveState(QDomDocument& document) const;
  /// Restores that. Refused as a whole, with nothing changed, when it is none, of another version, or broken: the dock
  /// says why, and false comes back. What it names and the data does not have is said, and kept for the next save.
  bool restoreState(const QDomElement& element);

  /// The view within, for hosts that want more.
  [[nodiscard]] ViewPanel& panel() noexcept { return *panel_; }
  /// What the dock tells now, "" when nothing.
  [[nodiscard]] QString message() const;

 Q_SIGNALS:
  /// The user wants the tracker there: Left and Right in the view step from message to message.
  void seekRequested(stillframe::tf::TimePoint time);
  /// The user wants to play or to stop (Space in the view).
  void playRequested();
  /// The user has clicked something: the layer, the message and the fields of what is there, and its place.
  void picked(const stillframe::scenegraph::PickResult& result);
  /// Another dataset of those given is shown.
  void datasetChosen(const std::shared_ptr<stillframe::scenegraph::Dataset>& dataset);

 private:
  void showDataset(const std::shared_ptr<scenegraph::Dataset>& dataset);
  void step(int direction);
  void tellNotRestored();

  DockContext& context_;
  std::vector<std::shared_ptr<scenegraph::Dataset>> datasets_;
  std::shared_ptr<scenegraph::Dataset> shown_;
  tf::TimePoint time_;
  std::vector<std::string> told_;  // what was not restored, as told last
  MessageBar* messages_ = nullptr;
  QComboBox* choice_ = nullptr;
  ViewPanel* panel_ = nullptr;
};

}  // namespace stillframe::viewer
