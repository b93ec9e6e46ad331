#include "nodes/points/codecs/cloudini.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "tests/support/builders.h"
#include "tools/sample/cloudini_writer.h"

namespace stillframe::test {
namespace {

using sample::SectionMode;
using sample::toPayload;
using sample::writeCloudini;
using sample::writeCloudiniHeader;

using namespace nodes::cloudini;
using nodes::CodecErrorCode;
using nodes::decodeCloudini;
using testing::HasSubstr;

constexpr float kResolution = 0.01F;

/// A record with a field of every type, at odd offsets and with bytes that belong to no field.
struct Record {
  static constexpr std::uint32_t kStep = 61;
  static Header header(std::size_t points) {
    Header header;
    header.version = 5;
    header.width = static_cast<std::uint32_t>(points);
    header.point_step = kStep;
    header.fields = {{"x", 0, ValueType::Float32, kResolution}, {"y", 4, ValueType::Float32, kResolution},
                     {"z", 8, ValueType::Float32, kResolution}, {"i8", 12, ValueType::Int8, {}},
                     {"intensity", 13, ValueType::Float32, {}}, {"u8", 17, ValueType::Uint8, {}},
                     {"i16", 18, ValueType::Int16, {}},         {"u16", 20, ValueType::Uint16, {}},
                     {"i32", 23, ValueType::Int32, {}},         {"u32", 27, ValueType::Uint32, {}},
                     {"i64", 31, ValueType::Int64, {}},         {"u64", 39, ValueType::Uint64, {}},
                     {"stamp", 47, ValueType::Float64, {}},     {"w", 55, ValueType::Float32, kResolution}};
    return header;
  }
};

template <typename T>
void store(std::vector<std::byte>& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}
template <typename T>
T load(std::span<const std::byte> bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

std::vector<std::byte> makePoints(std::size_t count, unsigned seed = 1) {
  Random random(seed);
  std::vector<std::byte> bytes(count * Record::kStep);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * Record::kStep;
    const bool is_hole = i % 7 == 3;
    const auto number = [&](double reach) {
      return is_hole ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(random.number(-reach, reach));
    };
    store(bytes, at + 0, number(90));
    store(bytes, at + 4, number(90));
    store(bytes, at + 8, number(9));
    store(bytes, at + 12, static_cast<std::int8_t>(random.index(256)));
    store(bytes, at + 13, number(1e6));
    store(bytes, at + 17, static_cast<std::uint8_t>(random.index(256)));
    store(bytes, at + 18, static_cast<std::int16_t>(random.number(-32768, 32767)));
    store(bytes, at + 20, static_cast<std::uint16_t>(i / 100));
    store(bytes, at + 23, static_cast<std::int32_t>(random.number(-2e9, 2e9)));
    store(bytes, at + 27, static_cast<std::uint32_t>(random.index(5) * 1000000000));
    store(bytes, at + 31,
          i % 2 == 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max());
    store(bytes, at + 39, std::numeric_limits<std::uint64_t>::max() - i);
    store(bytes, at + 47, i % 5 == 4 ? random.number(-1e300, 1e300) : 1.7e9 + static_cast<double>(i / 16) * 1e-3);
    store(bytes, at + 55, number(1000));
  }
  return bytes;
}

/// Every byte that belongs to a field equals the original, lossy floats within half a resolution.
void expectEqualPoints(const scenegraph::PointCloud& cloud, const std::vector<std::byte>& expected, bool is_lossy) {
  ASSERT_EQ(cloud.data.bytes.size(), expected.size());
  double worst = 0.0;
  for (const Field& field : Record::header(1).fields) {
    for (std::size_t at = field.offset; at < expected.size(); at += Record::kStep) {
      const std::size_t size = byteSize(field.type);
      if (is_lossy && field.resolution) {
        const auto value = load<float>(cloud.data.bytes, at);
        const auto truth = load<float>(expected, at);
        ASSERT_EQ(std::isnan(value), std::isnan(truth)) << field.name << " at byte " << at;
        worst = std::max(worst, std::isnan(truth) ? 0.0 : std::abs(static_cast<double>(value) - truth));
      } else {
        ASSERT_EQ(std::memcmp(cloud.data.bytes.data() + at, expected.data() + at, size), 0)
            << field.name << " at byte " << at;
      }
    }
  }
  if (is_lossy) {
    EXPECT_LE(worst, 0.5 * kResolution + 1e-4) << "1e-4: a float of 1000 in hundredths";
    EXPECT_GT(worst, 0.0);
  }
}

struct Variant {
  unsigned version;
  Encoding encoding;
  Compression compression;
  bool has_binary_header;
  SectionMode mode;
};

std::vector<Variant> allVariants() {
  std::vector<Variant> variants;
  for (const unsigned version : {3U, 4U, 5U}) {
    for (const Encoding encoding : {Encoding::None, Encoding::Lossy, Encoding::Lossless}) {
      for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
        for (const bool is_binary : {false, true}) {
          variants.push_back({version, encoding, compression, is_binary, SectionMode::Differences});
        }
      }
    }
  }
  for (const SectionMode mode : {SectionMode::Palette, SectionMode::Runs, SectionMode::DifferenceRuns}) {
    for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
      for (const bool is_binary : {false, true}) {
        variants.push_back({5, Encoding::Lossy, compression, is_binary, mode});
        variants.push_back({5, Encoding::Lossless, compression, is_binary, mode});
      }
    }
  }
  return variants;
}

std::vector<std::byte> write(const Variant& variant, std::size_t count, const std::vector<std::byte>& points) {
  Header header = Record::header(count);
  header.version = variant.version;
  header.encoding = variant.encoding;
  header.compression = variant.compression;
  return writeCloudini(header, points, {.has_binary_header = variant.has_binary_header, .section_mode = variant.mode});
}

std::string nameOf(const testing::TestParamInfo<Variant>& info) {
  static constexpr const char* kEncodings[] = {"None", "Lossy", "Lossless"};
  static constexpr const char* kCompressions[] = {"Plain", "Lz4", "Zstd"};
  const Variant& variant = info.param;
  return "V" + std::to_string(variant.version) + kEncodings[static_cast<int>(variant.encoding)] +
         kCompressions[static_cast<int>(variant.compression)] + (variant.has_binary_header ? "Binary" : "Yaml") +
         "Mode" + std::to_string(static_cast<int>(variant.mode));
}

class CloudiniVariant : public testing::TestWithParam<Variant> {};

TEST_P(CloudiniVariant, GivesBackEveryFieldOfEveryPoint) {
  const auto points = makePoints(1000);
  const auto cloud = decodeCloudini(toPayload(write(GetParam(), 1000, points)));
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->width, 1000U);
  EXPECT_EQ(cloud->height, 1U);
  EXPECT_EQ(cloud->point_step, Record::kStep);
  EXPECT_EQ(cloud->row_step, 1000U * Record::kStep);
  expectEqualPoints(*cloud, points, GetParam().encoding == Encoding::Lossy);
}

TEST_P(CloudiniVariant, BeginsAnewWithTheSecondChunk) {
  const auto points = makePoints(33'000);  // a chunk holds 32 768
  const auto cloud = decodeCloudini(toPayload(write(GetParam(), 33'000, points)));
  ASSERT_TRUE(cloud) << cloud.error().message;
  expectEqualPoints(*cloud, points, GetParam().encoding == Encoding::Lossy);
}

TEST_P(CloudiniVariant, ErrsOnEveryCutAndNeverOnMemory) {
  const auto blob = write(GetParam(), 40, makePoints(40));
  for (std::size_t size = 0; size < blob.size(); ++size) {
    EXPECT_FALSE(decodeCloudini(toPayload({blob.begin(), blob.begin() + static_cast<std::ptrdiff_t>(size)})))
        << size << " of " << blob.size() << " bytes";
  }
  auto longer = blob;
  longer.push_back(std::byte{1});
  EXPECT_FALSE(decodeCloudini(toPayload(longer)));
}

TEST_P(CloudiniVariant, SurvivesEveryWrongByte) {
  const auto blob = write(GetParam(), 12, makePoints(12));
  for (std::size_t at = 0; at < blob.size(); ++at) {
    for (const std::byte flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
      auto wrong = blob;
      wrong[at] ^= flip;
      const auto cloud = decodeCloudini(toPayload(std::move(wrong)));
      if (cloud) {
        EXPECT_EQ(cloud->data.bytes.size(), std::size_t{cloud->width} * cloud->height * cloud->point_step);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, CloudiniVariant, testing::ValuesIn(allVariants()), nameOf);

TEST(Cloudini, BeginsAnewWithEachChunk) {
  for (const std::size_t count : {32767U, 32768U, 32769U, 65536U, 70000U}) {
    const auto points = makePoints(count, static_cast<unsigned>(count));
    for (const unsigned version : {3U, 5U}) {
      const auto cloud = decodeCloudini(toPayload(
          write({version, Encoding::Lossy, Compression::Zstd, false, SectionMode::Differences}, count, points)));
      ASSERT_TRUE(cloud) << cloud.error().message;
      expectEqualPoints(*cloud, points, true);
    }
  }
}

TEST(Cloudini, KeepsTheBytesOfFieldsThatItDrops) {
  const auto cloud = decodeCloudini(
      toPayload(write({5, Encoding::Lossy, Compression::Zstd, false, SectionMode::Palette}, 100, makePoints(100))));
  ASSERT_TRUE(cloud);
  std::vector<std::string> names;
  for (const auto& field : cloud->fields) {
    names.push_back(field.name);
  }
  EXPECT_THAT(names,
              testing::ElementsAre("x", "y", "z", "i8", "intensity", "u8", "i16", "u16", "i32", "u32", "stamp", "w"));
  EXPECT_EQ(cloud->fields[10].offset, 47U);
  EXPECT_EQ(cloud->point_step, Record::kStep);
}

TEST(Cloudini, KeepsRowsAndReadsAnEmptyCloud) {
  Header header = Record::header(20);
  header.height = 5;
  const auto points = makePoints(100);
  const auto cloud = decodeCloudini(toPayload(writeCloudini(header, points)));
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->width, 20U);
  EXPECT_EQ(cloud->height, 5U);
  EXPECT_EQ(cloud->row_step, 20U * Record::kStep);
  const auto empty = decodeCloudini(toPayload(writeCloudini(Record::header(0), {})));
  ASSERT_TRUE(empty) << empty.error().message;
  EXPECT_EQ(empty->width, 0U);
  EXPECT_TRUE(empty->data.bytes.empty());
}

TEST(Cloudini, ReadsABinaryHeaderWhoseWidthLooksLikeALineBreak) {
  const auto points = makePoints(10);
  const auto cloud = decodeCloudini(toPayload(writeCloudini(Record::header(10), points, {.has_binary_header = true})));
  ASSERT_TRUE(cloud) << cloud.error().message;
  expectEqualPoints(*cloud, points, true);
}

TEST(Cloudini, LeavesOutFieldsThatLieOutsideTheirPoint) {
  const auto points = makePoints(50);
  auto blob = writeCloudini(Record::header(50), points, {.has_binary_header = true});
  // The same stream under a header that leaves "w" one byte short, and says of "u8" that it is not in the point.
  Header header = Record::header(50);
  const std::size_t header_size = writeCloudiniHeader(header, true).size();
  header.fields[5].offset = Field::kNotStored;
  header.fields[13].offset = Record::kStep - 3;
  auto odd = writeCloudiniHeader(header, true);
  odd.insert(odd.end(), blob.begin() + static_cast<std::ptrdiff_t>(header_size), blob.end());
  const auto cloud = decodeCloudini(toPayload(std::move(odd)));
  ASSERT_TRUE(cloud) << cloud.error().message;
  for (const auto& field : cloud->fields) {
    EXPECT_NE(field.name, "w");
    EXPECT_NE(field.name, "u8");
  }
  EXPECT_EQ(load<std::uint32_t>(cloud->data.bytes, Record::kStep + 27),
            load<std::uint32_t>(points, Record::kStep + 27));
}

CodecErrorCode errorOf(const std::vector<std::byte>& blob) {
  const auto cloud = decodeCloudini(toPayload(blob));
  return cloud ? CodecErrorCode::UnknownFormat : cloud.error().code;
}

TEST(Cloudini, RefusesClaimsThatItsBytesCannotHold) {
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    Header header = Record::header(0);
    header.compression = compression;
    header.width = 70'000'000;  // 4 GB of points
    auto blob = writeCloudiniHeader(header, false);
    blob.resize(2048);
    EXPECT_EQ(errorOf(blob), CodecErrorCode::ImplausibleSize);
    header.width = header.height = header.point_step = 0xffffffff;
    blob = writeCloudiniHeader(header, true);
    blob.resize(1024);
    EXPECT_EQ(errorOf(blob), CodecErrorCode::ImplausibleSize);
    header.point_step = 0;
    blob = writeCloudiniHeader(header, true);
    EXPECT_EQ(errorOf(blob), CodecErrorCode::ImplausibleSize);
    header = Record::header(100'000);
    header.compression = compression;
    header.fields.resize(1);
    blob = writeCloudiniHeader(header, false);
    blob.resize(blob.size() + 40);
    EXPECT_EQ(errorOf(blob),
              compression == Compression::Zstd ? CodecErrorCode::CorruptCloud : CodecErrorCode::ImplausibleSize);
  }
}

TEST(Cloudini, NamesWhatItDoesNotRead) {
  Header header = Record::header(0);
  for (const unsigned version : {0U, 1U, 2U, 6U, 9U}) {
    header.version = version;
    EXPECT_EQ(errorOf(writeCloudiniHeader(header, false)), CodecErrorCode::UnsupportedVersion);
  }
  EXPECT_EQ(errorOf({}), CodecErrorCode::MalformedHeader);
  EXPECT_EQ(errorOf(std::vector<std::byte>(100)), CodecErrorCode::MalformedHeader);
  header.version = 5;
  auto blob = writeCloudiniHeader(header, false);
  blob.pop_back();
  EXPECT_EQ(errorOf(blob), CodecErrorCode::MalformedHeader);
  header.fields.resize(2000);
  EXPECT_EQ(errorOf(writeCloudiniHeader(header, false)), CodecErrorCode::MalformedHeader);
  EXPECT_EQ(errorOf(writeCloudiniHeader(header, true)), CodecErrorCode::MalformedHeader);
}

}  // namespace
}  // namespace stillframe::test
