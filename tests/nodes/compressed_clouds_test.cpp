// The layer of compressed clouds: decoded off the view, once, and drawn as any cloud is.
#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>

#include "nodes/coloring.h"
#include "nodes/points/colormap.h"
#include "scenegraph/objects/compressed_point_cloud.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"
#include "tools/bench/codec_workloads.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

using sample::toPayload;
using sample::writeCloudini;

using scenegraph::CompressedPointCloud;
using scenegraph::ObjectType;
using scenegraph::StatusLevel;
using testing::HasSubstr;

/// Points at x = -8, 0, 8 with intensities 10, 20, 30.
CompressedPointCloud threePoints() {
  nodes::cloudini::Header header;
  header.version = 5;
  header.width = 3;
  header.point_step = 16;
  header.fields = {{"x", 0, nodes::cloudini::ValueType::Float32, 0.001F},
                   {"y", 4, nodes::cloudini::ValueType::Float32, 0.001F},
                   {"z", 8, nodes::cloudini::ValueType::Float32, 0.001F},
                   {"intensity", 12, nodes::cloudini::ValueType::Float32, {}}};
  const float points[] = {-8, 0, 0, 10, 0, 0, 0, 20, 8, 0, 0, 30};
  CompressedPointCloud cloud;
  cloud.frame_id = "lidar";
  cloud.format = "cloudini";
  cloud.data = toPayload(writeCloudini(header, std::as_bytes(std::span(points))));
  return cloud;
}

CompressedPointCloud cutShort() {
  CompressedPointCloud cloud = threePoints();
  cloud.data.bytes = cloud.data.bytes.first(cloud.data.bytes.size() - 5);
  return cloud;
}

CompressedPointCloud ofFormat(const std::string& format) {
  CompressedPointCloud cloud = threePoints();
  cloud.format = format;
  return cloud;
}

DatasetBuilder withTransforms() {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "lidar");
  builder.topic("/points", ObjectType::CompressedPointCloud);
  return builder;
}

void expectColor(const Bytes3& pixel, double t) {
  const nodes::SrgbColor color = nodes::findColormap(nodes::kDefaultColormap)->at(t);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(pixel[i], color[i] * 255.0F, 3.0) << "at t = " << t;
  }
}

using CompressedCloudPicture = ScenePictureTest;

TEST_F(CompressedCloudPicture, IsThatOfTheDecodedCloud) {
  open(withTransforms().at(1_s, threePoints()).build(), "map");
  const auto& layer = add("/points", {{"point_size", "9"}});
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  expectColor(pixel(picture, 20, 100), 0.0);
  expectColor(pixel(picture, 100, 100), 0.5);
  expectColor(pixel(picture, 180, 100), 1.0);
  EXPECT_EQ(drawnPixels(picture), 3 * 81);
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"points", 3}, {"dropped", 0}, {"bytes", 48}}));
}

TEST_F(CompressedCloudPicture, IsPlacedByItsPose) {
  CompressedPointCloud cloud = threePoints();
  cloud.pose = turn(1.5707963267948966, 2.0, 0.0, 0.0);
  open(withTransforms().at(1_s, cloud).build(), "map");
  add("/points", {{"point_size", "9"}});
  const auto picture = draw(1_s, fromAbove());
  expectColor(pixel(picture, 120, 180), 0.0);
  expectColor(pixel(picture, 120, 100), 0.5);
  expectColor(pixel(picture, 120, 20), 1.0);
}

TEST_F(CompressedCloudPicture, IsEmptyForABlobThatCannotBeDecodedAndItIsTriedOnce) {
  auto builder = withTransforms();
  open(builder.at(1_s, threePoints()).at(2_s, cutShort()).at(3_s, threePoints()).build(), "map");
  const auto& layer = add("/points", {{"point_size", "9"}});
  EXPECT_GT(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(drawnPixels(draw(2_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "CorruptCloud");
  EXPECT_EQ(layer.status().level, StatusLevel::Error);
  EXPECT_THAT(layer.status().message, HasSubstr("'/points'"));
  EXPECT_GT(drawnPixels(draw(3_s, fromAbove())), 0);
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  const std::size_t decoded = builder.source().decodeCount();
  for (const std::int64_t time : {2_s, 3_s, 1_s, 2_s, 2_s}) {
    (void)draw(time, fromAbove());
  }
  EXPECT_EQ(builder.source().decodeCount(), decoded);
}

TEST_F(CompressedCloudPicture, SaysWhichFormatsItReads) {
  open(withTransforms().at(1_s, ofFormat("zstd")).at(2_s, ofFormat("laszip")).at(3_s, ofFormat("draco")).build(),
       "map");
  const auto& layer = add("/points");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "UnknownFormat");
  EXPECT_THAT(layer.status().message, HasSubstr("zstd clouds do not describe themselves"));
  EXPECT_EQ(drawnPixels(draw(2_s, fromAbove())), 0);
  EXPECT_THAT(layer.status().message, HasSubstr("'laszip' is not known"));
  EXPECT_EQ(drawnPixels(draw(3_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "MalformedHeader") << "what is within is not what the format says";
}

/// A scan of a spinning lidar in a room of three lobes.
class ScanPicture : public ScenePictureTest {
 protected:
  template <typename Cloud>
  scenegraph::BytePicture drawScan(Cloud cloud) {
    cloud.frame_id = "lidar";
    DatasetBuilder builder;
    builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "lidar");
    builder.topic("/points", Cloud::kType).at(1_s, std::move(cloud));
    open(builder.build(), "map");
    add("/points", {{"color_field", "z"}, {"colormap", "turbo"}, {"point_size", "2"}});
    return draw(1_s, {.eye_from_fixed = scenegraph::lookAt({4, -28, 22}, {0, 0, 0}, {0, 0, 1})}, 320, 240);
  }
  static int differingPixels(const scenegraph::BytePicture& a, const scenegraph::BytePicture& b) {
    int differing = 0;
    for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
      const auto apart = [&](std::size_t k) { return std::abs(a.rgb[i + k] - b.rgb[i + k]) > 8; };
      differing += apart(0) || apart(1) || apart(2) ? 1 : 0;
    }
    return differing;
  }
};

TEST_F(ScanPicture, IsTheSameFromEitherCodecAndUnpacked) {
  const bench::CodecWorkload workload = bench::makeCodecWorkload(6000);
  scenegraph::PointCloud raw;
  raw.width = 6000;
  raw.point_step = 18;
  raw.row_step = 6000 * 18;
  raw.fields = {{"x", 0, scenegraph::FieldType::Float32},
                {"y", 4, scenegraph::FieldType::Float32},
                {"z", 8, scenegraph::FieldType::Float32}};
  raw.data.bytes = workload.points;
  CompressedPointCloud cloudini;
  cloudini.format = "cloudini";
  cloudini.data = workload.cloudini;
  CompressedPointCloud draco;
  draco.format = "draco";
  draco.data = workload.draco;
  const auto expected = drawScan(raw);
  const int drawn = drawnPixels(expected);
  EXPECT_GT(drawn, 3000);
  EXPECT_LT(differingPixels(drawScan(draco), expected), drawn / 10);
  const auto picture = drawScan(cloudini);
  EXPECT_LT(differingPixels(picture, expected), drawn / 10);
  EXPECT_TRUE(matchesGolden(picture, "compressed_cloud"));
}

}  // namespace
}  // namespace stillframe::test
