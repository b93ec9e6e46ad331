#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "scenegraph/store/dataset.h"
#include "viewer/time/playback.h"
#include "viewer/time/time_text.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QSlider;
class QTimer;
class QToolButton;

namespace stillframe::viewer {

/// The tracker: slider, play, step, speed, loop, and the time as +seconds and nanoseconds, both editable.
///
/// The one owner of the inspector's time. While stopped it does nothing at all; while playing a timer reads a clock
/// (PlaybackClock), so that a slow picture skips ahead and ticks never pile up. GUI thread.
class TimeBar : public QWidget {
  Q_OBJECT

 public:
  explicit TimeBar(QWidget* parent = nullptr);

  static constexpr int kSteps = 1'000'000;

  /// The dataset whose messages the step buttons find; nullptr: none. Stops playing.
  void setDataset(std::shared_ptr<const scenegraph::Dataset> dataset);
  /// The slider's range; keeps the time, which moves into the range only if `moves_into` is set.
  void setRange(const TimeRange& range);
  [[nodiscard]] const TimeRange& range() const noexcept { return range_; }
  /// Moves the tracker and tells everybody once, when it moves.
  void setTime(tf::TimePoint time);
  [[nodiscard]] tf::TimePoint time() const noexcept { return time_; }

  void setPlaying(bool playing);
  [[nodiscard]] bool isPlaying() const noexcept { return is_playing_; }
  [[nodiscard]] PlaybackSettings playback() const noexcept { return playback_; }
  void setPlayback(const PlaybackSettings& playback);

  [[nodiscard]] QSlider& slider() noexcept { return *slider_; }

 public Q_SLOTS:
  void togglePlaying() { setPlaying(!is_playing_); }
  /// To the next (+1) or previous (-1) message, or by one 30th of a second when that is chosen.
  void step(int direction);
  void toStart() { setTime(range_.first); }
  void toEnd() { setTime(range_.last); }

 Q_SIGNALS:
  void timeChanged(stillframe::tf::TimePoint time);
  /// A time that was typed in and cannot be read: one sentence.
  void refused(const QString& message);

 private:
  QToolButton* addButton(const QString& name, const QIcon& icon, const QString& tip);
  void fillStepModes();
  void showTime();
  void onTextEdited(QLineEdit& edit);
  void restartClock();
  void onPlaybackTimer();

  std::shared_ptr<const scenegraph::Dataset> dataset_;
  std::size_t known_topics_ = 0;
  TimeRange range_;
  tf::TimePoint time_;
  bool is_playing_ = false;
  PlaybackSettings playback_;
  PlaybackClock clock_;

  QSlider* slider_ = nullptr;
  QToolButton* play_ = nullptr;
  QToolButton* loop_ = nullptr;
  QComboBox* speed_ = nullptr;
  QComboBox* step_mode_ = nullptr;
  QLineEdit* seconds_ = nullptr;
  QLineEdit* nanoseconds_ = nullptr;
  QTimer* timer_ = nullptr;
};

/// Log time of the message after (+1) or before (-1) `time`, over `topic` or, without one, over all topics of a known
/// type; nullopt when there is none. O(topics * log entries).
[[nodiscard]] std::optional<tf::TimePoint> neighbouringMessage(const scenegraph::ObjectStore& store, tf::TimePoint time,
                                                               int direction,
                                                               std::optional<scenegraph::TopicId> topic = {});

}  // namespace stillframe::viewer
