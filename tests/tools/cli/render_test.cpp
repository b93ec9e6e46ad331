#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "program.h"
#include "scenegraph/export/picture_io.h"

namespace stillframe::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

void expectOneLine(const Outcome& run) {
  EXPECT_THAT(run.err, StartsWith("stillframe: "));
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
}

std::map<std::string, nlohmann::json> byTopic(const nlohmann::json& picture) {
  std::map<std::string, nlohmann::json> layers;
  for (const auto& layer : picture["layers"]) {
    layers[layer["topic"]] = layer;
  }
  return layers;
}

TEST(RenderCommand, DrawsTheSampleAndSaysWhat) {
  const TestFolder folder;
  const Outcome drawn = run(folder.path(), {"render", folder.makeSample(), "--out", "a.png", "--time", "+1", "--size",
                                            "320x200", "--fixed-frame", "odom", "--json"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto said = drawn.json();
  EXPECT_EQ(said["size"], (std::vector<int>{320, 200}));
  EXPECT_EQ(said["time_ns"], kSampleStart_ns + 1'000'000'000);
  EXPECT_EQ(said["fixed_frame"], "odom");
  EXPECT_GT(said["frame_ms"].get<double>(), 0.0);
  EXPECT_EQ(said["passes"][0], "scene");
  const auto layers = byTopic(said);
  ASSERT_GE(layers.size(), 10U) << said;
  for (const auto& [topic, layer] : layers) {  // the sample is without a fault: nothing worse than a note
    EXPECT_TRUE(layer["status"]["level"] == "ok" || layer["status"]["level"] == "info") << layer;
  }
  const auto& lidar = layers.at("/lidar/points");
  EXPECT_EQ(lidar["frame"], "lidar_link");
  EXPECT_EQ(lidar["visible"], true);
  EXPECT_EQ(lidar["status"]["level"], "ok") << lidar;
  EXPECT_EQ(lidar["counts"]["points"], kSamplePoints);
  EXPECT_GT(layers.at("/camera/points")["counts"]["points"], 1000);
  EXPECT_EQ(layers.at("tf")["status"]["level"], "ok");

  const auto picture = scenegraph::readPng(folder / "a.png");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 320);
  EXPECT_EQ(picture->height, 200);
  std::size_t drawn_pixels = 0;
  for (std::size_t i = 3; i < picture->rgb.size(); i += 3) {
    drawn_pixels += std::equal(picture->rgb.begin(), picture->rgb.begin() + 3,
                               picture->rgb.begin() + static_cast<std::ptrdiff_t>(i))
                        ? 0
                        : 1;
  }
  EXPECT_GT(drawn_pixels, 1000U);
}

TEST(RenderCommand, DrawsJustTheNamedLayers) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const Outcome drawn = run(folder.path(), {"render", sample, "--out", "a.exr", "--only", "--layer", "/lidar/points",
                                            "--layer", "grid", "--size", "64x64", "--json"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto layers = byTopic(drawn.json());
  EXPECT_EQ(layers.size(), 2U);
  EXPECT_TRUE(layers.contains("grid") && layers.contains("/lidar/points"));
  EXPECT_EQ(run(folder.path(), {"render", sample, "--out", "a.png", "--only"}).code, 2);
}

TEST(RenderCommand, DrawsASecondLayerOfATopicByItsNumber) {
  const TestFolder folder;
  const Outcome drawn =
      run(folder.path(), {"render", folder.makeSample(), "--out", "a.png", "--only", "--layer", "/lidar/points",
                          "--layer", "/lidar/points#2:title=By height,color_field=z", "--size", "64x64", "--json"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto layers = drawn.json()["layers"];
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0]["id"], "/lidar/points");
  EXPECT_EQ(layers[1]["id"], "/lidar/points#2");
  EXPECT_EQ(layers[1]["title"], "By height");
  EXPECT_EQ(layers[1]["topic"], "/lidar/points");
  EXPECT_EQ(layers[1]["counts"], layers[0]["counts"]);
}

TEST(RenderCommand, DrawsALegendWhereValuesHaveColours) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const auto corner = [&](const std::string& layer, bool has_legend) {
    std::vector<std::string> arguments{"render",  sample, "--out",  "a.png",  "--only",
                                       "--layer", layer,  "--size", "640x400"};
    if (has_legend) {
      arguments.emplace_back("--legend");
    }
    const Outcome drawn = run(folder.path(), arguments);
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    const auto picture = scenegraph::readPng(folder / "a.png");
    EXPECT_TRUE(picture);
    // The last card of 216 x 62 and its margin lie within this.
    std::vector<std::uint8_t> pixels;
    for (int y = 320; picture && y < 400; ++y) {
      const auto row = picture->rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * 640 + 440);
      pixels.insert(pixels.end(), row, row + 3 * 200);
    }
    return pixels;
  };
  const auto with = corner("/lidar/points:color_field=z", true);
  EXPECT_NE(with, corner("/lidar/points:color_field=z", false));
  EXPECT_EQ(corner("/lidar/points:color_field=flat", true), corner("/lidar/points:color_field=flat", false));
  EXPECT_EQ(run(folder.path(), {"render", sample, "--out", "a.exr", "--legend"}).code, 2);
}

TEST(RenderCommand, SaysWhatColoursMeanAndWhatLayersCost) {
  const TestFolder folder;
  const Outcome drawn =
      run(folder.path(), {"render", folder.makeSample(), "--out", "a.png", "--size", "64x64", "--layer",
                          "/lidar/points:color_field=z,range_mode=manual,range_min=-1,range_max=2", "--json"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto layers = byTopic(drawn.json());
  const auto& legend = layers.at("/lidar/points")["legend"];
  EXPECT_EQ(legend["title"], "z in map");
  EXPECT_EQ(legend["unit"], "m");
  EXPECT_EQ(legend["low"], -1.0);
  EXPECT_EQ(legend["high"], 2.0);
  EXPECT_TRUE(layers.at("grid")["legend"].is_null());
  EXPECT_EQ(layers.at("/lidar/points")["cost"]["vertices"], kSamplePoints);
  EXPECT_EQ(layers.at("/lidar/points")["cost"]["draw_calls"], 1);
  EXPECT_GT(layers.at("/lidar/points")["cost"]["decode_ms"].get<double>(), 0.0);
}

TEST(RenderCommand, HidesALayerThatIsToBeHidden) {
  const TestFolder folder;
  const Outcome drawn = run(folder.path(), {"render", folder.makeSample(), "--out", "a.png", "--layer",
                                            "grid:visible=false", "--size", "64x64", "--json"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_EQ(byTopic(drawn.json()).at("grid")["visible"], false);
}

TEST(RenderCommand, LooksFromWhereItIsTold) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const auto picture = [&](const std::string& eye, const std::string& target) {
    const Outcome drawn = run(folder.path(), {"render", sample, "--out", "a.png", "--eye", eye, "--look-at", target,
                                              "--size", "64x64", "--background", "#ffffff"});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    return scenegraph::readPng(folder / "a.png").value();
  };
  const auto above = picture("0,0,40", "0,0,0");
  EXPECT_EQ(above, picture("0,0,40", "0,0,0"));
  EXPECT_NE(above, picture("30,5,10", "0,0,0"));
  const auto away = picture("0,0,40", "0,0,80");
  EXPECT_EQ(std::ranges::count(away.rgb, 255), std::ptrdiff_t(away.rgb.size()));
}

TEST(RenderCommand, LooksStraightDownAtTheScaleItIsTold) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  // The reference grid is 10 m wide: of 20 m from bottom to top it takes half the height of the picture.
  const Outcome drawn =
      run(folder.path(), {"render", sample, "--out", "a.png", "--only", "--layer", "grid", "--camera", "topdown",
                          "--look-at", "0,0,0", "--ortho-height", "20", "--size", "80x80", "--background", "#000000"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto picture = scenegraph::readPng(folder / "a.png").value();
  int first_row = 80;
  int last_row = -1;
  for (int i = 0; i < 80 * 80; ++i) {
    if (picture.rgb[static_cast<std::size_t>(3 * i)] > 20) {
      first_row = std::min(first_row, i / 80);
      last_row = std::max(last_row, i / 80);
    }
  }
  EXPECT_NEAR(first_row, 20, 1);
  EXPECT_NEAR(last_row, 60, 1);
}

TEST(RenderCommand, GoesAlongWithTheFollowedFrame) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const auto picture = [&](const std::string& time, const std::string& follow) {
    std::vector<std::string> arguments{
        "render", sample, "--out", "a.png",  "--only",    "--layer", "tf:frame_filter=^base_link$,parent_lines=false",
        "--time", time,   "--eye", "-3,1,2", "--look-at", "0,0,0",   "--size",
        "64x64"};
    if (!follow.empty()) {
      arguments.insert(arguments.end(), {"--follow", follow});
    }
    const Outcome drawn = run(folder.path(), arguments);
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    return scenegraph::readPng(folder / "a.png").value();
  };
  EXPECT_EQ(picture("+0.5", "base_link"), picture("+1.9", "base_link")) << "pose: the frame stands still";
  EXPECT_NE(picture("+0.5", ""), picture("+1.9", "")) << "and it does move";
}

TEST(RenderCommand, RefusesWhatIsNotThere) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
      {{"--fixed-frame", "mop"}, "'map'"},
      {{"--fixed-frame", "nothing_like_it"}, "base_link"},
      {{"--layer", "/lidar/point"}, "/lidar/points"},
      {{"--layer", "/tf"}, "/tf"},
      {{"--layer", "/lidar/points:sise=3"}, "sise"},
      {{"--layer", "/lidar/points:sise"}, "layer '/lidar/points': 'sise' is no list of settings"},
      {{"--layer", "/lidar/points:link.a-b"}, "key=value"},
      {{"--time", std::to_string(kSampleStart_ns - 1)}, std::to_string(kSampleStart_ns)},
      {{"--time", std::to_string(kSampleEnd_ns + 1)}, std::to_string(kSampleEnd_ns)},
      {{"--time", "+2.000000001"}, "+2.000000001 is outside the recording, which spans +0 to +2"},
      {{"--layer", "/lidar/points:percentile_low=99.5"}, "percentile_high=99 is below percentile_low=99.5"},
      {{"--time", "0"}, "outside"},
      {{"--size", "0x0"}, "0x0"},
      {{"--size", "100000x100000"}, "100000x100000"},
      {{"--eye", "1,2"}, "--eye"},
      {{"--look-at", "nan,0,0"}, "--look-at"},
      {{"--fov", "180"}, "--fov"},
      {{"--eye", "1,2,3", "--look-at", "1,2,3.0"}, "the same point"},
      {{"--camera", "spherical"}, "topdown"},
      {{"--camera", "topdown", "--ortho-height", "0"}, "--ortho-height"},
      {{"--ortho-height", "5"}, "--camera topdown"},
      {{"--follow", "no_such_frame"}, "base_link"},
      {{"--follow", ":pose"}, "position, heading or pose"},
      {{"--background", "red"}, "red"},
  };
  for (const auto& [options, named] : mistakes) {
    for (const char* command : {"render", "export"}) {
      std::vector<std::string> arguments{command, sample, "--out",
                                         std::string(command) == "render" ? "a.png" : "a.osgt"};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const Outcome refused = run(folder.path(), arguments);
      EXPECT_EQ(refused.code, 2) << testing::PrintToString(arguments);
      expectOneLine(refused);
      EXPECT_THAT(refused.err, HasSubstr(named));
    }
  }
}

TEST(RenderCommand, SaysWhyAPictureCannotBeWritten) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  for (const char* out : {"no/such/folder/a.png", "no/such/folder/a.exr"}) {
    const Outcome failed = run(folder.path(), {"render", sample, "--out", out, "--size", "16x16"});
    EXPECT_EQ(failed.code, 1) << out;
    expectOneLine(failed);
    EXPECT_THAT(failed.err, HasSubstr(out));
  }
  EXPECT_EQ(run(folder.path(), {"render", sample, "--out", "a.jpg"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"export", sample, "--out", "a.obj"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"export", sample, "--out", "no/such/a.osgt"}).code, 1);
}

TEST(RenderCommand, ExportsTheSample) {
  const TestFolder folder;
  const std::string sample = folder.makeSample();
  for (const char* out : {"a.osgt", "a.osgb"}) {
    const Outcome written = run(folder.path(), {"export", sample, "--out", out, "--time", "+0.5"});
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_GT(std::filesystem::file_size(folder / out), 10'000U);
  }
}

}  // namespace
}  // namespace stillframe::cli
