#include "nodes/points/codecs/draco.h"

#include <draco/compression/expert_encode.h>
#include <draco/point_cloud/point_cloud.h>
#include <gmock/gmock.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/builders.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

using sample::toPayload;

using draco::GeometryAttribute;
using nodes::CodecErrorCode;
using nodes::decodeDraco;
using scenegraph::FieldType;

/// A point cloud for libdraco's encoder, an attribute at a time.
class DracoBuilder {
 public:
  explicit DracoBuilder(unsigned points) { cloud_->set_num_points(points); }

  /// `values` holds one entry of `components` for each point.
  template <typename T>
  DracoBuilder& attribute(GeometryAttribute::Type type, draco::DataType data_type, int components,
                          const std::vector<T>& values, const std::string& name = {}) {
    const int id = add<T>(type, data_type, components, cloud_->num_points(), true);
    for (unsigned i = 0; i < cloud_->num_points(); ++i) {
      cloud_->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                               &values[i * static_cast<unsigned>(components)]);
    }
    return name.empty() ? *this : named(id, name);
  }
  /// Few values that many points share: point i has entry mapping[i].
  template <typename T>
  DracoBuilder& mapped(GeometryAttribute::Type type, draco::DataType data_type, const std::vector<T>& values,
                       const std::vector<unsigned>& mapping) {
    const int id = add<T>(type, data_type, 1, static_cast<unsigned>(values.size()), false);
    for (unsigned i = 0; i < values.size(); ++i) {
      cloud_->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
    }
    for (unsigned i = 0; i < mapping.size(); ++i) {
      cloud_->attribute(id)->SetPointMapEntry(draco::PointIndex(i), draco::AttributeValueIndex(mapping[i]));
    }
    return *this;
  }
  /// Bits of the positions; 0: not quantised.
  [[nodiscard]] std::vector<std::byte> encode(int method, int bits = 0) {
    draco::ExpertEncoder encoder(*cloud_);
    encoder.SetEncodingMethod(method);
    if (bits > 0) {
      encoder.SetAttributeQuantization(0, bits);
    }
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    EXPECT_TRUE(status.ok()) << status.error_msg_string();
    std::vector<std::byte> bytes(buffer.size());
    std::memcpy(bytes.data(), buffer.data(), buffer.size());
    return bytes;
  }

 private:
  template <typename T>
  int add(GeometryAttribute::Type type, draco::DataType data_type, int components, unsigned values, bool is_identity) {
    GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), data_type, false,
                   static_cast<std::int64_t>(sizeof(T)) * components, 0);
    return cloud_->AddAttribute(attribute, is_identity, values);
  }
  DracoBuilder& named(int id, const std::string& name) {
    auto metadata = std::make_unique<draco::AttributeMetadata>();
    metadata->AddEntryString("name", name);
    cloud_->AddAttributeMetadata(id, std::move(metadata));
    return *this;
  }

  std::unique_ptr<draco::PointCloud> cloud_ = std::make_unique<draco::PointCloud>();
};

constexpr int kSequential = draco::POINT_CLOUD_SEQUENTIAL_ENCODING;
constexpr int kTree = draco::POINT_CLOUD_KD_TREE_ENCODING;
const std::vector<float> kCorners = {0, 0, 0, 1, 2, 3, -4, 5.5F, 6};

template <typename T>
T at(const scenegraph::PointCloud& cloud, std::size_t field, std::size_t point, std::size_t component = 0) {
  T value;
  std::memcpy(
      &value,
      cloud.data.bytes.data() + point * cloud.point_step + cloud.fields.at(field).offset + component * sizeof(T),
      sizeof(T));
  return value;
}

std::vector<std::string> namesOf(const scenegraph::PointCloud& cloud) {
  std::vector<std::string> names;
  for (const auto& field : cloud.fields) {
    names.push_back(field.name);
  }
  return names;
}

TEST(Draco, NamesFieldsByMetadataElseByAttributeType) {
  const auto blob = DracoBuilder(3)
                        .attribute(GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, kCorners, "position")
                        .attribute<float>(GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, kCorners)
                        .attribute<std::uint8_t>(GeometryAttribute::COLOR, draco::DT_UINT8, 4,
                                                 {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})
                        .attribute<float>(GeometryAttribute::GENERIC, draco::DT_FLOAT32, 1, {7, 8, 9}, "intensity")
                        .attribute<std::uint16_t>(GeometryAttribute::GENERIC, draco::DT_UINT16, 1, {1, 2, 65535})
                        .attribute<std::int16_t>(GeometryAttribute::GENERIC, draco::DT_INT16, 2, {-1, 2, -3, 4, -5, 6})
                        .encode(kSequential);
  const auto cloud = decodeDraco(toPayload(blob));
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_THAT(namesOf(*cloud), testing::ElementsAre("x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha",
                                                    "intensity", "generic_4", "generic_5"));
  EXPECT_EQ(cloud->width, 3U);
  EXPECT_EQ(cloud->point_step, 12U + 12 + 4 + 4 + 2 + 4);
  EXPECT_EQ(at<float>(*cloud, 1, 2), 5.5F);
  EXPECT_EQ(at<std::uint8_t>(*cloud, 9, 1), 8);
  EXPECT_EQ(at<float>(*cloud, 10, 1), 8.0F);
  EXPECT_EQ(at<std::uint16_t>(*cloud, 11, 2), 65535);
  EXPECT_EQ(cloud->fields[12].count, 2U);
  EXPECT_EQ(at<std::int16_t>(*cloud, 12, 2, 0), -5);
}

TEST(Draco, TakesEveryDataType) {
  const auto blob = DracoBuilder(3)
                        .attribute(GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, kCorners)
                        .attribute<std::int8_t>(GeometryAttribute::GENERIC, draco::DT_INT8, 1, {-128, 0, 127})
                        .attribute<std::int32_t>(GeometryAttribute::GENERIC, draco::DT_INT32, 1, {-100000, 0, 100000})
                        .attribute<std::uint32_t>(GeometryAttribute::GENERIC, draco::DT_UINT32, 1, {0, 1, 100000})
                        .attribute<double>(GeometryAttribute::GENERIC, draco::DT_FLOAT64, 1, {1e300, -1e-300, 0.1})
                        .attribute<std::int64_t>(GeometryAttribute::GENERIC, draco::DT_INT64, 1, {-1, 1LL << 52, 3})
                        .attribute<std::uint64_t>(GeometryAttribute::GENERIC, draco::DT_UINT64, 1, {0, 1ULL << 63, 3})
                        .encode(kSequential);
  const auto cloud = decodeDraco(toPayload(blob));
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(at<std::int8_t>(*cloud, 3, 0), -128);
  EXPECT_EQ(at<std::int32_t>(*cloud, 4, 0), -100000);
  EXPECT_EQ(at<std::uint32_t>(*cloud, 5, 2), 100000U);
  EXPECT_EQ(at<double>(*cloud, 6, 0), 1e300);
  EXPECT_EQ(cloud->fields[7].type, FieldType::Float64);
  EXPECT_EQ(at<double>(*cloud, 7, 1), 4503599627370496.0);
  EXPECT_EQ(at<double>(*cloud, 8, 1), 9223372036854775808.0);
}

TEST(Draco, PutsSharedValuesInPointOrder) {
  const auto blob = DracoBuilder(3)
                        .attribute(GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, kCorners)
                        .mapped<std::uint8_t>(GeometryAttribute::GENERIC, draco::DT_UINT8, {40, 50}, {1, 0, 1})
                        .encode(kSequential);
  const auto cloud = decodeDraco(toPayload(blob));
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(at<std::uint8_t>(*cloud, 3, 0), 50);
  EXPECT_EQ(at<std::uint8_t>(*cloud, 3, 1), 40);
  EXPECT_EQ(at<std::uint8_t>(*cloud, 3, 2), 50);
}

TEST(Draco, QuantisedPositionsComeBackAsFloats) {
  for (const int method : {kSequential, kTree}) {
    const auto blob =
        DracoBuilder(3).attribute(GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, kCorners).encode(method, 12);
    const auto cloud = decodeDraco(toPayload(blob));
    ASSERT_TRUE(cloud) << cloud.error().message;
    ASSERT_EQ(cloud->fields[0].type, FieldType::Float32);
    double sum = 0.0;  // a tree has an order of its own
    for (std::size_t i = 0; i < 3; ++i) {
      sum += static_cast<double>(at<float>(*cloud, 0, i)) + 10.0 * static_cast<double>(at<float>(*cloud, 1, i)) +
             100.0 * static_cast<double>(at<float>(*cloud, 2, i));
    }
    EXPECT_NEAR(sum, -3.0 + 75.0 + 900.0, 3 * 111.0 * 6.0 / 4095.0);
  }
}

std::vector<std::vector<std::byte>> smallBlobs() {
  std::vector<float> positions;
  std::vector<std::uint8_t> colors;
  Random random(5);
  for (unsigned i = 0; i < 150; ++i) {
    positions.push_back(static_cast<float>(random.number(-5, 5)));
    colors.push_back(static_cast<std::uint8_t>(random.index(256)));
  }
  std::vector<std::vector<std::byte>> blobs;
  for (const int method : {kSequential, kTree}) {
    blobs.push_back(DracoBuilder(50)
                        .attribute(GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, positions, "position")
                        .attribute(GeometryAttribute::COLOR, draco::DT_UINT8, 3, colors)
                        .encode(method, 8));
  }
  return blobs;
}

TEST(Draco, ErrsOnEveryCut) {
  for (const auto& blob : smallBlobs()) {
    ASSERT_TRUE(decodeDraco(toPayload(blob)));
    for (std::size_t size = 0; size < blob.size(); ++size) {
      const auto cloud = decodeDraco(toPayload({blob.begin(), blob.begin() + static_cast<std::ptrdiff_t>(size)}));
      if (cloud) {  // what stands behind the last value need not be there
        EXPECT_GT(size + 16, blob.size());
      }
    }
  }
}

TEST(Draco, SurvivesEveryWrongByte) {
  for (const auto& blob : smallBlobs()) {
    for (std::size_t at = 0; at < blob.size(); ++at) {
      for (const std::byte flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
        auto wrong = blob;
        wrong[at] ^= flip;
        const auto cloud = decodeDraco(toPayload(std::move(wrong)));
        if (cloud) {
          EXPECT_EQ(cloud->data.bytes.size(), std::size_t{cloud->width} * cloud->point_step);
        }
      }
    }
  }
}

/// A stream of `head` and then zeros.
std::vector<std::byte> streamOf(const std::vector<unsigned>& head, std::size_t size) {
  std::vector<std::byte> blob(size);
  for (std::size_t i = 0; i < head.size(); ++i) {
    blob[i] = static_cast<std::byte>(head[i]);
  }
  return blob;
}

TEST(Draco, RefusesClaimsBeyondWhatItsBytesJustify) {
  // "DRACO", version, type, method, flags; then what is claimed.
  const std::vector<std::vector<unsigned>> heads = {
      {0x44, 0x52, 0x41, 0x43, 0x4f, 2, 3, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 1},                         // points
      {0x44, 0x52, 0x41, 0x43, 0x4f, 2, 3, 0, 1, 0, 0, 0xff, 0xff, 0xff, 0x7f, 1},                         // tree
      {0x44, 0x52, 0x41, 0x43, 0x4f, 2, 2, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 4, 0xff, 0xff, 0xff, 0xf},  // faces
      {0x44, 0x52, 0x41, 0x43, 0x4f, 2, 2, 1, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0xf, 0xff, 0xff, 0xff, 0xff, 4},
      {0x44, 0x52, 0x41, 0x43, 0x4f, 1, 1, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0x4f, 0xff, 0xff, 0xff, 0x4f}};
  for (const auto& head : heads) {
    const auto cloud = decodeDraco(toPayload(streamOf(head, 200)));
    ASSERT_FALSE(cloud);
    EXPECT_EQ(cloud.error().code, CodecErrorCode::ImplausibleSize) << cloud.error().message;
  }
  // 5 million points fit the limit by themselves, with an attribute of 255 values each they do not.
  const auto cloud = decodeDraco(toPayload(
      streamOf({0x44, 0x52, 0x41, 0x43, 0x4f, 2, 3, 0, 0, 0, 0, 0x40, 0x4b, 0x4c, 0, 1, 1, 4, 9, 255, 0, 0, 0}, 200)));
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, CodecErrorCode::ImplausibleSize) << cloud.error().message;
}

TEST(Draco, NamesWhatItDoesNotRead) {
  const auto codeOf = [](const std::vector<std::byte>& blob) {
    const auto cloud = decodeDraco(toPayload(blob));
    return cloud ? CodecErrorCode::UnknownFormat : cloud.error().code;
  };
  EXPECT_EQ(codeOf({}), CodecErrorCode::MalformedHeader);
  EXPECT_EQ(codeOf(std::vector<std::byte>(100)), CodecErrorCode::MalformedHeader);
  EXPECT_EQ(codeOf(streamOf({0x44, 0x52, 0x41, 0x43, 0x4f, 2, 3, 7}, 50)), CodecErrorCode::MalformedHeader);
  EXPECT_EQ(codeOf(streamOf({0x44, 0x52, 0x41, 0x43, 0x4f, 9, 9, 0}, 50)), CodecErrorCode::UnsupportedVersion);
}

}  // namespace
}  // namespace stillframe::test
