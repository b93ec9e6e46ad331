#include "viewer/widget/frame_turn.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <memory>
#include <string>

namespace stillframe::viewer {
namespace {

/// Views that note in one text who has drawn a step.
class Views {
 public:
  struct View {
    int steps = 1;  // of a frame
    int frames = 1;
    bool is_favoured = false;
    bool waits = false;  // for others, after this step
    int done = 0;
    std::unique_ptr<FrameTurn> turn;
  };

  View& add(char name, int steps, int frames = 1) {
    auto& view = *views_.emplace_back(std::make_unique<View>());
    view.steps = steps;
    view.frames = frames;
    view.turn = std::make_unique<FrameTurn>(
        [this, &view, name] {
          drawn += name;
          const bool goes_on = ++view.done % view.steps != 0;
          if (!goes_on && view.done < view.steps * view.frames) {
            view.turn->ask();  // something moves on
          }
          return view.waits ? FrameTurn::Step::Waits : goes_on ? FrameTurn::Step::GoesOn : FrameTurn::Step::Over;
        },
        [&view] { return view.is_favoured; });
    return view;
  }

  /// A pass of the event loop, without waiting for what comes by itself.
  std::string pass() {
    drawn.clear();
    QCoreApplication::sendPostedEvents();
    return drawn;
  }
  std::string all() {
    std::string order;
    for (std::string step = pass(); !step.empty(); step = pass()) {
      order += step;
    }
    return order;
  }

  std::string drawn;

 private:
  std::vector<std::unique_ptr<View>> views_;
};

TEST(FrameTurn, OneStepOfOneViewIsAnEvent) {
  Views views;
  for (const char name : {'a', 'b', 'c', 'd'}) {
    views.add(name, 2).turn->ask();
  }
  for (const char* const step : {"a", "a", "b", "b", "c", "c", "d", "d", ""}) {
    EXPECT_EQ(views.pass(), step);
  }
}

TEST(FrameTurn, AsksManyTimesForOneStep) {
  Views views;
  auto& view = views.add('a', 1);
  view.turn->ask();
  view.turn->ask();
  EXPECT_EQ(views.all(), "a");
  view.turn->ask();
  EXPECT_EQ(views.all(), "a");
}

TEST(FrameTurn, ComesFirstWhereSomebodyLooksAndLeavesTurnsToOthers) {
  Views views;
  views.add('a', 1, 2).turn->ask();
  views.add('b', 2, 2).turn->ask();
  auto& looked_at = views.add('c', 2, 4);
  looked_at.is_favoured = true;
  looked_at.turn->ask();
  EXPECT_EQ(views.all(), "ccaccbbccaccbb");
}

TEST(FrameTurn, HasNoStepsWhileItWaits) {
  Views views;
  auto& waiting = views.add('a', 2);
  waiting.waits = true;
  waiting.turn->ask();
  EXPECT_EQ(views.all(), "a");
  auto& other = views.add('b', 1);
  other.turn->ask();
  EXPECT_EQ(views.all(), "") << "its frame is under way: the other comes after it";
  waiting.waits = false;
  waiting.turn->ask();
  EXPECT_EQ(views.all(), "ab");
}

TEST(FrameTurn, LeavesItsTurnToOthersWhereItGoesWhileItWaits) {
  Views views;
  auto& gone = views.add('a', 2);
  gone.waits = true;
  gone.turn->ask();
  EXPECT_EQ(views.all(), "a");
  views.add('b', 1).turn->ask();
  gone.turn.reset();
  EXPECT_EQ(views.all(), "b");
}

TEST(FrameTurn, IsForgottenWithItsView) {
  Views views;
  auto& gone = views.add('a', 3);
  auto& left = views.add('b', 1);
  gone.turn->ask();
  left.turn->ask();
  EXPECT_EQ(views.pass(), "a");
  gone.turn.reset();
  EXPECT_EQ(views.all(), "b");
}

}  // namespace
}  // namespace stillframe::viewer
