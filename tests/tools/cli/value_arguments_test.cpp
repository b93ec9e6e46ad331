#include "tools/cli/value_arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stillframe::cli {
namespace {

TEST(ValueArguments, ReadsVectorsInDouble) {
  const auto vector = parseVector("--eye", "500000.123456789,-4649776.5,+1e-3");
  ASSERT_TRUE(vector);
  EXPECT_EQ(*vector, glm::dvec3(500000.123456789, -4649776.5, 1e-3));
}

TEST(ValueArguments, RefusesWhatIsNoVector) {
  for (const char* text :
       {"", "1", "1,2", "1,2,3,4", "1,2,", "1,,3", "a,b,c", "1,2,nan", "1,2,inf", "1,2,1e999", "1, 2,3"}) {
    const auto vector = parseVector("--eye", text);
    ASSERT_FALSE(vector) << text;
    EXPECT_THAT(vector.error().message, testing::StartsWith("--eye")) << text;
  }
}

TEST(ValueArguments, ReadsSizes) {
  EXPECT_EQ(parseSize("640x480"), (PictureSize{640, 480}));
  EXPECT_EQ(parseSize("1x16384"), (PictureSize{1, 16384}));
}

TEST(ValueArguments, RefusesSizesThatNobodyCanDraw) {
  for (const char* text : {"0x0", "0x1", "1x0", "100000x100000", "-1x5", "640", "x", "640x", "x480", "640x480x3",
                           "99999999999999999999x1", "640 x 480"}) {
    EXPECT_FALSE(parseSize(text)) << text;
  }
}

TEST(ValueArguments, ReadsColoursInEveryForm) {
  EXPECT_EQ(parseColor("--background", "#ff0080"), (scenegraph::Color{1.0F, 0.0F, 128.0F / 255.0F, 1.0F}));
  EXPECT_EQ(parseColor("--background", "0.5,0,1"), (scenegraph::Color{0.5F, 0.0F, 1.0F, 1.0F}));
  EXPECT_EQ(parseColor("--background", "255,0,51"), (scenegraph::Color{1.0F, 0.0F, 0.2F, 1.0F}));
  EXPECT_EQ(parseColor("--background", "#ff008033"), (scenegraph::Color{1.0F, 0.0F, 128.0F / 255.0F, 0.2F}));
  EXPECT_EQ(parseColor("--background", "1,0.5,0,0.25"), (scenegraph::Color{1.0F, 0.5F, 0.0F, 0.25F}));
  EXPECT_EQ(parseColor("--background", "255,0,0,51"), (scenegraph::Color{1.0F, 0.0F, 0.0F, 0.2F}));
  EXPECT_EQ(parseColor("--background", "transparent"), (scenegraph::Color{0.0F, 0.0F, 0.0F, 0.0F}));
}

TEST(ValueArguments, RefusesWhatIsNoColour) {
  for (const char* text : {"", ",", "red", "#fff", "#gg0000", "#ff00801", "#ff0080-1", "1,1", "-1,0,0", "256,0,0",
                           "nan,0,0", "1,1,1,1,1", "1,1,1,", "0,0,0,-1", "transparent "}) {
    EXPECT_FALSE(parseColor("--background", text)) << text;
  }
}

TEST(ValueArguments, KeepsNumbersInRange) {
  EXPECT_DOUBLE_EQ(*parseNumber("--fov", "50.5", 1.0, 170.0), 50.5);
  for (const char* text : {"0", "180", "nan", "", "5x"}) {
    EXPECT_FALSE(parseNumber("--fov", text, 1.0, 170.0)) << text;
  }
}

}  // namespace
}  // namespace stillframe::cli
