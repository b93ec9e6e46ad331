#include "viewer/time/time_bar.h"

#include <QComboBox>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QProxyStyle>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>
#include <QTimer>
#include <QToolButton>
#include <chrono>

#include "viewer/window/icons.h"

namespace stillframe::viewer {
namespace {

constexpr int kTimerMs = 16;
constexpr int kMinimumTextWidth = 60;
constexpr std::int64_t kFrameNs = 33'333'333;
constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0};
constexpr int kAnyMessage = -1;
constexpr int kOneFrame = -2;

std::int64_t steadyNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// A click on the groove goes there, instead of a page further.
class JumpStyle : public QProxyStyle {
 public:
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* data) const override {
    return hint == QStyle::SH_Slider_AbsoluteSetButtons ? int{Qt::LeftButton}
                                                        : QProxyStyle::styleHint(hint, option, widget, data);
  }
};

/// Index of the first entry later than `time`.
std::size_t firstAfter(const scenegraph::ObjectStore& store, scenegraph::TopicId topic, tf::TimePoint time) {
  std::size_t low = 0;
  std::size_t high = store.entryCount(topic);
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    const auto entry = store.at(topic, middle);
    if (entry && entry->log_time <= time) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

}  // namespace

std::optional<tf::TimePoint> neighbouringMessage(const scenegraph::ObjectStore& store, tf::TimePoint time,
                                                 int direction, std::optional<scenegraph::TopicId> topic) {
  std::optional<tf::TimePoint> best;
  for (scenegraph::TopicId id = 0; id < store.topicCount(); ++id) {
    if (topic ? id != *topic : store.topic(id).type == scenegraph::ObjectType::None) {
      continue;
    }
    if (direction > 0) {
      const auto entry = store.at(id, firstAfter(store, id, time));
      if (entry && (!best || entry->log_time < *best)) {
        best = entry->log_time;
      }
    } else if (time.ns > std::numeric_limits<std::int64_t>::min()) {
      const auto entry = store.newestAtOrBefore(id, tf::TimePoint{time.ns - 1});
      if (entry && (!best || entry->log_time > *best)) {
        best = entry->log_time;
      }
    }
  }
  return best;
}

TimeBar::TimeBar(QWidget* parent)
    : QWidget(parent),
      slider_(new QSlider(Qt::Horizontal, this)),
      speed_(new QComboBox(this)),
      step_mode_(new QComboBox(this)),
      timer_(new QTimer(this)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(6, 2, 6, 2);
  layout->setSpacing(3);
  timer_->setInterval(kTimerMs);
  connect(timer_, &QTimer::timeout, this, &TimeBar::onPlaybackTimer);

  connect(addButton(QStringLiteral("stepBack"), transportIcon(TransportIcon::StepBack), tr("Previous message (Left)")),
          &QToolButton::clicked, this, [this] { step(-1); });
  play_ = addButton(QStringLiteral("play"), transportIcon(TransportIcon::Play), tr("Play or pause (Space)"));
  connect(play_, &QToolButton::clicked, this, &TimeBar::togglePlaying);
  connect(
      addButton(QStringLiteral("stepForward"), transportIcon(TransportIcon::StepForward), tr("Next message (Right)")),
      &QToolButton::clicked, this, [this] { step(1); });
  loop_ = addButton(QStringLiteral("loop"), transportIcon(TransportIcon::Loop), tr("Loop"));
  loop_->setCheckable(true);
  connect(loop_, &QToolButton::toggled, this, [this](bool on) { setPlayback({playback_.speed, on}); });

  speed_->setObjectName(QStringLiteral("speed"));
  speed_->setToolTip(tr("Speed"));
  for (const double speed : kSpeeds) {
    speed_->addItem(QString::number(speed) + QStringLiteral("x"), speed);
  }
  speed_->setCurrentIndex(speed_->findData(1.0));
  connect(speed_, &QComboBox::activated, this,
          [this] { setPlayback({speed_->currentData().toDouble(), playback_.loops}); });
  layout->addWidget(speed_);

  step_mode_->setObjectName(QStringLiteral("stepMode"));
  step_mode_->setToolTip(tr("What a step goes to"));
  step_mode_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  step_mode_->setMinimumContentsLength(12);
  layout->addWidget(step_mode_);
  fillStepModes();

  slider_->setObjectName(QStringLiteral("timeSlider"));
  slider_->setRange(0, kSteps);
  slider_->setSingleStep(kSteps / 1000);
  slider_->setPageStep(kSteps / 50);
  auto* style = new JumpStyle;
  style->setParent(slider_);
  slider_->setStyle(style);
  connect(slider_, &QSlider::valueChanged, this, [this](int value) {
    if (is_playing_) {
      setPlaying(false);
    }
    setTime(timeAtStep(value, kSteps, range_));
  });
  layout->addWidget(slider_, 1);

  const auto add_edit = [&](const QString& name, const QString& tip, const QString& widest) {
    auto* edit = new QLineEdit(this);
    edit->setObjectName(name);
    edit->setToolTip(tip);
    edit->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    edit->setFixedWidth(kMinimumTextWidth / 3 + edit->fontMetrics().horizontalAdvance(widest));
    edit->setAlignment(Qt::AlignRight);
    connect(edit, &QLineEdit::editingFinished, this, [this, edit] { onTextEdited(*edit); });
    layout->addWidget(edit);
    return edit;
  };
  seconds_ =
      add_edit(QStringLiteral("seconds"), tr("Seconds from the start; accepts +SECONDS, nanoseconds, start, end"),
               QStringLiteral("+00000.000000000"));
  nanoseconds_ =
      add_edit(QStringLiteral("nanoseconds"), tr("Log time in nanoseconds; accepts nanoseconds, +SECONDS, start, end"),
               QStringLiteral("0000000000000000000"));
  showTime();
}

QToolButton* TimeBar::addButton(const QString& name, const QIcon& icon, const QString& tip) {
  auto* button = new QToolButton(this);
  button->setObjectName(name);
  button->setIcon(icon);
  button->setToolTip(tip);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  layout()->addWidget(button);
  return button;
}

void TimeBar::setDataset(std::shared_ptr<const scenegraph::Dataset> dataset) {
  setPlaying(false);
  dataset_ = std::move(dataset);
  known_topics_ = 0;
  fillStepModes();
}

void TimeBar::setRange(const TimeRange& range) {
  if (dataset_ != nullptr && dataset_->store().topicCount() != known_topics_) {
    fillStepModes();
  }
  if (range == range_) {
    return;
  }
  range_ = range;
  if (is_playing_) {
    restartClock();
  }
  showTime();
}

void TimeBar::fillStepModes() {
  const QVariant chosen = step_mode_->currentData();
  step_mode_->clear();
  step_mode_->addItem(tr("any message"), kAnyMessage);
  step_mode_->addItem(tr("1/30 s"), kOneFrame);
  known_topics_ = dataset_ == nullptr ? 0 : dataset_->store().topicCount();
  for (scenegraph::TopicId id = 0; id < known_topics_; ++id) {
    const scenegraph::TopicInfo info = dataset_->store().topic(id);
    if (info.type != scenegraph::ObjectType::None) {
      step_mode_->addItem(QString::fromStdString(info.name), static_cast<int>(id));
    }
  }
  step_mode_->setCurrentIndex(std::max(0, step_mode_->findData(chosen)));
}

void TimeBar::setTime(tf::TimePoint time) {
  if (time == time_) {
    showTime();
    return;
  }
  time_ = time;
  showTime();
  Q_EMIT timeChanged(time_);
}

void TimeBar::showTime() {
  const QSignalBlocker blocker(slider_);
  slider_->setValue(stepAtTime(time_, kSteps, range_));
  for (QLineEdit* edit : {seconds_, nanoseconds_}) {
    const QString text = edit == seconds_ ? secondsText(time_, range_) : QString::number(time_.ns);
    if (!(edit->hasFocus() && edit->isModified()) && edit->text() != text) {
      edit->setText(text);
    }
  }
}

void TimeBar::onTextEdited(QLineEdit& edit) {
  if (!edit.isModified()) {
    return;
  }
  edit.setModified(false);
  const auto time = parseTime(edit.text(), range_);
  if (!time) {
    Q_EMIT refused(tr("\"%1\" is not a time: write nanoseconds, +SECONDS, start or end").arg(edit.text()));
    showTime();
    return;
  }
  setPlaying(false);
  setTime(*time);
}

void TimeBar::step(int direction) {
  setPlaying(false);
  const int mode = step_mode_->currentData().toInt();
  if (mode == kOneFrame) {
    setTime(shifted(time_, direction * kFrameNs, range_));
    return;
  }
  if (dataset_ == nullptr) {
    return;
  }
  const auto topic = mode >= 0 ? std::optional(static_cast<scenegraph::TopicId>(mode)) : std::nullopt;
  if (const auto next = neighbouringMessage(dataset_->store(), time_, direction, topic)) {
    setTime(*next);
  }
}

void TimeBar::setPlaying(bool playing) {
  if (playing == is_playing_ || (playing && range_.first == range_.last)) {
    return;
  }
  is_playing_ = playing;
  play_->setIcon(transportIcon(playing ? TransportIcon::Pause : TransportIcon::Play));
  if (playing) {
    restartClock();
    timer_->start();
  } else {
    timer_->stop();
  }
}

void TimeBar::setPlayback(const PlaybackSettings& playback) {
  playback_ = playback;
  const QSignalBlocker blocker(loop_);
  loop_->setChecked(playback.loops);
  speed_->setCurrentIndex(speed_->findData(playback.speed));
  if (is_playing_) {
    restartClock();
  }
}

void TimeBar::restartClock() { clock_.start(steadyNow(), time_, range_, playback_); }

void TimeBar::onPlaybackTimer() {
  const PlaybackClock::Reading reading = clock_.read(steadyNow());
  if (reading.ended) {
    setPlaying(false);
  }
  setTime(reading.time);
}

}  // namespace stillframe::viewer
