#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "program.h"
#include "scenegraph/export/picture_io.h"
#include "scenegraph/layout/window_layout.h"

namespace stillframe::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

scenegraph::ViewLayout makeLayout() {
  scenegraph::ViewLayout layout;
  layout.fixed_frame = "odom";
  scenegraph::CameraRig rig;
  rig.look({.focal_point = {1.0, 0.5, 0.5}, .yaw_rad = 2.0, .pitch_rad = 0.9, .radius_m = 6.0});
  layout.viewpoint.camera = rig.state();
  layout.is_camera_touched = true;
  layout.effects = {{"edl", "true"}};
  layout.layers.layers = {{"grid", "", false, {}}, {"/lidar/points", "", true, {{"point_size", "6"}}}};
  return layout;
}

std::string textOf(const scenegraph::ViewLayout& view) { return scenegraph::writeXml(toXml(view)); }

class LayoutOption : public testing::Test {
 protected:
  Outcome render(const char* out, std::vector<std::string> more) {
    std::vector<std::string> words{"render", sample_, "--out", out, "--time", "+1", "--size", size_, "--json"};
    std::ranges::move(more, std::back_inserter(words));
    return run(folder_.path(), words);
  }
  std::vector<std::uint8_t> picture(const char* name) {
    const auto read = scenegraph::readPng(folder_ / name);
    return read ? std::vector<std::uint8_t>(read->rgb.begin(), read->rgb.end()) : std::vector<std::uint8_t>{};
  }
  static const nlohmann::json& layer(const nlohmann::json& said, const char* topic) {
    return *std::ranges::find_if(said["layers"], [&](const auto& of) { return of["topic"] == topic; });
  }

  std::string size_ = "160x120";
  TestFolder folder_;
  std::string sample_ = folder_.makeSample();
};

TEST_F(LayoutOption, ShowsWhatIsPickedMeasuredAndTheLegendUnlessToldNotTo) {
  size_ = "640x480";
  scenegraph::ViewLayout layout = makeLayout();
  scenegraph::PickResult pick{
      .topic = "tf", .layer = {}, .frame = "odom", .picked = {}, .fixed_frame = "odom", .time = {}};
  pick.picked.point_in_frame = {1.0, 0.5, 0.5};
  layout.picks.selected = pick;
  scenegraph::PickResult end = pick;
  end.picked.point_in_frame = {1.0, 1.5, 0.5};
  layout.picks.measured.emplace_back(pick, end);
  const std::string file = folder_.makeFile("view.xml", textOf(layout));
  const Outcome with = render("with.png", {"--layout", file, "--no-legend"});
  ASSERT_EQ(with.code, 0) << with.err;
  EXPECT_NEAR(with.json()["measurements"][0]["length_m"].get<double>(), 1.0, 1e-9);
  const Outcome without = render("without.png", {"--layout", file, "--no-legend", "--no-picks"});
  ASSERT_EQ(without.code, 0) << without.err;
  EXPECT_TRUE(without.json()["measurements"].empty());
  ASSERT_EQ(render("legend.png", {"--layout", file, "--no-picks"}).code, 0);
  const auto differs = [&](const char* a, const char* b) {
    const auto one = picture(a);
    const auto other = picture(b);
    int count = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      count += one[i] == other.at(i) ? 0 : 1;
    }
    return count;
  };
  EXPECT_GT(differs("with.png", "without.png"), 500);
  EXPECT_LT(differs("with.png", "without.png"), 30'000);
  EXPECT_GT(differs("legend.png", "without.png"), 10'000) << "as the window shows it";
  layout.shows_legend = false;
  const std::string plain = folder_.makeFile("plain.xml", textOf(layout));
  ASSERT_EQ(render("plain.png", {"--layout", plain, "--no-picks"}).code, 0);
  EXPECT_EQ(picture("plain.png"), picture("without.png"));
}

TEST_F(LayoutOption, GivesFramesCameraEffectsAndLayers) {
  const std::string file = folder_.makeFile("view.xml", textOf(makeLayout()));
  const Outcome drawn = render("a.png", {"--layout", file});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto said = drawn.json();
  EXPECT_EQ(said["fixed_frame"], "odom");
  EXPECT_TRUE(said["effects"].contains("edl"));
  EXPECT_EQ(layer(said, "grid")["visible"], false);
  EXPECT_TRUE(said["layout_notes"].empty()) << said["layout_notes"];
  // The same said by options.
  const Outcome by_hand = render("b.png", {"--fixed-frame", "odom", "--edl", "--layer", "grid:visible=false", "--layer",
                                           "/lidar/points:point_size=6", "--eye", "0,0,0"});
  ASSERT_EQ(by_hand.code, 0) << by_hand.err;
  EXPECT_NE(picture("a.png"), picture("b.png"));
  ASSERT_EQ(render("c.png", {"--layout", file}).code, 0);
  EXPECT_EQ(picture("a.png"), picture("c.png"));
}

TEST_F(LayoutOption, UntouchedCameraSeesEverythingAsWithoutALayout) {
  scenegraph::ViewLayout layout;
  const std::string file = folder_.makeFile("view.xml", textOf(layout));
  ASSERT_EQ(render("a.png", {"--layout", file}).code, 0);
  ASSERT_EQ(render("b.png", {}).code, 0);
  EXPECT_EQ(picture("a.png"), picture("b.png"));
}

TEST_F(LayoutOption, OptionsGoBeforeIt) {
  const std::string file = folder_.makeFile("view.xml", textOf(makeLayout()));
  const auto said = render("a.png", {"--layout", file, "--fixed-frame", "map", "--layer", "grid:visible=true",
                                     "--edl=false", "--camera", "topdown"})
                        .json();
  EXPECT_EQ(said["fixed_frame"], "map");
  EXPECT_EQ(layer(said, "grid")["visible"], true);
  EXPECT_FALSE(said["effects"].contains("edl"));
  // A layout that says the same.
  ASSERT_EQ(render("a.png", {"--layout", file, "--fixed-frame", "map", "--edl=false", "--camera", "topdown"}).code, 0);
  scenegraph::ViewLayout same = makeLayout();
  same.fixed_frame = "map";
  same.effects.clear();
  const std::string other = folder_.makeFile("same.xml", textOf(same));
  ASSERT_EQ(render("b.png", {"--layout", other, "--camera", "topdown"}).code, 0);
  EXPECT_EQ(picture("a.png"), picture("b.png"));
}

TEST_F(LayoutOption, AnyViewOfAnArrangementCanBeNamed) {
  scenegraph::Place view;
  view.view = makeLayout();
  scenegraph::Layout layout;
  layout.windows.resize(2);
  layout.windows[0].place = view;
  view.view->fixed_frame = "base_link";
  layout.windows[1].place = view;
  const std::string file = folder_.makeFile("all.xml", scenegraph::writeXml(toXml(layout)));
  EXPECT_EQ(render("a.png", {"--layout", file}).json()["fixed_frame"], "odom");
  EXPECT_EQ(render("a.png", {"--layout", file, "--layout-view", "2"}).json()["fixed_frame"], "base_link");
  const Outcome none = render("a.png", {"--layout", file, "--layout-view", "3"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("views 1 to 2"));
}

TEST_F(LayoutOption, LayoutOfAnotherRecordingAppliesWhatItCan) {
  scenegraph::ViewLayout layout = makeLayout();
  layout.fixed_frame = "warehouse";
  layout.viewpoint.display_frame = "drone";
  layout.layers.layers.push_back({"/radar", "", true, {{"gain", "2"}}});
  layout.layers.layers[1].settings["sparkle"] = "1";
  layout.effects["glow"] = "true";
  layout.picks.selected.emplace().frame = "hangar";
  const Outcome drawn = render("a.png", {"--layout", folder_.makeFile("view.xml", textOf(layout))});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto said = drawn.json();
  EXPECT_EQ(said["fixed_frame"], "map") << "automatic";
  EXPECT_EQ(said["layout_notes"].size(), 6U) << said["layout_notes"];
  EXPECT_EQ(layer(said, "grid")["visible"], false);
}

TEST_F(LayoutOption, BrokenLayoutIsOneLine) {
  for (const auto& [name, text] :
       {std::pair("cut.xml", textOf(makeLayout()).substr(0, 300)),
        std::pair("version.xml", std::string("<Scene3DDock version='7'/>")),
        std::pair("number.xml", std::string("<Scene3DDock version='1'><Camera fly.eye_x='1e400'/>"
                                            "</Scene3DDock>"))}) {
    const Outcome refused = render("a.png", {"--layout", folder_.makeFile(name, text)});
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, StartsWith("stillframe: "));
    EXPECT_THAT(refused.err, HasSubstr(name));
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  }
  EXPECT_EQ(render("a.png", {"--layout", "none.xml"}).code, 1);
}

}  // namespace
}  // namespace stillframe::cli
