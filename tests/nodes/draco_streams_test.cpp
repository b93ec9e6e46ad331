// Draco streams that libdraco's encoder does not make: of earlier bitstreams, and meshes whose predictions lie.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "nodes/points/codecs/draco.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

using nodes::CodecErrorCode;
using nodes::decodeDraco;
using sample::toPayload;

/// A mesh of squares with texture coordinates, by the encoder that predicts those from the positions.
std::vector<std::byte> texturedMesh() {
  constexpr int kSide = 6;
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * kSide * kSide);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int texture = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  const auto corner = [](int x, int y) {
    return std::array{static_cast<float>(x), static_cast<float>(y), std::sin(static_cast<float>(3 * x + 2 * y))};
  };
  const auto uv = [](int x, int y) {
    return std::array{static_cast<float>(x) / kSide, static_cast<float>(y * y) / (kSide * kSide)};
  };
  unsigned face = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (const int other : {0, 1}) {
        const std::array<std::array<int, 2>, 3> at = {{{x, y}, {x + 1, y + other}, {x + 1 - other, y + 1}}};
        std::array<std::array<float, 3>, 3> points;
        std::array<std::array<float, 2>, 3> uvs;
        for (std::size_t i = 0; i < 3; ++i) {
          points[i] = corner(at[i][0], at[i][1]);
          uvs[i] = uv(at[i][0], at[i][1]);
        }
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(face), points[0].data(), points[1].data(),
                                          points[2].data());
        builder.SetAttributeValuesForFace(texture, draco::FaceIndex(face), uvs[0].data(), uvs[1].data(), uvs[2].data());
        ++face;
      }
    }
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(0, 0);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 10);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 10);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  std::vector<std::byte> bytes(buffer.size());
  std::memcpy(bytes.data(), buffer.data(), buffer.size());
  return bytes;
}

// Where the number of orientations stands, a claim of 2^31 - 1 made libdraco read as many bits: 5 s.
TEST(DracoStreams, RefusesMoreTextureOrientationsThanAMeshHasCorners) {
  const auto blob = texturedMesh();
  const auto whole = decodeDraco(toPayload(blob));
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->width, 49U);
  int refused = 0;
  for (std::size_t at = 40; at + 4 <= blob.size(); ++at) {
    auto wrong = blob;
    wrong[at] = wrong[at + 1] = wrong[at + 2] = std::byte{0xff};
    wrong[at + 3] = std::byte{0x7f};
    const auto cloud = decodeDraco(toPayload(std::move(wrong)));
    if (!cloud && cloud.error().message.find("2147483647 texture orientations of 72 faces") != std::string::npos) {
      EXPECT_EQ(cloud.error().code, CodecErrorCode::ImplausibleSize);
      ++refused;
    }
  }
  EXPECT_EQ(refused, 1) << "of " << blob.size() << " places";
}

/// The same three points as every bitstream frames them: values as they are, without entropy coding, whose layout has
/// not changed since 1.0.
std::vector<std::byte> cloudOfVersion(unsigned major, unsigned minor) {
  std::vector<std::byte> bytes;
  const auto put = [&](auto value) {
    const auto* const at = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), at, at + sizeof value);
  };
  const bool has_varints = major >= 2;
  const bool has_short_ids = major == 1 && minor < 3;
  for (const char letter : std::string("DRACO")) {
    put(letter);
  }
  put(static_cast<std::uint8_t>(major));
  put(static_cast<std::uint8_t>(minor));
  put(std::uint8_t{0});   // a point cloud
  put(std::uint8_t{0});   // sequential
  put(std::uint16_t{0});  // flags
  put(std::int32_t{3});   // points
  put(std::uint8_t{1});   // attribute decoders
  if (has_varints) {
    put(std::uint8_t{2});  // attributes
  } else {
    put(std::uint32_t{2});
  }
  struct Attribute {
    draco::GeometryAttribute::Type type;
    draco::DataType data_type;
    std::uint8_t components;
  };
  const std::array attributes = {Attribute{draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3},
                                 Attribute{draco::GeometryAttribute::GENERIC, draco::DT_UINT16, 1}};
  for (std::uint8_t id = 0; id < 2; ++id) {
    put(static_cast<std::uint8_t>(attributes[id].type));
    put(static_cast<std::uint8_t>(attributes[id].data_type));
    put(attributes[id].components);
    put(std::uint8_t{0});  // not normalised
    if (has_short_ids) {
      put(std::uint16_t{id});
    } else {
      put(id);
    }
  }
  put(std::uint8_t{0});  // both of the generic sequential decoder
  put(std::uint8_t{0});
  for (const float value : {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, -6.5F, 7.25F, 1e6F}) {
    put(value);
  }
  for (const std::uint16_t value : {std::uint16_t{7}, std::uint16_t{65535}, std::uint16_t{0}}) {
    put(value);
  }
  return bytes;
}

TEST(DracoStreams, ReadsEveryBitstreamThatThereIs) {
  for (const auto& [major, minor] :
       {std::pair{1U, 0U}, {1U, 1U}, {1U, 2U}, {1U, 3U}, {2U, 0U}, {2U, 1U}, {2U, 2U}, {2U, 3U}}) {
    const auto cloud = decodeDraco(toPayload(cloudOfVersion(major, minor)));
    ASSERT_TRUE(cloud) << major << "." << minor << ": " << cloud.error().message;
    ASSERT_EQ(cloud->width, 3U);
    ASSERT_EQ(cloud->point_step, 14U);
    EXPECT_EQ(cloud->fields[0].name, "x");
    EXPECT_EQ(cloud->fields[3].name, "generic_1");
    float z = 0.0F;
    std::uint16_t ring = 0;
    std::memcpy(&z, cloud->data.bytes.data() + 2 * 14 + 8, sizeof z);
    std::memcpy(&ring, cloud->data.bytes.data() + 14 + 12, sizeof ring);
    EXPECT_EQ(z, 1e6F) << major << "." << minor;
    EXPECT_EQ(ring, 65535) << major << "." << minor;
  }
}

// Draco 0.9 wrote bitstream 1.1; no decoder was ever published that read one below 1.0.
TEST(DracoStreams, NamesBitstreamsOutsideThose) {
  for (const auto& [major, minor] : {std::pair{0U, 9U}, {2U, 4U}, {3U, 0U}}) {
    const auto cloud = decodeDraco(toPayload(cloudOfVersion(major, minor)));
    ASSERT_FALSE(cloud);
    EXPECT_EQ(cloud.error().code, CodecErrorCode::UnsupportedVersion);
    EXPECT_THAT(cloud.error().message, testing::HasSubstr("version"));
  }
}

}  // namespace
}  // namespace stillframe::test
