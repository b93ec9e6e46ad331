#pragma once

#include <QApplication>
#include <QEvent>
#include <cstdint>
#include <string>
#include <vector>

namespace stillframe::viewer {

/// What keeps the GUI thread from answering: how long each of its events takes, by what it was for. Drawing is counted
/// apart: where OpenGL is software it is drawn on this thread, and takes what it takes.
///
/// Off at first, and then costs nothing but a test of a pointer an event. GUI thread.
class StallMonitor {
 public:
  /// Events longer than this are stalls: what a hand on a slider begins to feel.
  static constexpr double kStallMs = 50.0;

  struct Stall {
    double ms = 0.0;      ///< by the clock on the wall
    double cpu_ms = 0.0;  ///< of it, this thread at work: the rest is waiting, for the GPU or for its turn
    std::string what;     ///< class of the receiver and kind of event
  };
  /// Events of one sort.
  class Tally {
   public:
    void add(Stall stall);
    [[nodiscard]] bool lists(double ms) const;
    [[nodiscard]] std::uint64_t events() const noexcept { return events_; }
    [[nodiscard]] std::uint64_t stalls() const noexcept { return stalls_; }
    /// Upper end of the twentieth of a decade that this share of the events stays below, ms.
    [[nodiscard]] double percentile(double share) const;
    /// The longest, longest first, at most five.
    [[nodiscard]] const std::vector<Stall>& longest() const noexcept { return longest_; }

   private:
    static constexpr int kBins = 160;  // from a microsecond up, twenty a decade
    std::uint64_t events_ = 0;
    std::uint64_t stalls_ = 0;
    std::vector<std::uint64_t> histogram_ = std::vector<std::uint64_t>(kBins);
    std::vector<Stall> longest_;
  };

  /// An event that was not sent by another one.
  void record(const QObject& receiver, QEvent::Type type, double ms, double cpu_ms);
  [[nodiscard]] const Tally& drawing() const noexcept { return drawing_; }
  [[nodiscard]] const Tally& rest() const noexcept { return rest_; }
  /// A few lines for people: how many, how long, which.
  [[nodiscard]] std::string report() const;

 private:
  Tally drawing_;
  Tally rest_;
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
