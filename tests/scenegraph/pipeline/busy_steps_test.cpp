// Steps that do not wait for an OpenGL that is software.
#include <chrono>
#include <thread>

#include "scenegraph/pipeline/gl_output.h"
#include "scenegraph/pipeline/gl_target.h"
#include "tests/scenegraph/pipeline/picture_steps.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kLargeWidth = 1600;
constexpr int kLargeHeight = 1200;

class BusySteps : public PictureSteps {
 protected:
  void SetUp() override {
    PictureSteps::SetUp();
    large_ = std::make_unique<Output>(kLargeWidth, kLargeHeight);
    root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
    addPanes(8);
    pipeline_->setPostChain(supersampling(4));
  }
  void TearDown() override {
    large_.reset();
    PictureSteps::TearDown();
  }

  [[nodiscard]] std::vector<float> colors() const { return pipeline_->readColor(0, kLargeHeight); }
  /// What is in the output, along its middle row.
  [[nodiscard]] std::vector<Output::Rgb> shown() const {
    std::vector<Output::Rgb> row;
    for (int x = 0; x < kLargeWidth; x += 16) {
      row.push_back(large_->pixel(x, kLargeHeight / 2));
    }
    return row;
  }
  std::expected<PictureStep, Status> step() {
    gl::bindFramebuffer(large_->id());  // as widgets do
    return pipeline_->step(large_->id(), kLargeWidth, kLargeHeight, 0.0);
  }
  PictureStep stepTo(PictureStep wanted) {
    auto done = step();
    for (int steps = 0; steps < 100'000 && done && *done != wanted && *done != PictureStep::Whole; ++steps) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      done = step();
    }
    return done.value_or(PictureStep::Waits);
  }

  std::unique_ptr<Output> large_;
};

TEST_F(BusySteps, ComeToTheSamePictureAndShowNothingBeforeIt) {
  ASSERT_TRUE(pipeline_->render(large_->id(), kLargeWidth, kLargeHeight));
  const auto whole = colors();
  const auto whole_shown = shown();
  pipeline_->setView({.eye_from_fixed = lookAt({0, 1, 3}, {0, 0, 0}, {0, 1, 0})});
  ASSERT_TRUE(pipeline_->render(large_->id(), kLargeWidth, kLargeHeight));
  const auto other_shown = shown();
  ASSERT_NE(other_shown, whole_shown);

  pipeline_->setView({.eye_from_fixed = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0})});
  pipeline_->setWake([] {});
  ASSERT_EQ(stepTo(PictureStep::Busy), PictureStep::Busy) << "nobody waits for eight panes in four million pixels";
  pipeline_->present(large_->id());
  EXPECT_EQ(shown(), other_shown) << "it is not whole";
  ASSERT_EQ(stepTo(PictureStep::Whole), PictureStep::Whole);
  EXPECT_EQ(shown(), other_shown) << "it has not been presented";
  EXPECT_TRUE(colors() == whole);
  pipeline_->present(large_->id());
  EXPECT_EQ(shown(), whole_shown);
}

TEST_F(BusySteps, AreExchangedForTheOutputOfWhoReadsIt) {
  ASSERT_TRUE(pipeline_->render(large_->id(), kLargeWidth, kLargeHeight));
  const auto read = [](const gl::Output& output) {
    std::vector<std::uint32_t> argb(static_cast<std::size_t>(kLargeWidth) * kLargeHeight);
    output.read(argb.data());
    return argb;
  };
  const auto whole = read(*large_);
  for (int y = 0; y < kLargeHeight; y += 97) {
    const auto [r, g, b] = large_->pixel(kLargeWidth / 2, kLargeHeight - 1 - y);
    const std::uint32_t there = whole[static_cast<std::size_t>(y) * kLargeWidth + kLargeWidth / 2];
    EXPECT_EQ(there & 0xFFFFFFU, static_cast<std::uint32_t>((r << 16) | (g << 8) | b)) << "the top row first";
  }

  auto mine = std::make_unique<gl::Output>(kLargeWidth, kLargeHeight);
  pipeline_->setWake([] {});
  const std::uint32_t given = mine->id();
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_EQ(stepTo(PictureStep::Whole), PictureStep::Whole);
    pipeline_->present(mine);
    EXPECT_TRUE(read(*mine) == whole) << frame;
    EXPECT_EQ(mine->id() == given, frame % 2 == 1) << "two of them take turns";
    pipeline_->present(mine);
    EXPECT_TRUE(read(*mine) == whole) << "there is no other";
  }
}

TEST_F(BusySteps, AreLeftForAPictureAtOnceAndForOneOfAnotherSize) {
  ASSERT_TRUE(pipeline_->render(large_->id(), kLargeWidth, kLargeHeight));
  const auto whole = shown();
  const Pixels small = atOnce();
  pipeline_->setWake([] {});
  ASSERT_EQ(stepTo(PictureStep::Busy), PictureStep::Busy);
  EXPECT_TRUE(atOnce() == small);
  ASSERT_EQ(stepTo(PictureStep::Busy), PictureStep::Busy);
  ASSERT_TRUE(pipeline_->render(large_->id(), kLargeWidth, kLargeHeight));
  EXPECT_EQ(shown(), whole);
  ASSERT_EQ(stepTo(PictureStep::Busy), PictureStep::Busy);
  pipeline_->setWake(nullptr);  // from now on it waits
  for (auto done = step(); done != PictureStep::Whole; done = step()) {
    ASSERT_TRUE(done == PictureStep::More || done == PictureStep::Busy);
  }
  pipeline_->present(large_->id());
  EXPECT_EQ(shown(), whole);
}

}  // namespace
}  // namespace stillframe::scenegraph
