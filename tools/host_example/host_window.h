#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <vector>

#include "live_robot.h"
#include "viewer/dock/scene_dock.h"

class QCheckBox;
class QComboBox;
class QTimer;

namespace host_example {

class Plot;

/// The host: it owns data, time and layout; two scene docks and a plot show them. GUI thread.
class HostWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit HostWindow(QWidget* parent = nullptr);
  ~HostWindow() override;

  /// Moves the tracker; by hand it leaves the newest edge.
  void setTime(stillframe::tf::TimePoint time);
  [[nodiscard]] stillframe::tf::TimePoint time() const { return time_; }
  void setLive(bool live);
  [[nodiscard]] bool isLive() const;
  void setGrowing(bool growing);

  /// The layout of the whole host, in which each dock is one element.
  [[nodiscard]] QString layoutText() const;
  bool restoreLayout(const QString& text);
  /// To and from a file; what is wrong with it is told in the status bar.
  void saveLayoutTo(const QString& name);
  void openLayout(const QString& name);

  [[nodiscard]] const std::vector<stillframe::viewer::SceneDock*>& docks() const { return docks_; }
  [[nodiscard]] Plot& plot() { return *plot_; }
  [[nodiscard]] QComboBox& values() { return *values_; }
  [[nodiscard]] const LiveRobot& robot() const { return robot_; }

 private:
  void addDock(const QString& title, const std::string& fixed_frame);
  void buildMenu();
  void tick();
  void seek(stillframe::tf::TimePoint time);
  void chooseValue();
  void tell(const QString& line);
  void tellPick(const stillframe::scenegraph::PickResult& result);

  LiveRobot robot_;
  stillframe::viewer::DockContext context_;  // before the docks, which use it
  std::vector<stillframe::viewer::SceneDock*> docks_;
  stillframe::tf::TimePoint time_;
  QElapsedTimer clock_;
  QTimer* timer_ = nullptr;
  Plot* plot_ = nullptr;
  QComboBox* values_ = nullptr;
  QCheckBox* live_ = nullptr;
};

}  // namespace host_example
