#pragma once

#include <QApplication>
#include <cstdint>
#include <string>
#include <vector>

namespace stillframe::viewer {

/// What keeps the GUI thread from answering: how long each of its events takes, by what it was for.
///
/// Off at first, and then costs nothing but a test of a pointer an event. GUI thread.
class StallMonitor {
 public:
  /// Events longer than this are stalls: what a hand on a slider begins to feel.
  static constexpr double kStallMs = 50.0;

  struct Stall {
    double ms = 0.0;
    std::string what;  ///< class of the receiver and kind of event
  };

  /// An event that was not sent by another one.
  void record(const QObject& receiver, const QEvent& event, double ms);
  void record(std::string what, double ms);
  void reset();

  [[nodiscard]] std::uint64_t events() const noexcept { return events_; }
  [[nodiscard]] std::uint64_t stalls() const noexcept { return stalls_; }
  /// Upper end of the twentieth of a decade that this share of the events stays below, ms.
  [[nodiscard]] double percentile(double share) const;
  /// The longest, longest first, at most ten.
  [[nodiscard]] const std::vector<Stall>& longest() const noexcept { return longest_; }
  /// A few lines for people: how many, how long, which.
  [[nodiscard]] std::string report() const;

 private:
  static constexpr int kBins = 160;  // from a microsecond up, twenty a decade
  std::uint64_t events_ = 0;
  std::uint64_t stalls_ = 0;
  std::vector<std::uint64_t> histogram_ = std::vector<std::uint64_t>(kBins);
  std::vector<Stall> longest_;
};

/// An application whose events a monitor can watch.
class MonitoredApplication : public QApplication {
 public:
  using QApplication::QApplication;

  /// Watches from now on; nullptr: no more. `monitor` must outlive that.
  void watch(StallMonitor* monitor) { monitor_ = monitor; }
  bool notify(QObject* receiver, QEvent* event) override;

 private:
  StallMonitor* monitor_ = nullptr;
  int timed_level_ = -1;    // of event loops, of the event that is being timed
  int deepest_level_ = -1;  // of the events timed since
};

}  // namespace stillframe::viewer
