#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "program.h"
#include "scenegraph/export/picture_io.h"

namespace stillframe::cli {
namespace {

using testing::HasSubstr;
using Names = std::vector<std::string>;

class RenderSequence : public testing::Test {
 protected:
  Outcome render(const Names& options) {
    Names words{"render", sample_, "--size", "48x32"};
    words.insert(words.end(), options.begin(), options.end());
    return run(folder_.path(), words);
  }
  scenegraph::BytePicture picture(const char* name) { return scenegraph::readPng(folder_ / name).value(); }
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path()), {});
  }

  TestFolder folder_;
  std::string sample_ = folder_.makeSample();
};

TEST_F(RenderSequence, OfTimesIsWhatEachTimeShowsByItself) {
  const Outcome drawn = render({"--times", "+0.25:+1.25:0.5", "--out", "f_%03d.png", "--json"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto said = drawn.json();
  ASSERT_EQ(said["pictures"].size(), 3U);
  EXPECT_FALSE(said.contains("layers"));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& one = said["pictures"][i];
    EXPECT_EQ(one["file"], "f_00" + std::to_string(i) + ".png");
    EXPECT_EQ(one["time_ns"], kSampleStart_ns + 250'000'000 + static_cast<std::int64_t>(i) * 500'000'000);
    EXPECT_GE(one["layers"].size(), 10U);
    // The camera stays where the first instant put it.
    const std::string time = std::to_string(one["time_ns"].get<std::int64_t>());
    ASSERT_EQ(
        render({"--times", "+0.25:" + time + ":" + std::to_string(0.5 * static_cast<double>(i) + (i == 0 ? 1 : 0)),
                "--out", "alone_%d.png"})
            .code,
        0);
    EXPECT_EQ(picture(("f_00" + std::to_string(i) + ".png").c_str()), picture(i == 0 ? "alone_0.png" : "alone_1.png"))
        << "whatever was shown in between";
  }
}

TEST_F(RenderSequence, ATurntableGoesOnceRound) {
  const Outcome drawn = render(
      {"--turntable", "4", "--out", "t%d.png", "--json", "--time", "+1", "--eye", "6,1,3", "--look-at", "1,1,0"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto said = drawn.json();
  ASSERT_EQ(said["pictures"].size(), 4U);
  EXPECT_DOUBLE_EQ(said["pictures"][1]["turn_deg"].get<double>(), 90.0);
  // A quarter turn from +X is +Y, counterclockwise.
  for (const auto& [eye, turned] : {std::pair{"6,1,3", "t0.png"}, {"1,6,3", "t1.png"}, {"-4,1,3", "t2.png"}}) {
    ASSERT_EQ(render({"--out", "a.png", "--time", "+1", "--eye", eye, "--look-at", "1,1,0"}).code, 0);
    const auto expected = picture("a.png");
    const auto got = picture(turned);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < got.rgb.size(); ++i) {
      differing += std::abs(got.rgb[i] - expected.rgb[i]) > 2 ? 1U : 0U;
    }
    EXPECT_LT(differing, got.rgb.size() / 50) << turned;  // edges by a rounding
  }
  EXPECT_NE(picture("t0.png"), picture("t2.png"));
}

TEST_F(RenderSequence, MistakesAreNamedBeforeAnythingIsWritten) {
  const std::ptrdiff_t before = files();
  for (const auto& [options, named] : std::vector<std::pair<Names, std::string>>{
           {{"--times", "+0:+1:0.5", "--out", "a.png"}, "frame_%05d.png"},
           {{"--times", "+0:+1:0", "--out", "a%d.png"}, "step"},
           {{"--times", "+1:+0:1", "--out", "a%d.png"}, "before"},
           {{"--times", "+0:+9:1", "--out", "a%d.png"}, "outside"},
           {{"--times", "+0:+1", "--out", "a%d.png"}, "A:B:STEP"},
           {{"--times", "+0:+1:1", "--time", "+1", "--out", "a%d.png"}, "--time"},
           {{"--times", "+0:+1:1", "--turntable", "3", "--out", "a%d.png"}, "--turntable"},
           {{"--turntable", "0", "--out", "a%d.png"}, "--turntable"},
           {{"--turntable", "2.5", "--out", "a%d.png"}, "--turntable"},
           {{"--turntable", "1000000", "--out", "a%d.png"}, "--turntable"},
           {{"--turntable", "3", "--out", "a%s.png"}, "frame_%05d.png"},
           {{"--turntable", "3", "--out", "a%d.jpg"}, ".png"}}) {
    const Outcome refused = render(options);
    EXPECT_EQ(refused.code, 2) << testing::PrintToString(options);
    EXPECT_THAT(refused.err, HasSubstr(named));
  }
  EXPECT_LE(files(), before + 1) << "stderr.txt alone";
  EXPECT_EQ(render({"--turntable", "3", "--out", "no/such/a%d.png"}).code, 1);
}

TEST_F(RenderSequence, AnInterruptFinishesThePictureAndSaysHowManyThereAre) {
  const std::string command = "cd '" + folder_.path().string() +
                              "' && timeout --foreground --preserve-status -s INT 1.5 '" + STILLFRAME_PROGRAM +
                              "' render '" + sample_ +
                              "' --size 16x16 --turntable 90000 --out c%d.png >/dev/null 2>stderr.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  std::ifstream errors(folder_ / "stderr.txt");
  const std::string said{std::istreambuf_iterator<char>(errors), {}};
  EXPECT_THAT(said, testing::MatchesRegex("stillframe: stopped after [0-9]+ of 90000 pictures\n"));
  for (const auto& file : std::filesystem::directory_iterator(folder_.path())) {
    if (file.path().filename().string().starts_with("c")) {
      EXPECT_TRUE(scenegraph::readPng(file.path())) << file.path();
    }
  }
}

TEST_F(RenderSequence, ATransparentBackgroundIsAlphaInThePicture) {
  ASSERT_EQ(render({"--out", "clear.png", "--background", "transparent"}).code, 0);
  ASSERT_EQ(render({"--out", "solid.png"}).code, 0);
  const auto color_type = [&](const char* name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    return static_cast<int>(bytes.at(25));  // in IHDR: 2 RGB, 6 RGBA
  };
  EXPECT_EQ(color_type("clear.png"), 6);
  EXPECT_EQ(color_type("solid.png"), 2);
}

}  // namespace
}  // namespace stillframe::cli
