// Layouts that mean harm, or were cut off: refused with one line each.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "scenegraph/layout/window_layout.h"
#include "tests/scenegraph/layout/layout_builders.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

struct HostileCase {
  const char* name;
  std::string text;
  const char* code;
};

void PrintTo(const HostileCase& hostile, std::ostream* stream) { *stream << hostile.name; }

class HostileLayout : public testing::TestWithParam<HostileCase> {};

TEST_P(HostileLayout, IsRefusedWithOneLine) {
  const auto layout = parseLayout(GetParam().text);
  ASSERT_FALSE(layout);
  EXPECT_EQ(layout.error().code, GetParam().code) << layout.error().message;
  EXPECT_EQ(std::ranges::count(layout.error().message, '\n'), 0) << layout.error().message;
  EXPECT_LT(layout.error().message.size(), 400U);
}

std::string splitter(const std::string& attributes, const std::string& children) {
  return "<StillframeLayout version=\"1\"><Window><Splitter " + attributes + ">" + children +
         "</Splitter></Window></StillframeLayout>";
}

std::string nested(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) {
    text += "<a>";
  }
  for (int i = 0; i < depth; ++i) {
    text += "</a>";
  }
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Values, HostileLayout,
    testing::Values(
        HostileCase{"NoVersion", "<Scene3DDock/>", "WrongVersion"},
        HostileCase{"LaterVersion", "<Scene3DDock version=\"2\"/>", "WrongVersion"},
        HostileCase{"WordAsVersion", "<Scene3DDock version=\"one\"/>", "WrongVersion"},
        HostileCase{"LaterLayout", "<StillframeLayout version=\"9\"/>", "WrongVersion"},
        HostileCase{"NanInCamera", test::viewText("", "<Camera orbit.radius_m=\"nan\"/>"), "BadLayout"},
        HostileCase{"InfinityInCamera", test::viewText("", "<Camera fly.eye_x=\"-inf\"/>"), "BadLayout"},
        HostileCase{"TooLargeForDouble", test::viewText("", "<Camera orbit.radius_m=\"1e400\"/>"), "BadLayout"},
        HostileCase{"NanInFollow", test::viewText("", "<Follow base_from_camera.x=\"NaN\"/>"), "BadLayout"},
        HostileCase{"UnknownCamera", test::viewText("", "<Camera kind=\"drone\"/>"), "BadLayout"},
        HostileCase{"NanInSavedView",
                    test::viewText("", "<SavedView name=\"a\"><Camera fly.reach_m=\"nan\"/></SavedView>"), "BadLayout"},
        HostileCase{"MaybeVisible", test::viewText("", "<Layer id=\"/p\" visible=\"maybe\"/>"), "BadLayout"},
        HostileCase{"LayerWithoutId", test::viewText("", "<Layer/>"), "BadLayout"},
        HostileCase{"LayerTwice", test::viewText("", "<Layer id=\"/p\"/><Layer id=\"/p\"/>"), "BadLayout"},
        HostileCase{"PickWithoutFrame", test::viewText("", "<Picked x=\"1\"/>"), "BadLayout"},
        HostileCase{"NanInPick", test::viewText("", "<Picked frame=\"a\" x=\"nan\"/>"), "BadLayout"},
        HostileCase{"EndlessStamp", test::viewText("", "<Picked frame=\"a\" stamp_ns=\"9223372036854775808\"/>"),
                    "BadLayout"},
        HostileCase{"NegativeRadius", test::viewText("", "<Picked frame=\"a\" radius_m=\"-1\"/>"), "BadLayout"},
        HostileCase{"PickedTwice", test::viewText("", "<Picked frame=\"a\"/><Picked frame=\"b\"/>"), "BadLayout"},
        HostileCase{"MeasuredFromNowhere", test::viewText("", "<Measurement><To frame=\"a\"/></Measurement>"),
                    "BadLayout"},
        HostileCase{"MeasuredToNoFrame", test::viewText("", "<Measurement><From frame=\"a\"/><To/></Measurement>"),
                    "BadLayout"},
        HostileCase{"MaybeLegend", test::viewText("legend=\"maybe\""), "BadLayout"},
        HostileCase{"TooDeepToBeSavedAgain", test::viewText("", nested(62)), "BadLayout"},
        HostileCase{"WindowOnTheMoon",
                    "<StillframeLayout version=\"1\"><Window x=\"384400000\" y=\"0\"/></StillframeLayout>",
                    "BadLayout"},
        HostileCase{"NoSuchViewActive", "<StillframeLayout version=\"1\" active_view=\"0\"/>", "BadLayout"},
        HostileCase{"QuotedEndOfLine", test::viewText("camera_touched=\"a&#10;b\""), "BadLayout"},
        HostileCase{"LongQuote", test::viewText("camera_touched=\"" + std::string(100'000, 'x') + "\""), "BadLayout"},
        HostileCase{"NoViews", "<StillframeLayout version=\"1\"/>", "BadLayout"},
        HostileCase{"EmptyWindow", "<StillframeLayout version=\"1\"><Window/></StillframeLayout>", "BadLayout"},
        HostileCase{"HugeWindow", "<StillframeLayout version=\"1\"><Window width=\"2000000000\"/></StillframeLayout>",
                    "BadLayout"},
        HostileCase{"NegativeWindow", "<StillframeLayout version=\"1\"><Window width=\"-1\"/></StillframeLayout>",
                    "BadLayout"},
        HostileCase{"NanAsSize", splitter("orientation=\"vertical\" sizes=\"nan\"", test::viewText("")), "BadLayout"},
        HostileCase{"SizesThatDoNotFit", splitter("orientation=\"vertical\" sizes=\"1,2\"", test::viewText("")),
                    "BadLayout"},
        HostileCase{"ManySizes", splitter("orientation=\"vertical\" sizes=\"" + std::string(1'000'000, ',') + "\"", ""),
                    "BadLayout"},
        HostileCase{"Slanted", splitter("orientation=\"slanted\" sizes=\"1\"", test::viewText("")), "BadLayout"},
        HostileCase{"EmptySplitter", splitter("orientation=\"vertical\" sizes=\"\"", ""), "BadLayout"},
        HostileCase{"Empty", "", "MalformedLayout"}, HostileCase{"Nul", std::string(100, '\0'), "MalformedLayout"},
        HostileCase{"NoXml", "{\"layout\": 1}", "MalformedLayout"}, HostileCase{"AnotherProgram", "<rviz/>", "NoView"}),
    [](const auto& hostile) { return std::string(hostile.param.name); });

TEST(LayoutTruncatedAnywhere, IsRefusedAndNeverCrashes) {
  const std::string text = writeXml(toXml(test::makeLayout()));
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    EXPECT_FALSE(parseLayout(std::string_view(text).substr(0, length))) << length;
  }
}

TEST(LayoutWithFlippedBytes, IsReadOrRefusedAndNeverCrashes) {
  const std::string text = writeXml(toXml(test::makeLayout()));
  test::Random random(1);
  for (int round = 0; round < 500; ++round) {
    std::string damaged = text;
    for (int i = 0; i < 3; ++i) {
      damaged[random.index(damaged.size())] = static_cast<char>(random.index(256));
    }
    if (const auto layout = parseLayout(damaged)) {
      const std::string once = writeXml(toXml(*layout));
      EXPECT_EQ(writeXml(toXml(parseLayout(once).value())), once);
    }
  }
}

TEST(LayoutOfManyThings, CostsNoMoreThanItsSize) {
  std::string attributes;
  std::string layers;
  for (int i = 0; i < 50'000; ++i) {
    attributes += " a" + std::to_string(i) + "=\"\"";
    layers += "<Layer id=\"" + std::to_string(i) + "\"><Setting key=\"k\" value=\"\"/></Layer>";
  }
  const auto layout = parseLayout(test::viewText("", "<Effects" + attributes + "/>" + layers));
  ASSERT_TRUE(layout);
  EXPECT_EQ(viewsOf(*layout)[0]->layers.layers.size(), 50'000U);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(writeXml(toXml(*layout)).empty());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << "quadratic would take minutes";
}

}  // namespace
}  // namespace stillframe::scenegraph
