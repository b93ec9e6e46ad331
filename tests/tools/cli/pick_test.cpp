// `stillframe pick` as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "program.h"

namespace stillframe::cli {
namespace {

using testing::HasSubstr;

/// The sample from straight above, 20 m high, 1 m being 20 pixels of 400.
std::vector<std::string> fromAbove(const std::string& file, std::vector<std::string> more) {
  std::vector<std::string> words{"pick",      file,      "--time",         "+1", "--size",        "400x400",
                                 "--camera",  "topdown", "--ortho-height", "20", "--fixed-frame", "base_link",
                                 "--look-at", "0,0,0"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(PickCommand, SaysWhatLiesAtAPixelWithAllItsFieldsAndPositions) {
  const TestFolder folder;
  const std::string file = folder.makeSample();
  // Some pixel shows a point of the lidar; neighbours within reach are found too.
  nlohmann::json found;
  for (int x = 40; x < 400 && found.is_null(); x += 40) {
    const Outcome picked = run(folder.path(), fromAbove(file, {"--pixel", std::to_string(x) + ",120", "--reach", "16",
                                                               "--layer", "/lidar/points", "--only", "--json"}));
    if (picked.code == 0) {
      found = picked.json();
    } else {
      EXPECT_EQ(picked.code, 3) << picked.err;
      EXPECT_EQ(picked.json()["picks"][0]["code"], "NothingThere");
    }
  }
  ASSERT_FALSE(found.is_null());
  const auto& pick = found["picks"][0];
  EXPECT_EQ(pick["code"], "Ok");
  EXPECT_EQ(pick["topic"], "/lidar/points");
  EXPECT_EQ(pick["kind"], "point");
  EXPECT_EQ(pick["source"]["frame"], "lidar_link");
  EXPECT_EQ(pick["fixed"]["frame"], "base_link");
  EXPECT_EQ(pick["display"]["frame"], "base_link");
  EXPECT_TRUE(pick["stamp_ns"].is_number_integer());
  for (const char* const name : {"x", "y", "z", "intensity"}) {
    EXPECT_TRUE(pick["fields"].contains(name)) << pick;
  }
  EXPECT_NEAR(pick["source"]["xyz"][0].get<double>(), pick["fields"]["x"].get<double>(), 1e-6);
}

TEST(PickCommand, MeasuresBetweenTwoPixels) {
  const TestFolder folder;
  const std::string file = folder.makeSample();
  const Outcome picked =
      run(folder.path(),
          fromAbove(file, {"--pixel", "120,200", "--pixel", "200,120", "--layer", "/map", "--only", "--json"}));
  ASSERT_EQ(picked.code, 0) << picked.err << picked.out;
  const auto said = picked.json();
  const auto& delta = said["measurement"]["delta"];
  const auto& from = said["picks"][0]["fixed"]["xyz"];
  const auto& to = said["picks"][1]["fixed"]["xyz"];
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = to[axis].get<double>() - from[axis].get<double>();
    EXPECT_DOUBLE_EQ(delta[axis].get<double>(), d);
    square += d * d;
  }
  EXPECT_DOUBLE_EQ(said["measurement"]["length_m"].get<double>(), std::sqrt(square));
  EXPECT_NEAR(said["measurement"]["length_m"].get<double>(), std::hypot(4.0, 4.0), 0.3);
  const Outcome text =
      run(folder.path(), fromAbove(file, {"--pixel", "120,200", "--pixel", "200,120", "--layer", "/map", "--only"}));
  EXPECT_THAT(text.out, HasSubstr("distance in base_link: "));
}

TEST(PickCommand, SaysThatNothingIsThereAndWhatIsWrong) {
  const TestFolder folder;
  const std::string file = folder.makeSample();
  const Outcome nothing =
      run(folder.path(), {"pick", file, "--pixel", "5,5", "--eye", "0,0,1000", "--look-at", "0,0,2000", "--json"});
  EXPECT_EQ(nothing.code, 3);
  EXPECT_EQ(nothing.json()["picks"][0]["code"], "NothingThere");
  EXPECT_THAT(nothing.err, HasSubstr("nothing there at pixel 5,5"));
  for (const char* const pixel : {"5", "5,", "a,b", "-1,5", "1280,5", "5,720", "5,5,5", "1e3,5", "99999999999,1"}) {
    const Outcome wrong = run(folder.path(), {"pick", file, "--pixel", pixel});
    EXPECT_EQ(wrong.code, 2) << pixel;
    EXPECT_THAT(wrong.err, HasSubstr("--pixel"));
  }
  EXPECT_EQ(run(folder.path(), {"pick", file}).code, 2);
  EXPECT_EQ(run(folder.path(), {"pick", file, "--pixel", "1,1", "--pixel", "2,2", "--pixel", "3,3"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"pick", file, "--pixel", "1,1", "--reach", "1000"}).code, 2);
}

}  // namespace
}  // namespace stillframe::cli
