#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/thread_priority.h"
#include "tests/tools/ingest/ros_samples.h"
#include "tests/tools/ingest/temporary_file.h"
#include "tools/ingest/mcap_source.h"
#include "tools/ingest/mcap_writer.h"

namespace stillframe::ingest {
namespace {

using scenegraph::ObjectType;
using scenegraph::PointCloud;

constexpr std::uint32_t kPoints = 1'000'000;  // 12 MB

scenegraph::TopicInfo topicOf(std::string name) {
  scenegraph::TopicInfo info;
  info.name = std::move(name);
  info.type = ObjectType::PointCloud;
  return info;
}
const scenegraph::TopicInfo kTopic = topicOf("/points");

/// A recording of one large cloud, in a chunk: points of noise, else it is packed so far that its size is no sign of
/// what it claims.
void writeCloud(const std::filesystem::path& path, Compression compression, std::uint32_t points) {
  auto writer = McapWriter::open(path, {.compression = compression});
  ASSERT_TRUE(writer);
  const auto channel =
      (*writer)->addChannel("/points", "sensor_msgs/msg/PointCloud2", "ros2msg", test::kCloudDefinition, "cdr");
  auto message = test::cloudMessage(7, points, ByteOrder::Little);
  constexpr std::ptrdiff_t kHead = 200;  // bytes, and more
  std::mt19937 random(9);
  std::generate(message.begin() + kHead, message.end() - 1, [&] { return static_cast<std::byte>(random()); });
  ASSERT_TRUE((*writer)->write(channel, 5, 5, message));
  ASSERT_TRUE((*writer)->finish());
}

/// What reads it, and where its cloud is.
struct Recorded {
  std::shared_ptr<McapFile> file;
  std::unique_ptr<McapSource> source;
  scenegraph::Entry entry;
};

Recorded open(const std::filesystem::path& path) {
  auto file = McapFile::open(path);
  EXPECT_TRUE(file);
  Recorded recorded{.file = std::move(*file), .source = nullptr, .entry = {}};
  std::vector<FoundMessage> found;
  recorded.file->listMessages(0, found);
  recorded.source = std::make_unique<McapSource>(std::vector<std::shared_ptr<const McapFile>>{recorded.file});
  recorded.entry = {.log_time = {5},
                    .payload_bytes = found.at(0).bytes,
                    .locator = *Locator{0, found.at(0).chunk, found.at(0).offset}.pack()};
  return recorded;
}

class EarlyDecode : public testing::TestWithParam<Compression> {};

TEST_P(EarlyDecode, OfALargeCloudIsWhatAllOfItBecomes) {
  const test::TemporaryFile file;
  writeCloud(file.path(), GetParam(), kPoints);
  Recorded recorded;
  std::optional<scenegraph::EarlyObject> early;
  for (int i = 0; i < 50 && !early; ++i) {  // all may be there before one can look
    recorded = open(file.path());
    early = recorded.source->decodeEarly(kTopic, recorded.entry);
  }
  ASSERT_TRUE(early);
  const auto& [mcap, source, entry] = recorded;
  const auto cloud = early->object.get<PointCloud>();
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->width, kPoints);
  ASSERT_NE(cloud->data.arrival, nullptr);
  EXPECT_TRUE(cloud->data.arrival->waitForAll());
  const auto whole = source->decode(kTopic, entry);
  ASSERT_TRUE(whole);
  const auto expected = whole->get<PointCloud>();
  EXPECT_EQ(expected->data.bytes.data(), cloud->data.bytes.data()) << "unpacked once, as long as somebody holds it";
  EXPECT_EQ(expected->data.bytes.size(), cloud->data.bytes.size());
  EXPECT_EQ(expected->data.arrival, nullptr);
  EXPECT_FALSE(source->decodeEarly(kTopic, entry)) << "all of it is there";
}

TEST_P(EarlyDecode, OfADamagedChunkSaysSoAtItsEnd) {
  const test::TemporaryFile file;
  writeCloud(file.path(), GetParam(), kPoints);
  const auto size = open(file.path()).file->chunks()[0].length;
  auto bytes = file.bytes();
  const auto last = open(file.path()).file->chunks()[0].offset + size - 100;  // among the last points
  bytes[last] ^= std::byte{1};
  file.assign(bytes);
  const auto [mcap, source, entry] = open(file.path());
  if (const auto early = source->decodeEarly(kTopic, entry)) {  // its end may be there as soon as its beginning
    EXPECT_FALSE(early->object.get<PointCloud>()->data.arrival->waitForAll());
  }
  const auto whole = source->decode(kTopic, entry);
  ASSERT_FALSE(whole);
  EXPECT_EQ(whole.error().code, "BadChunk");
}

INSTANTIATE_TEST_SUITE_P(Compressions, EarlyDecode,
                         testing::Values(Compression::None, Compression::Lz4, Compression::Zstd));

TEST(EarlyDecode, IsForLargeCloudsThatAreWantedNow) {
  const test::TemporaryFile small;
  writeCloud(small.path(), Compression::Lz4, 1000);
  const auto few = open(small.path());
  EXPECT_FALSE(few.source->decodeEarly(kTopic, few.entry));
  const test::TemporaryFile large;
  writeCloud(large.path(), Compression::Lz4, kPoints);
  const auto many = open(large.path());
  bool is_early = true;
  std::thread([&] {
    scenegraph::standBack(scenegraph::StandBack::Spare);
    is_early = many.source->decodeEarly(kTopic, many.entry).has_value();
  }).join();
  EXPECT_FALSE(is_early);
  EXPECT_FALSE(many.source->decodeEarly(topicOf("/other"), many.entry));
}

}  // namespace
}  // namespace stillframe::ingest
