#include "tools/osgplugin/option_string.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stillframe::osgplugin {
namespace {

TEST(OptionString, TakesFoldersAndFilesOfRobots) {
  const auto options = parseOptionString("package_path=/a package_path=\"/b c\" robot=/r.urdf");
  ASSERT_TRUE(options);
  EXPECT_EQ(options->view.recording.package_paths, (std::vector<std::string>{"/a", "/b c"}));
  EXPECT_EQ(options->view.recording.robots, (std::vector<std::string>{"/r.urdf"}));
}

TEST(OptionString, TakesTimeFrameAndClock) {
  const auto options = parseOptionString("time=+12.5 fixed_frame=map  tf_time=log static_always");
  ASSERT_TRUE(options);
  EXPECT_EQ(options->view.time.offset_ns, 12'500'000'000);
  EXPECT_EQ(options->view.fixed_frame, "map");
  EXPECT_EQ(options->view.recording.clock, scenegraph::TfClock::Log);
  EXPECT_TRUE(options->view.recording.static_always);
  EXPECT_FALSE(options->view.only_named_layers);
  EXPECT_TRUE(options->unknown.empty());
}

TEST(OptionString, TakesJustTheseLayers) {
  const auto options = parseOptionString("layers=/a;\"/b c\":color=x,size=\"1;2\"");
  ASSERT_TRUE(options);
  EXPECT_TRUE(options->view.only_named_layers);
  ASSERT_EQ(options->view.layers.size(), 2U);
  EXPECT_EQ(options->view.layers[0].id, "/a");
  EXPECT_EQ(options->view.layers[1].settings.at("color"), "x");
  EXPECT_EQ(options->view.layers[1].settings.at("size"), "1;2");
}

TEST(OptionString, TakesSettingsBesideAllOthers) {
  const auto options = parseOptionString("layer=tf:length=1 layer=grid");
  ASSERT_TRUE(options);
  EXPECT_FALSE(options->view.only_named_layers);
  EXPECT_EQ(options->view.layers.size(), 2U);
}

TEST(OptionString, TakesValuesWithSpaces) {
  EXPECT_EQ(parseOptionString("fixed_frame=\"my map\"")->view.fixed_frame, "my map");
}

TEST(OptionString, LeavesWordsOfOthersAlone) {
  const auto options = parseOptionString("noRotation x=y");
  ASSERT_TRUE(options);
  EXPECT_THAT(options->unknown, testing::ElementsAre("noRotation", "x=y"));
}

TEST(OptionString, RefusesBadValues) {
  for (const char* text : {"time=soon", "tf_time=sun", "layers=a:b=1,c", "layer=:x=1", "height=0"}) {
    EXPECT_FALSE(parseOptionString(text)) << text;
  }
}

}  // namespace
}  // namespace stillframe::osgplugin
