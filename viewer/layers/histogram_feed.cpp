#include "viewer/layers/histogram_feed.h"

#include <QMetaObject>
#include <mutex>
#include <utility>

namespace stillframe::viewer {

/// What a worker finds of the feed when it is done.
struct HistogramFeed::Shared {
  std::mutex mutex;  // guards feed
  HistogramFeed* feed = nullptr;
};

HistogramFeed::HistogramFeed(QObject* parent) : QObject(parent), shared_(std::make_shared<Shared>()) {
  shared_->feed = this;
}

HistogramFeed::~HistogramFeed() {
  const std::scoped_lock lock(shared_->mutex);
  shared_->feed = nullptr;
}

void HistogramFeed::request(Work work, scenegraph::Executor& executor) {
  if (is_counting_) {
    next_ = std::move(work);
    executor_ = &executor;
    return;
  }
  is_counting_ = true;
  executor.submit([work = std::move(work), shared = shared_] {
    scenegraph::ValueHistogram histogram = work();
    const std::scoped_lock lock(shared->mutex);
    if (shared->feed != nullptr) {
      QMetaObject::invokeMethod(
          shared->feed, [feed = shared->feed, histogram = std::move(histogram)] { feed->take(histogram); },
          Qt::QueuedConnection);
    }
  });
}

void HistogramFeed::take(const scenegraph::ValueHistogram& histogram) {
  is_counting_ = false;
  Q_EMIT counted(histogram);
  if (next_) {
    request(std::exchange(next_, nullptr), *executor_);
  }
}

}  // namespace stillframe::viewer
