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
#include <utility>

namespace stillframe::viewer {
namespace {

constexpr double kSmallestMs = 1e-3;
constexpr double kBinsADecade = 20.0;
constexpr std::size_t kMostListed = 10;

}  // namespace

void StallMonitor::record(const QObject& receiver, const QEvent& event, double ms) {
  if (longest_.size() >= kMostListed && ms <= longest_.back().ms) {
    record(std::string(), ms);  // no name needed
    return;
  }
  const char* const kind = QMetaEnum::fromType<QEvent::Type>().valueToKey(event.type());
  const std::string name = receiver.objectName().toStdString();
  record(std::string(receiver.metaObject()->className()) + (name.empty() ? "" : " '" + name + "'") + ", " +
             (kind == nullptr ? std::to_string(event.type()) : kind),
         ms);
}

void StallMonitor::record(std::string what, double ms) {
  ++events_;
  stalls_ += ms > kStallMs ? 1U : 0U;
  const double bin = std::floor(std::log10(std::max(ms, kSmallestMs) / kSmallestMs) * kBinsADecade);
  ++histogram_[static_cast<std::size_t>(std::min(bin, kBins - 1.0))];
  if (longest_.size() < kMostListed || ms > longest_.back().ms) {
    const auto place = std::ranges::upper_bound(longest_, ms, std::greater{}, &Stall::ms);
    longest_.insert(place, {ms, std::move(what)});
    longest_.resize(std::min(longest_.size(), kMostListed));
  }
}

void StallMonitor::reset() { *this = {}; }

double StallMonitor::percentile(double share) const {
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

std::string StallMonitor::report() const {
  std::array<char, 200> line{};
  std::snprintf(
      line.data(), line.size(),
      "UI thread: %llu events, %llu of them longer than %.0f ms; 99 %% within %.1f ms, 99.9 %% within %.1f ms\n",
      static_cast<unsigned long long>(events_), static_cast<unsigned long long>(stalls_), kStallMs, percentile(0.99),
      percentile(0.999));
  std::string text = line.data();
  for (const Stall& stall : longest_) {
    std::snprintf(line.data(), line.size(), "  %8.1f ms  %.160s\n", stall.ms, stall.what.c_str());
    text += line.data();
  }
  return text;
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
    monitor_->record(*shown, QEvent(type), ms);
  }
  return is_handled;
}

}  // namespace stillframe::viewer
