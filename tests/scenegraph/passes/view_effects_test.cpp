#include "scenegraph/passes/view_effects.h"

#include <gtest/gtest.h>

#include <set>

namespace stillframe::scenegraph {
namespace {

std::vector<std::string> names(const PostChain& chain) {
  std::vector<std::string> names;
  for (const PostPass& pass : chain.passes) {
    names.push_back(pass.name);
  }
  return names;
}

TEST(ViewEffects, AreAllOffAtFirstAndAddNothing) {
  const ViewEffects effects;
  EXPECT_TRUE(effects.chain().passes.empty());
  EXPECT_EQ(effects.chain().msaa_samples, 0);
  EXPECT_EQ(effects, ViewEffects{});
}

TEST(ViewEffects, RunInTheOrderOfTheList) {
  ViewEffects effects;
  for (const EffectType& type : effectTypes()) {
    effects.setOn(type.name, true);
  }
  ASSERT_TRUE(effects.apply("aa", {{"mode", "ssaa"}}));
  EXPECT_EQ(names(effects.chain()),
            (std::vector<std::string>{"ssao", "ssao_apply", "edl", "tonemap", "average", "dither"}));
  EXPECT_EQ(names(effects.linearChain()), (std::vector<std::string>{"ssao", "ssao_apply", "edl", "average"}));
}

TEST(ViewEffects, EachPassReadsWhatIsThere) {
  ViewEffects effects;
  for (const EffectType& type : effectTypes()) {
    effects.setOn(type.name, true);
  }
  std::set<std::string> there{"scene", "depth"};
  for (const PostPass& pass : effects.chain().passes) {
    for (const auto& [uniform, input] : pass.inputs) {
      EXPECT_TRUE(there.contains(input)) << pass.name << " reads " << input;
    }
    EXPECT_TRUE(there.insert(pass.name).second) << pass.name << " is there twice";
  }
}

TEST(ViewEffects, SettingsAreCheckedAndKeptWhileOff) {
  ViewEffects effects;
  ASSERT_TRUE(effects.apply("ssao", {{"radius", "2.5"}, {"samples", "32"}}));
  EXPECT_FALSE(effects.isOn("ssao"));
  EXPECT_EQ(effects.settings("ssao").at("radius"), "2.5");
  EXPECT_EQ(effects.apply("ssao", {{"radius", "-1"}}).error().code, "OutOfRange");
  EXPECT_EQ(effects.apply("ssao", {{"radius", "3"}, {"samples", "none"}}).error().code, "BadValue");
  EXPECT_EQ(effects.apply("ssao", {{"colour", "3"}}).error().code, "UnknownSetting");
  EXPECT_EQ(effects.apply("bloom", {}).error().code, "UnknownEffect");
  EXPECT_EQ(effects.apply("tonemap", {{"curve", "filmic"}}).error().code, "BadValue");
  EXPECT_EQ(effects.settings("ssao").at("radius"), "2.5");
}

TEST(ViewEffects, TextsReadBackExactly) {
  ViewEffects effects;
  effects.setOn("edl", true);
  effects.setOn("aa", true);
  ASSERT_TRUE(effects.apply("edl", {{"strength", "0.30000000000000004"}}));
  ASSERT_TRUE(effects.apply("aa", {{"mode", "fxaa"}}));
  ViewEffects read;
  EXPECT_TRUE(read.fromTexts(effects.toTexts()).empty());
  EXPECT_EQ(read, effects);
}

TEST(ViewEffects, TextsOfAnotherVersionCountAsFarAsTheyAreUnderstood) {
  ViewEffects effects;
  const auto refused = effects.fromTexts({{"bloom", "true"},
                                          {"bloom.size", "3"},
                                          {"edl", "perhaps"},
                                          {"ssao", "true"},
                                          {"ssao.colour", "#ffffff"},
                                          {"ssao.radius", "0.25"},
                                          {"ssao.samples", "1e9"}});
  EXPECT_EQ(refused.size(), 5U);
  EXPECT_TRUE(effects.isOn("ssao"));
  EXPECT_FALSE(effects.isOn("edl"));
  EXPECT_EQ(effects.settings("ssao").at("radius"), "0.25");
}

TEST(ViewEffects, AChangeOfAValueIsNoChangeOfStructure) {
  ViewEffects a;
  a.setOn("ssao", true);
  ViewEffects b = a;
  ASSERT_TRUE(b.apply("ssao", {{"radius", "3"}, {"intensity", "2"}}));
  EXPECT_TRUE(isSameStructure(a.chain(), b.chain()));
  ASSERT_TRUE(b.apply("ssao", {{"half_resolution", "true"}}));
  EXPECT_FALSE(isSameStructure(a.chain(), b.chain()));
  b.setOn("dither", true);
  EXPECT_FALSE(isSameStructure(a.chain(), b.chain()));
}

TEST(ViewEffects, EverySettingHasALabelAndAHelp) {
  for (const EffectType& type : effectTypes()) {
    EXPECT_FALSE(type.label.empty() || type.help.empty()) << type.name;
    for (const SettingSpec& spec : type.specs) {
      EXPECT_FALSE(spec.label.empty() || spec.help.empty()) << type.name << '.' << spec.key;
      EXPECT_TRUE(type.defaults.contains(spec.key));
    }
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
