// What a damaged recording does: open or fail with a reason, say what was lost, and never show something else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "scenegraph/objects/frame_transforms.h"
#include "tests/tools/ingest/ros_samples.h"
#include "tests/tools/ingest/temporary_file.h"
#include "tools/ingest/mcap_writer.h"
#include "tools/ingest/recording.h"

namespace stillframe::ingest {
namespace {

using test::TemporaryFile;

constexpr std::int64_t kDamagedMessages = 6;

std::vector<std::byte> recordingBytes(const McapWriterOptions& options) {
  const TemporaryFile file;
  auto writer = *McapWriter::open(file.path(), options);
  const auto tf = writer->addChannel("/tf", "tf2_msgs/msg/TFMessage", "ros2msg", test::tfDefinition(), "cdr");
  const auto cloud =
      writer->addChannel("/points", "sensor_msgs/msg/PointCloud2", "ros2msg", test::kCloudDefinition, "cdr");
  for (std::int64_t i = 0; i < kDamagedMessages; ++i) {
    const auto time = static_cast<std::uint64_t>(1000 + i);
    EXPECT_TRUE(writer->write(tf, time, time, test::tfMessage(1000 + i, "map", "base", static_cast<double>(i))));
    EXPECT_TRUE(writer->write(cloud, time, time, test::cloudMessage(1000 + i, 2)));
  }
  EXPECT_TRUE(writer->finish());
  return file.bytes();
}

McapWriterOptions chunked(Compression compression, bool has_summary = true, std::size_t chunk_bytes = 300) {
  McapWriterOptions options;
  options.compression = compression;
  options.chunk_bytes = chunk_bytes;
  options.has_summary = has_summary;
  return options;
}

struct Outcome {
  bool is_open = false;
  std::string error;
  std::vector<scenegraph::Problem> problems;
  std::size_t transforms = 0;
  std::size_t failures = 0;
};

/// Opens, loads and decodes everything; what decodes must be what was written at that time.
Outcome readAll(const TemporaryFile& file) {
  Outcome outcome;
  const std::filesystem::path path = file.path();
  auto recording = Recording::open(std::span(&path, 1));
  if (!recording) {
    outcome.error = recording.error().code;
    EXPECT_THAT(recording.error().message, testing::HasSubstr(path.string()));
    return outcome;
  }
  outcome.is_open = true;
  (*recording)->load();
  static_cast<void>((*recording)->topics());
  const auto& store = (*recording)->dataset()->store();
  for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
    for (std::size_t i = 0; i < store.entryCount(topic); ++i) {
      const auto entry = store.at(topic, i);
      const auto object = store.decode(topic, *entry);
      if (!object) {
        ++outcome.failures;
        EXPECT_FALSE(object.error().code.empty());
        EXPECT_FALSE(object.error().message.empty());
      } else if (const auto transforms = object->get<scenegraph::FrameTransforms>()) {
        outcome.transforms += transforms->transforms.size();
      }
    }
  }
  outcome.problems = (*recording)->dataset()->problems();
  return outcome;
}

std::vector<std::string> codes(const Outcome& outcome) {
  std::vector<std::string> all;
  for (const auto& problem : outcome.problems) {
    all.push_back(problem.code);
  }
  return all;
}

/// Index of the first record of that kind outside of chunks.
std::size_t findRecord(const std::vector<std::byte>& bytes, Opcode opcode) {
  for (std::size_t offset = kMcapMagic.size(); offset + kRecordHeaderBytes <= bytes.size();) {
    if (bytes[offset] == static_cast<std::byte>(opcode)) {
      return offset;
    }
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + offset + 1, sizeof(length));
    offset += kRecordHeaderBytes + static_cast<std::size_t>(length);
  }
  ADD_FAILURE() << "no such record";
  return 0;
}

template <typename T>
void patch(std::vector<std::byte>& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(value));
}

class Damage : public testing::TestWithParam<const char*> {
 protected:
  static std::vector<std::byte> original() {
    const std::string name = GetParam();
    if (name == "unchunked") {
      McapWriterOptions options;
      options.chunk_bytes = 0;
      return recordingBytes(options);
    }
    return recordingBytes(chunked(name == "lz4"     ? Compression::Lz4
                                  : name == "plain" ? Compression::None
                                                    : Compression::Zstd,
                                  name != "no_summary", 2600));
  }
};

TEST_P(Damage, TheWholeFileIsSound) {
  const TemporaryFile file;
  file.assign(original());
  const Outcome outcome = readAll(file);
  EXPECT_TRUE(outcome.is_open);
  EXPECT_EQ(outcome.transforms, static_cast<std::size_t>(kDamagedMessages));
  EXPECT_EQ(outcome.failures, 0u);
  EXPECT_THAT(codes(outcome), testing::IsEmpty());
}

TEST_P(Damage, EveryPrefixOpensAsTruncatedOrIsNoMcap) {
  const auto bytes = original();
  const TemporaryFile file;
  file.assign(bytes);
  auto before = static_cast<std::size_t>(kDamagedMessages);
  for (std::size_t size = bytes.size(); size-- > 0;) {
    SCOPED_TRACE(size);
    std::filesystem::resize_file(file.path(), size);
    const Outcome outcome = readAll(file);
    if (size < kMcapMagic.size()) {
      EXPECT_EQ(outcome.error, "NotMcap");
      continue;
    }
    ASSERT_TRUE(outcome.is_open);
    EXPECT_THAT(codes(outcome), testing::Contains("Truncated"));
    EXPECT_EQ(outcome.failures, 0u);
    EXPECT_LE(outcome.transforms, before) << "less of the file must not give more";
    EXPECT_TRUE(size + 1 < bytes.size() || outcome.transforms == before) << "all messages are there";
    before = outcome.transforms;
  }
  EXPECT_EQ(before, 0u);
}

TEST_P(Damage, NoWrongByteGoesUnnoticedInATransform) {
  const auto bytes = original();
  const TemporaryFile file;
  file.assign(bytes);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    SCOPED_TRACE(at);
    file.replace(at, bytes[at] ^ std::byte(at % 2 == 0 ? 0x01 : 0xFF));
    const Outcome outcome = readAll(file);
    file.replace(at, bytes[at]);
    EXPECT_EQ(outcome.is_open, at >= kMcapMagic.size());
    EXPECT_LE(outcome.transforms, static_cast<std::size_t>(kDamagedMessages));
    if (outcome.is_open && outcome.transforms < static_cast<std::size_t>(kDamagedMessages)) {
      EXPECT_TRUE(outcome.failures > 0 || !outcome.problems.empty() || GetParam() == std::string("unchunked"))
          << "lost without a word";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, Damage, testing::Values("zstd", "lz4", "plain", "no_summary", "unchunked"),
                         [](const auto& variant) { return std::string(variant.param); });

TEST(DamagedChunk, AWrongCrcLosesOnlyThatChunkAndSaysWhere) {
  auto bytes = recordingBytes(chunked(Compression::None));
  const std::size_t chunk = findRecord(bytes, Opcode::Chunk);
  bytes[chunk + 400] ^= std::byte{1};
  const TemporaryFile file;
  file.assign(bytes);
  const Outcome outcome = readAll(file);
  EXPECT_GT(outcome.failures, 0u);
  EXPECT_GT(outcome.transforms, 0u);
  ASSERT_FALSE(outcome.problems.empty());
  EXPECT_THAT(outcome.problems[0].message, testing::HasSubstr("byte " + std::to_string(chunk)));
  EXPECT_THAT(outcome.problems[0].message, testing::HasSubstr("CRC"));
}

TEST(DamagedChunk, AClaimOfTwoToTheSixtyIsRefused) {
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    for (const bool has_summary : {true, false}) {
      auto bytes = recordingBytes(chunked(compression, has_summary));
      patch(bytes, findRecord(bytes, Opcode::Chunk) + kRecordHeaderBytes + 16, std::uint64_t{1} << 60);
      const TemporaryFile file;
      file.assign(bytes);
      const Outcome outcome = readAll(file);
      EXPECT_TRUE(outcome.is_open);
      EXPECT_GT(outcome.transforms, 0u) << "the other chunks";
      ASSERT_FALSE(outcome.problems.empty());
      EXPECT_THAT(outcome.problems[0].message, testing::HasSubstr("1152921504606846976"));
    }
  }
}

TEST(DamagedChunk, AnUnknownCompressionIsNamed) {
  auto bytes = recordingBytes(chunked(Compression::Zstd, false));
  bytes[findRecord(bytes, Opcode::Chunk) + kRecordHeaderBytes + 32] = std::byte{'x'};
  const TemporaryFile file;
  file.assign(bytes);
  const Outcome outcome = readAll(file);
  ASSERT_FALSE(outcome.problems.empty());
  EXPECT_EQ(outcome.problems[0].code, "BadChunk");
  EXPECT_THAT(outcome.problems[0].message, testing::HasSubstr("xstd"));
}

TEST(DamagedIndex, AMessageIndexThatPointsElsewhereShowsNothingElse) {
  auto bytes = recordingBytes(chunked(Compression::None));
  const std::size_t index = findRecord(bytes, Opcode::MessageIndex);
  patch(bytes, index + kRecordHeaderBytes + 6, std::uint64_t{99999});  // the log time of its first message
  const TemporaryFile file;
  file.assign(bytes);
  const Outcome outcome = readAll(file);
  EXPECT_EQ(outcome.failures, 1u);
  EXPECT_EQ(outcome.transforms, static_cast<std::size_t>(kDamagedMessages) - 1);
}

TEST(DamagedSummary, IsScannedAround) {
  auto bytes = recordingBytes(chunked(Compression::Zstd));
  bytes[findRecord(bytes, Opcode::DataEnd) + 40] ^= std::byte{1};
  const TemporaryFile file;
  file.assign(bytes);
  const Outcome outcome = readAll(file);
  EXPECT_EQ(outcome.transforms, static_cast<std::size_t>(kDamagedMessages));
  EXPECT_THAT(codes(outcome), testing::Contains("BadSummary"));
}

TEST(OpenRecording, NamesWhatCannotBeOpened) {
  const auto code = [](const std::filesystem::path& path) {
    const auto recording = Recording::open(std::span(&path, 1));
    return recording ? "" : recording.error().code;
  };
  EXPECT_EQ(code("/nonexistent.mcap"), "CannotOpen");
  EXPECT_EQ(code(testing::TempDir()), "CannotOpen");
  EXPECT_EQ(code("/dev/zero"), "CannotOpen");
  const TemporaryFile text("notes.txt");
  const std::string content = "this is not an MCAP file at all";
  text.assign(std::as_bytes(std::span(content)));
  EXPECT_EQ(code(text.path()), "NotMcap");
  for (const auto& [begin, hint] : {std::pair<std::string, std::string>{"#ROSBAG V2.0\n", "'mcap convert "},
                                    {"SQLite format 3", "'ros2 bag convert'"},
                                    {"<?xml version='1.0'?>", "--robot"}}) {
    const TemporaryFile other("other");
    other.assign(std::as_bytes(std::span(begin)));
    const std::filesystem::path path = other.path();
    EXPECT_THAT(Recording::open(std::span(&path, 1)).error().message, testing::HasSubstr(hint));
  }
}

TEST(OpenRecording, MergesThePartsOfASplitRecording) {
  const TemporaryFile first;
  const TemporaryFile second;
  first.assign(recordingBytes(chunked(Compression::Zstd)));
  second.assign(recordingBytes(chunked(Compression::Lz4)));
  const std::filesystem::path parts[] = {first.path(), second.path()};
  auto recording = Recording::open(parts);
  ASSERT_TRUE(recording);
  (*recording)->load();
  const auto topics = (*recording)->topics();
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[1].name, "/tf");
  EXPECT_EQ(topics[1].count, 2u * kDamagedMessages);
  const auto& store = (*recording)->dataset()->store();
  EXPECT_EQ(store.entryCount(*store.findTopic("/points")), 2u * kDamagedMessages);
}

TEST(OpenRecording, KnowsTimesAndTopicsBeforeLoading) {
  const TemporaryFile file;
  file.assign(recordingBytes(chunked(Compression::Zstd)));
  const std::filesystem::path path = file.path();
  const auto recording = Recording::open(std::span(&path, 1));
  ASSERT_TRUE(recording);
  const auto range = (*recording)->dataset()->timeRange();
  ASSERT_TRUE(range);
  EXPECT_EQ(range->first.ns, 1000);
  EXPECT_EQ(range->second.ns, 1000 + kDamagedMessages - 1);
  const auto topics = (*recording)->topics();
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[0].count, static_cast<std::uint64_t>(kDamagedMessages));
}

TEST(OpenRecording, LoadingCanStopAndGoOn) {
  const TemporaryFile file;
  file.assign(recordingBytes(chunked(Compression::Zstd)));
  const std::filesystem::path path = file.path();
  const auto recording = Recording::open(std::span(&path, 1));
  ASSERT_TRUE(recording);
  (*recording)->load([](double) { return false; });
  (*recording)->load();
  const auto& transforms = *(*recording)->dataset()->transforms();
  const auto base = transforms.findFrame("base");
  ASSERT_TRUE(base);
  EXPECT_EQ(transforms.edge(*base)->samples, static_cast<std::size_t>(kDamagedMessages));
  EXPECT_EQ((*recording)->topics()[1].count, static_cast<std::uint64_t>(kDamagedMessages));
}

}  // namespace
}  // namespace stillframe::ingest
