#include "tools/cli/effect_arguments.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace stillframe::cli {
namespace {

Result<scenegraph::ViewEffects> parse(const std::vector<std::string>& words) {
  CLI::App app;
  std::string file;
  app.add_option("FILE", file);
  const EffectArguments arguments(app);
  std::vector<std::string> reversed = EffectArguments::spelledOut(words);
  std::ranges::reverse(reversed);
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    return usageError(error.what());
  }
  return arguments.effects();
}

TEST(EffectArguments, NoneIsNone) {
  EXPECT_EQ(parse({}).value(), scenegraph::ViewEffects{});
  EXPECT_TRUE(parse({"--tonemap", "none", "--aa", "none"}).value().chain().passes.empty());
}

TEST(EffectArguments, FlagsTakeSettingsAndLeaveTheFileAlone) {
  const auto effects = parse({"--ssao", "file.mcap", "--edl:strength=2,neighbours=16"}).value();
  EXPECT_TRUE(effects.isOn("ssao") && effects.isOn("edl"));
  EXPECT_FALSE(effects.isOn("dither"));
  EXPECT_EQ(effects.settings("edl").at("strength"), "2");
  EXPECT_EQ(effects.settings("edl").at("neighbours"), "16");
  EXPECT_TRUE(parse({"--ssao:radius=0.25,half_resolution=true"}).value().isOn("ssao"));
}

TEST(EffectArguments, ToneMappingAndExposureAreOneEffect) {
  const auto both = parse({"--tonemap", "aces", "--exposure", "-1.5"}).value();
  EXPECT_EQ(both.settings("tonemap").at("curve"), "aces");
  EXPECT_EQ(both.settings("tonemap").at("exposure"), "-1.5");
  const auto exposure = parse({"--exposure", "2"}).value();
  EXPECT_TRUE(exposure.isOn("tonemap"));
  EXPECT_EQ(exposure.settings("tonemap").at("curve"), "none");
  EXPECT_EQ(parse({"--tonemap", "neutral:exposure=1"}).value().settings("tonemap").at("exposure"), "1");
}

TEST(EffectArguments, AntialiasingHasAMode) {
  const auto effects = parse({"--aa", "ssaa:samples=8"}).value();
  EXPECT_TRUE(effects.isOn("aa"));
  EXPECT_EQ(effects.settings("aa").at("mode"), "ssaa");
  EXPECT_EQ(effects.settings("aa").at("samples"), "8");
}

TEST(EffectArguments, MistakesAreNamed) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
      {{"--ssao:radius=-1"}, "radius"},
      {{"--ssao:radios=1"}, "radios"},
      {{"--ssao:radius"}, "key=value"},
      {{"--ssao=5"}, "--ssao"},
      {{"--dither:bits=4"}, "--dither has no settings"},
      {{"--tonemap", "filmic"}, "filmic"},
      {{"--tonemap", "aces:curve=none"}, "twice"},
      {{"--exposure", "bright"}, "bright"},
      {{"--exposure", "99"}, "exposure"},
      {{"--aa", "taa"}, "none, fxaa, msaa, ssaa"},
      {{"--aa", "none:samples=4"}, "--aa none has no settings"},
      {{"--aa", "msaa:samples=1"}, "samples"}};
  for (const auto& [words, named] : mistakes) {
    const auto refused = parse(words);
    ASSERT_FALSE(refused) << words.front();
    EXPECT_EQ(refused.error().code, ExitCode::Usage);
    EXPECT_NE(refused.error().message.find(named), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace stillframe::cli
