// The blobs and meshes beside the recordings, against what upstream encoders were given.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "nodes/points/codecs/cloudini.h"
#include "nodes/points/codecs/draco.h"
#include "tests/support/recordings.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

using sample::toPayload;

using scenegraph::FieldType;

std::vector<std::byte> readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  const std::vector<char> chars{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::byte> bytes(chars.size());
  std::memcpy(bytes.data(), chars.data(), chars.size());
  return bytes;
}

template <typename T>
double number(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

double valueOf(const scenegraph::PointCloud& cloud, const std::string& name, std::size_t point) {
  for (const auto& field : cloud.fields) {
    if (field.name == name) {
      const std::byte* const at = cloud.data.bytes.data() + point * cloud.point_step + field.offset;
      switch (field.type) {
        case FieldType::Float32:
          return number<float>(at);
        case FieldType::Float64:
          return number<double>(at);
        case FieldType::Uint8:
          return number<std::uint8_t>(at);
        case FieldType::Uint16:
          return number<std::uint16_t>(at);
        default:
          return number<std::int32_t>(at);
      }
    }
  }
  ADD_FAILURE() << "no field " << name;
  return 0.0;
}

/// The scan itself: x, y, z, intensity FLOAT32 and ring UINT16 in 18 bytes.
struct Reference {
  std::vector<std::byte> bytes = readFile(kData / "compressed_blobs/reference_points.bin");
  [[nodiscard]] std::size_t points() const { return bytes.size() / 18; }
  [[nodiscard]] double at(std::size_t point, std::size_t column) const {
    const std::byte* const from = bytes.data() + point * 18 + column * 4;
    return column == 4 ? number<std::uint16_t>(from) : number<float>(from);
  }
};

class CloudiniBlob : public testing::TestWithParam<const char*> {};

TEST_P(CloudiniBlob, LiesWithinHalfAResolutionOfTheScan) {
  const Reference reference;
  const auto cloud = nodes::decodeCloudini(toPayload(readFile(kData / "compressed_blobs" / GetParam())));
  ASSERT_TRUE(cloud) << cloud.error().message;
  ASSERT_EQ(cloud->width, reference.points());
  ASSERT_EQ(cloud->point_step, 18U);
  const char* const names[] = {"x", "y", "z", "intensity"};
  for (std::size_t column = 0; column < 4; ++column) {
    double worst = 0.0;
    for (std::size_t i = 0; i < reference.points(); ++i) {
      worst = std::max(worst, std::abs(valueOf(*cloud, names[column], i) - reference.at(i, column)));
    }
    EXPECT_LE(worst, 0.0005 + 1e-6) << names[column] << "; 1e-6: the encoder multiplies and the points are float";
  }
  for (std::size_t i = 0; i < reference.points(); ++i) {
    ASSERT_EQ(valueOf(*cloud, "ring", i), reference.at(i, 4)) << i;
  }
}
INSTANTIATE_TEST_SUITE_P(All, CloudiniBlob,
                         testing::Values("cloudini_v4_lossy_zstd.cloudini", "cloudini_v5_lossy_zstd.cloudini"),
                         [](const auto& test) { return std::string(test.param).substr(9, 2); });

TEST(DracoBlob, LosslessIsTheScanToTheBit) {
  const Reference reference;
  const auto cloud = nodes::decodeDraco(toPayload(readFile(kData / "compressed_blobs/draco_seq_lossless.drc")));
  ASSERT_TRUE(cloud) << cloud.error().message;
  ASSERT_EQ(cloud->width, reference.points());
  for (std::size_t i = 0; i < reference.points(); ++i) {
    ASSERT_EQ(valueOf(*cloud, "x", i), reference.at(i, 0)) << i;
    ASSERT_EQ(valueOf(*cloud, "y", i), reference.at(i, 1)) << i;
    ASSERT_EQ(valueOf(*cloud, "z", i), reference.at(i, 2)) << i;
  }
}

TEST(DracoBlob, NamesComeFromTheMetadata) {
  const Reference reference;
  const auto cloud = nodes::decodeDraco(toPayload(readFile(kData / "compressed_blobs/draco_seq_named.drc")));
  ASSERT_TRUE(cloud) << cloud.error().message;
  ASSERT_EQ(cloud->width, reference.points());
  std::vector<std::string> names;
  for (const auto& field : cloud->fields) {
    names.push_back(field.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("x", "y", "z", "intensity", "ring"));
  double low = 1e9;
  double high = -1e9;
  for (std::size_t i = 0; i < reference.points(); ++i) {
    low = std::min(low, reference.at(i, 0));
    high = std::max(high, reference.at(i, 0));
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < reference.points(); ++i) {
    worst = std::max(worst, std::abs(valueOf(*cloud, "x", i) - reference.at(i, 0)));
    ASSERT_EQ(valueOf(*cloud, "ring", i), reference.at(i, 4)) << i;
  }
  // 14 bits over the longest side of the box, which is that of x and y.
  EXPECT_LE(worst, 2.0 * (high - low) / 16383.0);
}

struct Sample {
  const char* path;
  unsigned points;
  std::vector<std::string> names;
  double low;
  double high;
};
std::ostream& operator<<(std::ostream& out, const Sample& sample) { return out << sample.path; }

class DracoSample : public testing::TestWithParam<Sample> {};

TEST_P(DracoSample, Decodes) {
  const auto cloud = nodes::decodeDraco(toPayload(readFile(kData / GetParam().path)));
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->width, GetParam().points);
  EXPECT_EQ(cloud->data.bytes.size(), std::size_t{cloud->width} * cloud->point_step);
  std::vector<std::string> names;
  for (const auto& field : cloud->fields) {
    names.push_back(field.name);
  }
  EXPECT_EQ(names, GetParam().names);
  double low = 1e9;
  double high = -1e9;
  for (std::size_t i = 0; i < cloud->width; ++i) {
    low = std::min(low, valueOf(*cloud, "x", i));
    high = std::max(high, valueOf(*cloud, "x", i));
  }
  EXPECT_NEAR(low, GetParam().low, 0.001);
  EXPECT_NEAR(high, GetParam().high, 0.001);
}
const std::vector<std::string> kPositionsAndNormals = {"x", "y", "z", "nx", "ny", "nz"};
const std::vector<std::string> kPositionsAndColors = {"x", "y", "z", "red", "green", "blue"};

// Counts and limits as the encoders were given them: Stanford's bunny, a car, the point clouds of Draco's own suite.
INSTANTIATE_TEST_SUITE_P(
    All, DracoSample,
    testing::Values(Sample{"compressed_blobs/draco_color_kinect.drc", 67894, kPositionsAndColors, -0.911, 0.616},
                    Sample{"draco/bunny_gltf.drc", 34834, kPositionsAndNormals, -0.0947, 0.0611},
                    Sample{"draco/car.drc", 1856, {"nx", "ny", "nz", "x", "y", "z", "generic_2"}, -2.431, 2.438},
                    Sample{"draco/pc_color.drc", 7733, kPositionsAndColors, 100.317, 107.925},
                    Sample{"draco/pc_kd_color.drc", 7733, kPositionsAndColors, 100.317, 107.925},
                    Sample{"draco/test_nm.obj.edgebreaker.1.1.0.drc", 99, kPositionsAndNormals, -1.0, 1.0},
                    Sample{"draco/test_nm.obj.sequential.1.1.0.drc", 97, kPositionsAndNormals, -1.0, 1.0}));

TEST(DracoBlob, TwoMethodsGiveTheSamePoints) {
  const auto sequential = nodes::decodeDraco(toPayload(readFile(kData / "draco/pc_color.drc")));
  const auto tree = nodes::decodeDraco(toPayload(readFile(kData / "draco/pc_kd_color.drc")));
  ASSERT_TRUE(sequential && tree);
  const auto sorted = [](const scenegraph::PointCloud& cloud) {
    std::vector<std::array<double, 4>> points;
    for (std::size_t i = 0; i < cloud.width; ++i) {
      points.push_back({std::round(valueOf(cloud, "x", i) * 100), std::round(valueOf(cloud, "y", i) * 100),
                        std::round(valueOf(cloud, "z", i) * 100), valueOf(cloud, "red", i)});
    }
    std::ranges::sort(points);
    return points;
  };
  const auto a = sorted(*sequential);
  const auto b = sorted(*tree);
  std::vector<std::array<double, 4>> common;
  std::ranges::set_intersection(a, b, std::back_inserter(common));
  EXPECT_GT(common.size(), a.size() * 8 / 10) << "quantised apart, some land in the next centimetre";
}

TEST(DracoBlob, ACubeHasItsCorners) {
  for (const char* const name : {"cube_att.drc", "cube_att.obj.edgebreaker.cl10.2.2.drc",
                                 "cube_att.obj.sequential.cl3.2.2.drc", "cube_att_sub_o_2.drc", "cube_pc.drc"}) {
    const auto cloud = nodes::decodeDraco(toPayload(readFile(kData / "draco" / name)));
    ASSERT_TRUE(cloud) << name << ": " << cloud.error().message;
    // Cut in two objects, the cube has two points more.
    EXPECT_EQ(cloud->width, std::string_view(name) == "cube_att_sub_o_2.drc" ? 26U : 24U) << name;
    unsigned corners = 0;
    for (std::size_t i = 0; i < cloud->width; ++i) {
      unsigned corner = 0;
      for (const char* const axis : {"x", "y", "z"}) {
        const double value = valueOf(*cloud, axis, i);
        EXPECT_LT(std::abs(value - std::round(value)), 1e-3) << name;
        corner = 2 * corner + (value > 0.5 ? 1U : 0U);
      }
      corners |= 1U << corner;
    }
    EXPECT_EQ(corners, 0xffU) << name;
  }
}

}  // namespace
}  // namespace stillframe::test
