#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "program.h"
#include "scenegraph/export/picture_io.h"

namespace stillframe::cli {
namespace {

using testing::HasSubstr;
using Names = std::vector<std::string>;

class RenderEffects : public testing::Test {
 protected:
  Outcome render(const std::string& out, const Names& options) {
    Names words{"render", sample_, "--out", out, "--time", "+1", "--size", "160x120", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    Outcome outcome = run(folder_.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  scenegraph::BytePicture picture(const Names& options) {
    (void)render("a.png", options);
    return scenegraph::readPng(folder_ / "a.png").value();
  }
  std::vector<float> channel(const std::string& file, const char* name) {
    Imf::InputFile in((folder_ / file.c_str()).c_str());
    std::vector<float> values(160 * 120);
    Imf::FrameBuffer buffer;
    buffer.insert(name,
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), 160 * sizeof(float)));
    in.setFrameBuffer(buffer);
    in.readPixels(0, 119);
    return values;
  }

  TestFolder folder_;
  std::string sample_ = folder_.makeSample();
};

TEST_F(RenderEffects, RunThePassesThatAreAskedForAndNoOthers) {
  // The sample has texts, which are blended.
  EXPECT_EQ(render("a.png", {}).json()["passes"], (Names{"scene", "transparency"}));
  EXPECT_TRUE(render("a.png", {}).json()["effects"].empty());
  const auto said = render("a.png", {"--ssao:radius=1", "--edl", "--tonemap", "aces", "--exposure", "1", "--aa",
                                     "msaa:samples=4", "--dither"})
                        .json();
  EXPECT_EQ(said["passes"],
            (Names{"scene", "transparency", "resolve", "ssao", "ssao_apply", "edl", "tonemap", "dither"}));
  EXPECT_EQ(said["effects"]["ssao"]["radius"], "1");
  EXPECT_EQ(said["effects"]["tonemap"]["curve"], "aces");
  EXPECT_GT(said["samples"].get<int>(), 1);
  EXPECT_EQ(render("a.exr", {"--edl", "--tonemap", "aces", "--dither"}).json()["passes"],
            (Names{"scene", "transparency", "edl"}));
}

TEST_F(RenderEffects, ChangeThePicture) {
  const auto plain = picture({});
  for (const Names& options :
       {Names{"--ssao:radius=1"}, {"--edl"}, {"--aa", "fxaa"}, {"--aa", "msaa"}, {"--aa", "ssaa:samples=2"}}) {
    EXPECT_NE(picture(options), plain) << options.front();
  }
}

TEST_F(RenderEffects, AnExrIsSceneLinearWhateverTheToneCurve) {
  (void)render("plain.exr", {});
  (void)render("toned.exr", {"--tonemap", "aces", "--exposure", "3"});
  EXPECT_EQ(channel("plain.exr", "R"), channel("toned.exr", "R"));
  const Outcome said = run(folder_.path(), {"render", sample_, "--out", "b.exr", "--size", "9x9", "--exposure", "1"});
  EXPECT_THAT(said.out, HasSubstr("scene-linear: without tone mapping"));
}

TEST_F(RenderEffects, AnExrHasNormalsAndLayersOnRequest) {
  (void)render("plain.exr", {});
  EXPECT_EQ(Imf::InputFile((folder_ / "plain.exr").c_str()).header().channels().findChannel("id"), nullptr);
  (void)render("full.exr", {"--channels", "normals,id", "--eye", "0,0,30", "--look-at", "0,0,0"});
  Imf::InputFile in((folder_ / "full.exr").c_str());
  std::vector<std::uint32_t> ids(160 * 120);
  Imf::FrameBuffer buffer;
  buffer.insert("id", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(ids.data()), sizeof(std::uint32_t),
                                 160 * sizeof(std::uint32_t)));
  in.setFrameBuffer(buffer);
  in.readPixels(0, 119);
  const std::set<std::uint32_t> kinds(ids.begin(), ids.end());
  EXPECT_TRUE(kinds.contains(0));
  EXPECT_GE(kinds.size(), 4U);
  const auto* names = in.header().findTypedAttribute<Imf::StringAttribute>("layers");
  ASSERT_NE(names, nullptr);
  EXPECT_THAT(names->value(), HasSubstr("/lidar/points\n"));
  EXPECT_LE(*kinds.rbegin(), static_cast<std::uint32_t>(std::ranges::count(names->value(), '\n')));
  const auto depth = channel("full.exr", "Z");
  const auto x = channel("full.exr", "N.X");
  const auto y = channel("full.exr", "N.Y");
  const auto z = channel("full.exr", "N.Z");
  std::size_t upwards = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float length = std::hypot(x[i], y[i], z[i]);
    EXPECT_NEAR(length, std::isfinite(depth[i]) ? 1.0F : 0.0F, 1e-4F);
    EXPECT_EQ(ids[i] == 0, !std::isfinite(depth[i]));
    upwards += z[i] > 0.9F ? 1U : 0U;
  }
  EXPECT_GT(upwards, 100U) << "the ground is seen from above";
}

TEST_F(RenderEffects, MistakesAreNamed) {
  for (const auto& [words, named] : std::vector<std::pair<Names, std::string>>{
           {{"--channels", "id"}, ".exr"}, {{"--ssao:radius=no"}, "radius"}, {{"--tonemap", "x"}, "x"}}) {
    Names all{"render", sample_, "--out", "a.png"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome refused = run(folder_.path(), all);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr(named));
  }
}

TEST_F(RenderEffects, AnExportHoldsTheSceneAndNoPass) {
  EXPECT_EQ(run(folder_.path(), {"export", sample_, "--out", "a.osgt", "--ssao"}).code, 2);
}

}  // namespace
}  // namespace stillframe::cli
