#include "viewer/time/time_bar.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLineEdit>
#include <QSlider>
#include <QTest>
#include <vector>

#include "tests/viewer/viewer_support.h"

namespace stillframe::viewer {
namespace {

using tf::TimePoint;
using namespace tf::literals;
using scenegraph::ObjectType;

class TimeBarTest : public testing::Test {
 protected:
  TimeBarTest() {
    QObject::connect(&bar_, &TimeBar::timeChanged, &bar_, [this](TimePoint time) { told_.push_back(time); });
    QObject::connect(&bar_, &TimeBar::refused, &bar_, [this](const QString& text) { refused_ = text; });
    bar_.setRange(range_);
    bar_.setTime(range_.first);
    told_.clear();
  }

  template <typename T>
  T* child(const char* name) {
    return bar_.findChild<T*>(QString::fromUtf8(name));
  }
  void type(const char* field, const char* text) {
    auto* edit = child<QLineEdit>(field);
    edit->selectAll();
    QTest::keyClicks(edit, QString::fromUtf8(text));
    QTest::keyClick(edit, Qt::Key_Return);
  }

  const TimeRange range_{TimePoint{1'700'000'000'000'000'000}, TimePoint{1'700'000'010'000'000'000}};
  TimeBar bar_;
  std::vector<TimePoint> told_;
  QString refused_;
};

TEST_F(TimeBarTest, SliderSetsTheTickExactly) {
  bar_.slider().setValue(250'000);
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'002'500'000'000});
  bar_.slider().setValue(TimeBar::kSteps);
  EXPECT_EQ(bar_.time(), range_.last);
  bar_.slider().setValue(0);
  EXPECT_EQ(bar_.time(), range_.first);
  EXPECT_EQ(told_.size(), 3U);
}

TEST_F(TimeBarTest, MovingTheTrackerDoesNotSnapItToTheSlider) {
  const TimePoint odd{1'700'000'003'333'333'333};
  bar_.setTime(odd);
  EXPECT_EQ(bar_.time(), odd);
  EXPECT_EQ(bar_.slider().value(), 333'333);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_EQ(told_.front(), odd);
}

TEST_F(TimeBarTest, DraggingTheHandleEndsAtTheLastInstant) {
  bar_.resize(1200, 40);
  bar_.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&bar_));
  QSlider& slider = bar_.slider();
  QTest::mousePress(&slider, Qt::LeftButton, {}, QPoint(slider.width() / 2, slider.height() / 2));
  QTest::mouseMove(&slider, QPoint(slider.width() + 50, slider.height() / 2));
  QTest::mouseRelease(&slider, Qt::LeftButton, {}, QPoint(slider.width() + 50, slider.height() / 2));
  EXPECT_EQ(bar_.time(), range_.last);
}

TEST_F(TimeBarTest, TypedTimesAreTakenToTheNanosecond) {
  type("seconds", "+1.000000007");
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'001'000'000'007});
  type("nanoseconds", "1700000002000000009");
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'002'000'000'009});
  type("nanoseconds", "end");
  EXPECT_EQ(bar_.time(), range_.last);
  EXPECT_EQ(child<QLineEdit>("nanoseconds")->text(), QStringLiteral("1700000010000000000"));
}

TEST_F(TimeBarTest, UnreadableTimeIsRefusedAndTheOldOneShownAgain) {
  type("seconds", "noon");
  EXPECT_EQ(bar_.time(), range_.first);
  EXPECT_TRUE(refused_.contains(QStringLiteral("noon"))) << refused_.toStdString();
  EXPECT_EQ(child<QLineEdit>("seconds")->text(), QStringLiteral("+0.000000000"));
}

TEST_F(TimeBarTest, StepsFromMessageToMessage) {
  test::DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(1'700'000'001'000'000'000, "map", "odom");
  builder.transform(1'700'000'004'000'000'000, "map", "odom");
  builder.topic("/other", ObjectType::FrameTransforms).transform(1'700'000'002'000'000'000, "odom", "base");
  bar_.setDataset(builder.build());
  bar_.step(1);
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'001'000'000'000});
  bar_.step(1);
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'002'000'000'000});
  bar_.step(1);
  bar_.step(1);
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'004'000'000'000}) << "the last message is the last step";
  bar_.step(-1);
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'002'000'000'000});
  auto* mode = child<QComboBox>("stepMode");
  mode->setCurrentIndex(mode->findText(QStringLiteral("/tf")));
  bar_.step(-1);
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'001'000'000'000});
}

TEST_F(TimeBarTest, PlaysToTheEndAndStops) {
  bar_.setTime(TimePoint{range_.last.ns - 200'000'000});
  bar_.setPlayback({.speed = 10.0});
  bar_.togglePlaying();
  EXPECT_TRUE(bar_.isPlaying());
  ASSERT_TRUE(test::waitFor([&] { return !bar_.isPlaying(); }));
  EXPECT_EQ(bar_.time(), range_.last);
}

TEST_F(TimeBarTest, SliderTakesOverFromPlaying) {
  bar_.togglePlaying();
  bar_.slider().setValue(500'000);
  EXPECT_FALSE(bar_.isPlaying());
  EXPECT_EQ(bar_.time(), TimePoint{1'700'000'005'000'000'000});
}

TEST_F(TimeBarTest, LoopingGoesOnPastTheEnd) {
  bar_.setTime(TimePoint{range_.last.ns - 1'000'000});
  bar_.setPlayback({.speed = 1.0, .loops = true});
  bar_.togglePlaying();
  EXPECT_TRUE(test::waitFor([&] { return bar_.time() < TimePoint{1'700'000'005'000'000'000}; }));
  EXPECT_TRUE(bar_.isPlaying());
}

}  // namespace
}  // namespace stillframe::viewer
