#pragma once

#include <QObject>
#include <expected>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"
#include "viewer/widget/update_gate.h"

namespace stillframe::viewer {

/// A recording whose headers have been read: its dataset, and what fills it.
struct OpenedRecording {
  std::shared_ptr<scenegraph::Dataset> dataset;
  /// Fills the dataset; blocks. `progress` gets a fraction 0..1; returning false stops early.
  std::function<void(const std::function<bool(double)>& progress)> load;
};

/// Opens files; the viewer knows no file format itself. Called on a worker thread.
using RecordingOpener =
    std::function<std::expected<OpenedRecording, scenegraph::Status>(const std::vector<std::filesystem::path>&)>;

/// Opens and loads recordings on a worker thread, one at a time; GUI thread.
///
/// Opening another one stops the load under way only once the other has proved to be readable. The GUI thread never
/// waits for a worker, except in the destructor.
class DatasetLoader : public QObject {
  Q_OBJECT

 public:
  explicit DatasetLoader(RecordingOpener opener, QObject* parent = nullptr);
  ~DatasetLoader() override;

  void open(std::vector<std::filesystem::path> files);
  /// Whether a file is being opened or loaded.
  [[nodiscard]] bool isBusy() const noexcept;
  /// Stops what is under way; what is loaded so far stays.
  void cancel();

 Q_SIGNALS:
  /// The headers are read: the time range is known, views may be shown; loading goes on.
  void opened(const std::shared_ptr<stillframe::scenegraph::Dataset>& dataset);
  /// The dataset grew; `fraction` 0..1.
  void progressed(double fraction);
  /// Everything is in.
  void loaded();
  void failed(const stillframe::scenegraph::Status& status);

 private:
  struct Job;
  void collect();
  static void run(Job& job, const RecordingOpener& opener, const std::vector<std::filesystem::path>& files);

  RecordingOpener opener_;
  UpdateGate gate_;
  std::vector<std::unique_ptr<Job>> jobs_;  // the newest last; older ones are on their way out
  Job* current_ = nullptr;                  // the one whose dataset is shown
};

}  // namespace stillframe::viewer
