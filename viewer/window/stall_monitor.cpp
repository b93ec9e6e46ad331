#include "viewer/window/stall_monitor.h"

#include <QElapsedTimer>
#include <QMetaEnum>
#include <QPointer>
#include <QScopedValueRollback>
#include <QThread>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <utility>

namespace stillframe::viewer {
namespace {

constexpr double kSmallestMs = 1e-3;
constexpr double kBinsADecade = 20.0;
constexpr std::size_t kMostListed = 5;

double threadCpuMs() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

std::string linesOf(const char* what, const StallMonitor::Tally& tally) {
  std::array<char, 240> line{};
  std::snprintf(line.data(), line.size(),
                "  %s: %llu events, %llu of them longer than %.0f ms; 50 %% within %.2f ms, 99 %% within %.1f ms\n",
                what, static_cast<unsigned long long>(tally.events()), static_cast<unsigned long long>(tally.stalls()),
                StallMonitor::kStallMs, tally.percentile(0.5), tally.percentile(0.99));
  std::string text = line.data();
  for (const StallMonitor::Stall& stall : tally.longest()) {
    std::snprintf(line.data(), line.size(), "    %8.1f ms, at work %8.1f ms: %.160s\n", stall.ms, stall.cpu_ms,
                  stall.what.c_str());
    text += line.data();
  }
  return text;
}

}  // namespace

bool StallMonitor::Tally::lists(double ms) const { return longest_.size() < kMostListed || ms > longest_.back().ms; }

void StallMonitor::Tally::add(Stall stall) {
  ++events_;
  stalls_ += stall.ms > kStallMs ? 1U : 0U;
  const double bin = std::floor(std::log10(std::max(stall.ms, kSmallestMs) / kSmallestMs) * kBinsADecade);
  ++histogram_[static_cast<std::size_t>(std::min(bin, kBins - 1.0))];
  if (lists(stall.ms)) {
    longest_.insert(std::ranges::upper_bound(longest_, stall.ms, std::greater{}, &Stall::ms), std::move(stall));
    longest_.resize(std::min(longest_.size(), kMostListed));
  }
}

double StallMonitor::Tally::percentile(double share) const {
  const double wanted = share * static_cast<double>(events_);
  double below = 0.0;
  for (std::size_t bin = 0; bin < histogram_.size(); ++bin) {
    below += static_cast<double>(histogram_[bin]);
    if (below >= wanted && below > 0.0) {
      const double upper = kSmallestMs * std::pow(10.0, static_cast<double>(bin + 1) / kBinsADecade);
      return longest_.empty() ? upper : std::min(upper, longest_.front().ms);
    }
  }
  return 0.0;
}

void StallMonitor::record(const QObject& receiver, QEvent::Type type, double ms, double cpu_ms) {
  const bool is_drawing =
      type == QEvent::UpdateRequest || type == QEvent::Paint || type == QEvent::Expose || type == QEvent::Resize;
  Tally& tally = is_drawing ? drawing_ : rest_;
  std::string what;
  if (tally.lists(ms)) {
    const char* const kind = QMetaEnum::fromType<QEvent::Type>().valueToKey(type);
    const std::string name = receiver.objectName().toStdString();
    what = std::string(receiver.metaObject()->className()) + (name.empty() ? "" : " '" + name + "'") + ", " +
           (kind == nullptr ? std::to_string(type) : kind);
  }
  tally.add({ms, cpu_ms, std::move(what)});
}

std::string StallMonitor::report() const {
  return "the UI thread:\n" + linesOf("drawing", drawing_) + linesOf("all else", rest_);
}

bool MonitoredApplication::notify(QObject* receiver, QEvent* event) {
  if (monitor_ == nullptr || QThread::currentThread() != thread()) {
    return QApplication::notify(receiver, event);
  }
  const int level = thread()->loopLevel();
  if (level <= timed_level_) {  // sent by the event that is being timed
    return QApplication::notify(receiver, event);
  }
  const QPointer<QObject> kept = receiver;  // it may delete itself meanwhile
  const QEvent::Type type = event->type();
  deepest_level_ = level;
  bool is_handled = false;
  const double cpu_before = threadCpuMs();
  QElapsedTimer timer;
  timer.start();
  {
    const QScopedValueRollback nested(timed_level_, level);
    is_handled = QApplication::notify(receiver, event);
  }
  const double ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  // An event that ran a loop of its own, such as a dialog's, kept nothing waiting: that loop's events are counted.
  if (monitor_ != nullptr && deepest_level_ == level) {
    const QObject* const shown = kept == nullptr ? static_cast<QObject*>(this) : kept.data();
    monitor_->record(*shown, type, ms, threadCpuMs() - cpu_before);
  }
  return is_handled;
}

}  // namespace stillframe::viewer
