#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <optional>

#include "scenegraph/color_legend.h"
#include "scenegraph/executor.h"

namespace stillframe::viewer {

/// Histograms of one layer, counted off the GUI thread: one at a time, the latest wins. GUI thread.
class HistogramFeed : public QObject {
  Q_OBJECT

 public:
  using Work = std::function<scenegraph::ValueHistogram()>;

  explicit HistogramFeed(QObject* parent);
  ~HistogramFeed() override;

  /// Counts soon, and then again with what was asked for meanwhile. `executor` outlives its work.
  void request(Work work, scenegraph::Executor& executor);

 Q_SIGNALS:
  void counted(const stillframe::scenegraph::ValueHistogram& histogram);

 private:
  struct Shared;
  void take(const scenegraph::ValueHistogram& histogram);

  std::shared_ptr<Shared> shared_;
  scenegraph::Executor* executor_ = nullptr;
  Work next_;
  bool is_counting_ = false;
};

}  // namespace stillframe::viewer
