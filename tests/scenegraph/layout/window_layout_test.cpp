#include "scenegraph/layout/window_layout.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/scenegraph/layout/layout_builders.h"

namespace stillframe::scenegraph {
namespace {

std::string layoutRewritten(const std::string& text) { return writeXml(toXml(parseLayout(text).value())); }

TEST(WindowLayout, ComesBackExactlyAndByteForByte) {
  const std::string text = writeXml(toXml(test::makeLayout()));
  EXPECT_EQ(layoutRewritten(text), text);
  const Layout back = parseLayout(text).value();
  ASSERT_EQ(back.windows.size(), 2U);
  EXPECT_EQ(back.windows[0].docks, "AAAA/w==");
  EXPECT_EQ(back.active_view, 3);
  EXPECT_EQ(back.windows[0].corner, std::pair(-1920, 27));
  EXPECT_FALSE(back.windows[0].is_maximized);
  EXPECT_EQ(back.windows[1].corner, std::nullopt);
  EXPECT_TRUE(back.windows[1].is_maximized);
  EXPECT_EQ(back.windows[1].width, 800);
  EXPECT_EQ(back.windows[1].height, 600);
  const Place& row = back.windows[0].place;
  EXPECT_FALSE(row.is_vertical);
  EXPECT_EQ(row.sizes, (std::vector{640, 641}));
  ASSERT_EQ(row.children.size(), 2U);
  EXPECT_TRUE(row.children[0].view && row.children[1].is_vertical);
  EXPECT_EQ(row.children[1].sizes, (std::vector{300, 500}));
  EXPECT_EQ(viewsOf(back).size(), 4U);
  EXPECT_EQ(viewsOf(back)[2]->viewpoint, test::makeViewLayout().viewpoint);
}

TEST(WindowLayout, UnknownThingsOfWindowsAndSplittersSurvive) {
  const std::string view = test::viewText("");
  const std::string text = layoutRewritten(
      "<StillframeLayout version=\"1\" theme=\"dark\"><Window screen=\"2\">"
      "<Splitter orientation=\"vertical\" sizes=\"1,2\" handle=\"thin\">" +
      view + view + "<Title/></Splitter><Bars/></Window><Plots n=\"3\"/></StillframeLayout>");
  for (const char* kept :
       {"theme=\"dark\"", "screen=\"2\"", "handle=\"thin\"", "<Title/>", "<Bars/>", "<Plots n=\"3\"/>"}) {
    EXPECT_NE(text.find(kept), std::string::npos) << kept << " in " << text;
  }
  EXPECT_EQ(layoutRewritten(text), text);
}

TEST(WindowLayout, CommentsOfWindowsSplittersAndTheWholeFileSurvive) {
  const std::string view = test::viewText("");
  const std::string text = layoutRewritten(
      "<!-- whose --><StillframeLayout version=\"1\"><!-- first --><Window><!-- row -->"
      "<Splitter orientation=\"vertical\" sizes=\"1,2\">" +
      view + "<!-- below -->" + view + "</Splitter></Window><!-- second --><Window>" + view +
      "</Window></StillframeLayout><!-- end -->");
  for (const char* kept :
       {"<!-- whose -->\n<StillframeLayout", "<!-- first -->\n  <Window", "<!-- row -->\n    <Splitter",
        "<!-- below -->\n      <Scene3DDock", "<!-- second -->\n  <Window", "</StillframeLayout>\n<!-- end -->\n"}) {
    EXPECT_NE(text.find(kept), std::string::npos) << kept << " in " << text;
  }
  EXPECT_EQ(layoutRewritten(text), text);
}

TEST(WindowLayout, CommentBeforeOneViewAloneSurvives) {
  const std::string text = layoutRewritten("<!-- my view -->" + test::viewText("fixed_frame=\"map\""));
  EXPECT_NE(text.find("<!-- my view -->"), std::string::npos) << text;
  EXPECT_EQ(layoutRewritten(text), text);
}

TEST(WindowLayout, OneViewAloneIsALayout) {
  const auto layout = parseLayout(test::viewText("fixed_frame=\"map\""));
  ASSERT_TRUE(layout);
  ASSERT_EQ(viewsOf(*layout).size(), 1U);
  EXPECT_EQ(viewsOf(*layout)[0]->fixed_frame, "map");
}

TEST(WindowLayout, ViewsAreFoundInALayoutOfAHost) {
  const std::string view = test::viewText("");
  const auto layout =
      parseLayout("<!DOCTYPE Host><root><tabs><tab><plot/>" + view + "</tab>" + view + "</tabs></root>");
  ASSERT_TRUE(layout);
  EXPECT_EQ(viewsOf(*layout).size(), 2U);
  EXPECT_EQ(parseLayout("<root><plot/></root>").error().code, "NoView");
}

TEST(WindowLayout, ErrorsOfAFileNameIt) {
  const auto folder = std::filesystem::path(testing::TempDir());
  EXPECT_EQ(readLayout(folder / "none.xml").error().code, "CannotRead");
  EXPECT_EQ(readLayout(folder).error().code, "CannotRead") << "a folder is no layout";
  const auto file = folder / "stillframe_broken_layout.xml";
  std::ofstream(file) << "<a>";
  EXPECT_TRUE(readLayout(file).error().message.starts_with(file.string() + ": line 1: "));
  std::ofstream(file) << test::viewText("");
  EXPECT_TRUE(readLayout(file));
  std::filesystem::resize_file(file, 100'000'000);  // as a rule without blocks behind it
  EXPECT_EQ(readLayout(file).error().code, "LayoutTooLarge");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace stillframe::scenegraph
