#include "scenegraph/layout/view_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenegraph/layout/layout_builders.h"

namespace stillframe::scenegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

ViewLayout reread(const ViewLayout& layout) {
  const auto root = parseXml(writeXml(toXml(layout)));
  return viewLayoutOf(root.value()).value();
}

std::string rewritten(const std::string& text) { return writeXml(toXml(viewLayoutOf(parseXml(text).value()).value())); }

TEST(ViewLayout, ComesBackExactly) {
  const ViewLayout layout = test::makeViewLayout();
  const ViewLayout back = reread(layout);
  EXPECT_EQ(back.dataset, layout.dataset);
  EXPECT_EQ(back.fixed_frame, layout.fixed_frame);
  EXPECT_EQ(back.viewpoint, layout.viewpoint);
  EXPECT_EQ(back.is_camera_touched, layout.is_camera_touched);
  EXPECT_EQ(back.has_smooth_moves, layout.has_smooth_moves);
  EXPECT_EQ(back.saved_views, layout.saved_views);
  EXPECT_EQ(back.effects, layout.effects);
  EXPECT_EQ(back.layers, layout.layers);
  EXPECT_EQ(back.shows_layers, layout.shows_layers);
  EXPECT_EQ(back.shows_effects, layout.shows_effects);
  EXPECT_EQ(back.panel_width, layout.panel_width);
  EXPECT_EQ(back.shows_legend, layout.shows_legend);
  EXPECT_EQ(back.picks, layout.picks);
}

TEST(ViewLayout, AFreshViewComesBackToo) {
  const ViewLayout back = reread({});
  EXPECT_EQ(back.fixed_frame, std::nullopt) << "automatic";
  EXPECT_EQ(back.viewpoint, ViewpointState{});
  EXPECT_TRUE(back.has_smooth_moves && back.shows_layers && back.shows_legend && !back.is_camera_touched);
  EXPECT_TRUE(back.picks.isEmpty());
}

TEST(ViewLayout, RoundTripIsStableByteForByte) {
  const std::string once = writeXml(toXml(test::makeViewLayout()));
  EXPECT_EQ(rewritten(once), once);
}

TEST(ViewLayout, WhatIsMissingKeepsItsDefault) {
  const auto layout = viewLayoutOf(parseXml("<Scene3DDock version=\"1\"/>").value());
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->viewpoint, ViewpointState{});
  EXPECT_TRUE(layout->layers.layers.empty());
}

TEST(ViewLayout, FieldsOfWhatIsPickedComeBackAsTheirTexts) {
  ViewLayout layout;
  layout.picks.selected = test::makePick("lidar", {});
  layout.picks.selected->picked.fields = {{"ring", PickValue(std::uint64_t{7})}, {"height", PickValue(0.1F)}};
  const auto fields = reread(layout).picks.selected->picked.fields;
  EXPECT_THAT(fields, ElementsAre(std::pair("ring", PickValue(std::string("7"))),
                                  std::pair("height", PickValue(std::string("0.1")))));
}

TEST(ViewLayout, KeepsTheOrderOfLayers) {
  std::vector<std::string> ids;
  for (const LayerState& layer : reread(test::makeViewLayout()).layers.layers) {
    ids.push_back(layer.id);
  }
  EXPECT_THAT(ids, ElementsAre("tf", "/lidar/points", "/lidar/points#2"));
}

TEST(ViewLayout, UnknownAttributesAndElementsSurviveEverywhere) {
  const std::string text = rewritten(test::viewText(
      "of_a_later_day=\"1\"",
      "<Camera kind=\"fly\" roll=\"2\"><Lens/></Camera><Follow wobble=\"3\"/><Effects glow=\"4\"><Extra/></Effects>"
      "<SavedView name=\"a\" tag=\"5\"><Note>text</Note><Camera zoom=\"6\"/></SavedView>"
      "<Layer id=\"/p\" pinned=\"7\"><Legend at=\"8\"/><Setting key=\"k\" value=\"v\" note=\"9\"/></Layer>"
      "<Measure from=\"10\"><Point/></Measure><Picked frame=\"lidar\" tint=\"11\"><Note2/></Picked>"));
  for (const char* kept : {"of_a_later_day=\"1\"", "roll=\"2\"", "<Lens/>", "wobble=\"3\"", "glow=\"4\"", "<Extra/>",
                           "tag=\"5\"", "<Note>text</Note>", "zoom=\"6\"", "pinned=\"7\"", "<Legend at=\"8\"/>",
                           "note=\"9\"", "<Measure from=\"10\">", "tint=\"11\"", "<Note2/>"}) {
    EXPECT_THAT(text, HasSubstr(kept));
  }
  EXPECT_EQ(rewritten(text), text);
}

TEST(ViewLayout, CommentsStayBeforeWhatTheyStoodBefore) {
  const std::string text =
      rewritten(test::viewText("",
                               "<!-- 1 --><Camera kind=\"fly\"/><!-- 2 --><Later/><!-- 3 --><Layer id=\"/p\"><!-- 4 -->"
                               "<Setting key=\"k\" value=\"v\"/></Layer><!-- 5 --><Layer id=\"/q\"/><!-- 6 -->"));
  for (const char* kept : {"<!-- 1 -->\n  <Camera", "<!-- 2 -->\n  <Later/>", "<!-- 3 -->\n  <Layer id=\"/p\"",
                           "<!-- 4 -->\n    <Setting", "<!-- 5 -->\n  <Layer id=\"/q\"", "<!-- 6 -->\n</"}) {
    EXPECT_THAT(text, HasSubstr(kept));
  }
  EXPECT_EQ(rewritten(text), text);
}

TEST(ViewLayout, CommentOfWhatIsGoneStays) {
  auto root = parseXml(test::viewText("", "<!-- of p --><Layer id=\"/p\"/><!-- of q --><Layer id=\"/q\"/>"));
  ASSERT_TRUE(root);
  auto layout = viewLayoutOf(*root);
  ASSERT_TRUE(layout);
  layout->layers.layers.erase(layout->layers.layers.begin());
  EXPECT_THAT(writeXml(toXml(*layout)), HasSubstr("<!-- of p -->\n  <!-- of q -->\n  <Layer id=\"/q\""));
}

TEST(ViewLayout, KnownThingsThatAreGoneDoNotComeBackFromTheSource) {
  ViewLayout layout = reread(test::makeViewLayout());
  layout.fixed_frame.reset();
  layout.viewpoint.display_frame.reset();
  layout.layers.layers.pop_back();
  layout.saved_views.clear();
  layout.layers.layers.front().settings.clear();
  layout.picks = {};
  const std::string text = writeXml(toXml(layout));
  EXPECT_THAT(text, Not(HasSubstr("fixed_frame=")));
  EXPECT_THAT(text, Not(HasSubstr("display_frame=")));
  EXPECT_THAT(text, Not(HasSubstr("#2")));
  EXPECT_THAT(text, Not(HasSubstr("SavedView")));
  EXPECT_THAT(text, Not(HasSubstr("key=\"size\"")));
  EXPECT_THAT(text, Not(HasSubstr("Picked")));
  EXPECT_THAT(text, Not(HasSubstr("Measurement")));
}

}  // namespace
}  // namespace stillframe::scenegraph
