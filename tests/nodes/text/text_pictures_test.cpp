#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <osgDB/Registry>

#include "nodes/text/find_font.h"
#include "nodes/text/text_maker.h"
#include "nodes/text/visual_order.h"
#include "tests/nodes/markers/marker_builder.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::BytePicture;
using scenegraph::ObjectType;
using scenegraph::SceneEntity;

/// Words that fill much of the picture, so that quads of glyphs lie beside and upon what is behind them.
SceneEntity words(const std::string& text, double z = 3.0) {
  SceneEntity entity = entityIn("map", "words", "words");
  entity.texts.push_back({.pose = at(0, 0, z), .is_billboard = true, .font_size = 5.0, .color = kWhite, .text = text});
  return entity;
}

SceneEntity pane(const std::string& id, double z, const scenegraph::EntityColor& color) {
  SceneEntity entity = cube(id, 0, 0, color, 14.0);
  entity.cubes[0].pose.translation.z = z;
  entity.cubes[0].size.z = 0.1;
  return entity;
}

class TextPicture : public ScenePictureTest {
 protected:
  /// Each entity in a topic of its own, its layer added in this order.
  BytePicture drawInOrder(const std::vector<SceneEntity>& entities) {
    DatasetBuilder builder;
    builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base");
    for (const SceneEntity& entity : entities) {
      builder.topic("/" + entity.id, ObjectType::SceneEntities).at(1_s, sceneOf({entity}));
    }
    open(builder.build(), "map");
    for (const SceneEntity& entity : entities) {
      add("/" + entity.id);
    }
    return draw(1_s, fromAbove());
  }
};

TEST_F(TextPicture, LeavesNoHolesInWhatIsBlendedBehindItWhateverTheOrder) {
  const SceneEntity text = words("wide\nWIDE");
  const SceneEntity red = pane("red", 0.0, {1, 0, 0, 0.5F});
  const SceneEntity blue = pane("blue", 1.0, {0, 0, 1, 0.5F});
  const BytePicture glyphs = drawInOrder({text});
  const BytePicture panes = drawInOrder({red, blue});
  const BytePicture text_first = drawInOrder({text, red, blue});
  EXPECT_GT(drawnPixels(glyphs), 2000);
  EXPECT_TRUE(drawInOrder({red, blue, text}).rgb == text_first.rgb);
  EXPECT_TRUE(drawInOrder({blue, text, red}).rgb == text_first.rgb);
  int holes = 0;
  for (std::size_t i = 0; i < glyphs.rgb.size(); ++i) {
    const bool is_beside_glyphs = glyphs.rgb[i] == 0;
    holes += is_beside_glyphs && text_first.rgb[i] != panes.rgb[i] ? 1 : 0;
    EXPECT_GE(text_first.rgb[i], std::min(glyphs.rgb[i], panes.rgb[i]));
  }
  EXPECT_EQ(holes, 0);
}

TEST_F(TextPicture, IsTheSameWhateverWasWrittenBefore) {
  // A font of its own for each picture: they are cached, and keep where its glyphs lie.
  const auto drawAfter = [this](const std::string& before) {
    osgDB::Registry::instance()->clearObjectCache();
    nodes::TextMaker maker;
    const auto texts =
        std::array{maker.make(before, {.is_in_pixels = true}), maker.make(before, {.is_in_pixels = false})};
    BytePicture all{};
    for (const double size : {0.7, 1.1, 1.9, 3.3}) {  // each minified otherwise
      SceneEntity text = words("marker 7\nWIDE, wide");
      text.texts[0].font_size = size;
      const BytePicture one = drawInOrder({text});
      all.rgb.insert(all.rgb.end(), one.rgb.begin(), one.rgb.end());
    }
    return all;
  };
  const BytePicture plain = drawAfter("a");
  EXPECT_TRUE(drawAfter("W@#%Qgy 0123 iIl").rgb == plain.rgb);
  EXPECT_TRUE(drawAfter("edkraw").rgb == plain.rgb);
}

TEST_F(TextPicture, HasCharactersOfTheFarEastBesideLatinOnes) {
  const auto drawn = [this](const std::string& text) { return drawInOrder({words(text)}).rgb; };
  for (const auto& [one, other] : {std::pair{"\u7bb1", "\u7bc6"}, {"\u306f", "\u3072"}, {"\uac00", "\ub098"}}) {
    EXPECT_FALSE(drawn(one) == drawn(other)) << one << " and " << other << " are no boxes";
  }
  EXPECT_FALSE(drawn("A\u7bb1") == drawn("B\u7bb1"));
}

osgText::String charactersOf(const char* utf8) { return {utf8, osgText::String::ENCODING_UTF8}; }

TEST(VisualOrder, TurnsRoundWhatIsWrittenFromRightToLeftLineByLine) {
  const auto expectOrder = [](const char* written, const char* drawn) {
    const osgText::String visual = nodes::visualOrder(written);
    EXPECT_TRUE(std::ranges::equal(visual, charactersOf(drawn))) << written << " is drawn as " << drawn;
  };
  expectOrder("", "");
  expectOrder("/camera/\u00e9tat \u041f", "/camera/\u00e9tat \u041f");
  expectOrder("a \u7bb1", "a \u7bb1");
  expectOrder("\u05e9\u05dc\u05d5\u05dd", "\u05dd\u05d5\u05dc\u05e9");
  expectOrder("\u05d0\u05d1 12", "12 \u05d1\u05d0");
  expectOrder("ab \u05d0\u05d1 c", "ab \u05d1\u05d0 c");
  expectOrder("\u05d0\u05d1\nab\n", "\u05d1\u05d0\nab\n");
}

TEST(VisualOrder, JoinsTheLettersOfArabic) {
  // Seen, lam, alef, meem: a first form, lam and alef as one, and a letter alone, as nothing joins to an alef.
  const osgText::String joined = nodes::visualOrder("\u0633\u0644\u0627\u0645");
  EXPECT_TRUE(std::ranges::equal(joined, std::array{0xFEE1U, 0xFEFCU, 0xFEB3U}));
}

TEST_F(TextPicture, ShowsHebrewAndArabicInTheirOrder) {
  const auto drawn = [this](const std::string& text) { return drawInOrder({words(text)}).rgb; };
  EXPECT_TRUE(drawn("\u05d0\u05d1") == drawn("\u202d\u05d1\u05d0")) << "as where the order is given";
  EXPECT_FALSE(drawn("\u05d0\u05d1") == drawn("\u05d1\u05d0"));
  EXPECT_TRUE(drawn("\u0628\u0628") == drawn("\ufe91\ufe90")) << "as with the forms themselves";
  EXPECT_FALSE(drawn("\u0628\u0628") == drawn("\u0628\u200c\u0628")) << "which are not those of letters alone";
}

TEST(Fonts, KnowTextsOfTheFarEast) {
  for (const char* text : {"", "obj 99", "\u00c4\u00f6\u20ac", "\u041f\u0440\u0438", "\u2192 \u2122", "\ufb01"}) {
    EXPECT_FALSE(nodes::isEastAsian(charactersOf(text))) << text;
  }
  for (const char* text :
       {"\u2e80", "\u3042", "a\u4e00b", "\u9fff", "\uac00", "\ud7a3", "\uf900", "\uff21", "\U00020000"}) {
    EXPECT_TRUE(nodes::isEastAsian(charactersOf(text))) << text;
  }
}

TEST_F(TextPicture, IsHiddenByWhatIsOpaqueBeforeItAndSeenThroughWhatIsNot) {
  const BytePicture alone = drawInOrder({words("wide\nWIDE", -1.0)});
  const BytePicture hidden = drawInOrder({words("wide\nWIDE", -1.0), pane("red", 0.0, {1, 0, 0, 1})});
  const BytePicture seen = drawInOrder({words("wide\nWIDE", -1.0), pane("red", 0.0, {1, 0, 0, 0.5F})});
  int green_alone = 0;
  int green_seen = 0;
  for (int y = 40; y < 160; ++y) {
    for (int x = 40; x < 160; ++x) {
      EXPECT_EQ(pixel(hidden, x, y), (Bytes3{255, 0, 0}));
      green_alone += pixel(alone, x, y)[1] > 200 ? 1 : 0;
      green_seen += pixel(seen, x, y)[1] > 150 ? 1 : 0;
    }
  }
  EXPECT_GT(green_alone, 500);
  EXPECT_NEAR(green_seen, green_alone, 0.1 * green_alone);
}

TEST_F(TextPicture, ThatChangesWithEachMessageIsWholeInEachPicture) {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base");
  builder.topic("/words", ObjectType::SceneEntities);
  constexpr int kMessages = 12;
  const auto wordsAt = [](int i) { return words(std::to_string(i * 7919) + "\n" + static_cast<char>('A' + 2 * i)); };
  for (int i = 0; i < kMessages; ++i) {
    builder.at(1_s + i, sceneOf({wordsAt(i), pane("red", 0.0, {1, 0, 0, 0.5F})}));
  }
  open(builder.build(), "map");
  add("/words");
  std::vector<BytePicture> played;
  for (int i = 0; i < kMessages; ++i) {
    played.push_back(draw(1_s + i, fromAbove()));
    EXPECT_TRUE(draw(1_s + i, fromAbove()).rgb == played.back().rgb) << "the second picture of message " << i;
  }
  for (int i = kMessages - 1; i >= 0; --i) {
    const std::string name = "message " + std::to_string(i);
    EXPECT_TRUE(draw(1_s + i, fromAbove()).rgb == played[static_cast<std::size_t>(i)].rgb) << name << " once more";
    EXPECT_TRUE(i == 0 || played[static_cast<std::size_t>(i)].rgb != played[static_cast<std::size_t>(i - 1)].rgb)
        << name;
  }
}

TEST_F(TextPicture, IsPickedBeforeWhatIsBehindIt) {
  drawInOrder({words("#", 3.0), pane("red", 0.0, {1, 0, 0, 1})});
  const BytePicture glyph = draw(1_s, fromAbove());
  int on_text = 0;
  int on_pane = 0;
  for (int y = 60; y < 140; y += 4) {
    for (int x = 60; x < 140; x += 4) {
      const auto hits = renderer_->pick(x, y, 0);
      ASSERT_FALSE(hits.empty());
      const bool is_text = pixel(glyph, x, y)[1] > 128;
      const bool is_near = hits.front().path.back()->className() == std::string("Text");
      on_text += is_text ? 1 : 0;
      on_pane += is_text ? 0 : 1;
      EXPECT_EQ(is_near, is_text || pixel(glyph, x, y)[1] > 0) << x << ", " << y;
    }
  }
  EXPECT_GT(on_text, 5);
  EXPECT_GT(on_pane, 50);
}

}  // namespace
}  // namespace stillframe::test
