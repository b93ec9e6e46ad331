#include "tools/ingest/mcap_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>

#include "tests/tools/ingest/temporary_file.h"
#include "tools/ingest/mcap_writer.h"

namespace stillframe::ingest {
namespace {

using test::TemporaryFile;

constexpr std::uint64_t kMessages = 12;

std::vector<std::byte> payload(std::uint64_t i) { return std::vector<std::byte>(20 + i, std::byte(i)); }

void writeFile(const std::filesystem::path& path, const McapWriterOptions& options) {
  auto writer = McapWriter::open(path, options);
  ASSERT_TRUE(writer) << writer.error().message;
  const auto a = (*writer)->addChannel("/a", "pkg/A", "ros2msg", "int32 x", "cdr");
  const auto b = (*writer)->addChannel("/b", "pkg/A", "ros2msg", "int32 x", "cdr");
  for (std::uint64_t i = 0; i < kMessages; ++i) {
    ASSERT_TRUE((*writer)->write(i % 3 == 0 ? b : a, 1000 + i, 1000 + i, payload(i)));
  }
  const std::string text = "attached";
  ASSERT_TRUE((*writer)->attach("note.txt", "text/plain", 5, std::as_bytes(std::span(text))));
  ASSERT_TRUE((*writer)->addMetadata("about", {{"robot", "r2"}, {"run", "7"}}));
  ASSERT_TRUE((*writer)->finish());
}

/// All messages, with their bytes held against what was written. Returns how many there were.
std::size_t checkMessages(McapFile& file) {
  std::vector<FoundMessage> found = file.scannedMessages();
  for (std::size_t chunk = 0; !file.isScanned() && chunk < file.chunks().size(); ++chunk) {
    file.listMessages(chunk, found);
  }
  for (const FoundMessage& message : found) {
    const auto expected = payload(message.log_time - 1000);
    EXPECT_EQ(message.bytes, expected.size());
    EXPECT_EQ(message.channel, (message.log_time - 1000) % 3 == 0 ? 1 : 0);
    if (message.chunk != FoundMessage::kNoChunk) {
      const auto records = file.unpack(message.chunk);
      EXPECT_TRUE(records) << records.error();
      if (records && message.offset + 31 + expected.size() <= records->size) {
        EXPECT_EQ(std::memcmp(records->data.get() + message.offset + 31, expected.data(), expected.size()), 0);
      }
    }
  }
  return found.size();
}

struct Variant {
  const char* name;
  McapWriterOptions options;
};

class McapRoundTrip : public testing::TestWithParam<Variant> {};

TEST_P(McapRoundTrip, ReadsBackWhatWasWritten) {
  const TemporaryFile temporary;
  writeFile(temporary.path(), GetParam().options);
  const auto file = McapFile::open(temporary.path());
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ((*file)->isScanned(), !GetParam().options.has_summary || GetParam().options.chunk_bytes == 0);
  EXPECT_EQ(checkMessages(**file), kMessages);
  EXPECT_EQ((*file)->channels().size(), 2u);
  EXPECT_EQ((*file)->schemas().size(), 1u);
  ASSERT_EQ((*file)->attachments().size(), 1u);
  EXPECT_EQ((*file)->attachments()[0].name, "note.txt");
  EXPECT_EQ((*file)->attachments()[0].data_size, 8u);
  const auto attached = McapFile::readAttachment((*file)->file(), (*file)->attachments()[0]);
  ASSERT_TRUE(attached) << attached.error();
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(attached->data()), attached->size()), "attached");
  EXPECT_THAT((*file)->metadataNames(), testing::ElementsAre("about"));
  EXPECT_TRUE((*file)->problems().take().empty());
}

McapWriterOptions options(Compression compression, std::size_t chunk_bytes, bool has_index, bool has_summary) {
  return {compression, chunk_bytes, "ros2", has_index, has_summary, true};
}

INSTANTIATE_TEST_SUITE_P(Variants, McapRoundTrip,
                         testing::Values(Variant{"zstd", options(Compression::Zstd, 200, true, true)},
                                         Variant{"lz4", options(Compression::Lz4, 200, true, true)},
                                         Variant{"uncompressed", options(Compression::None, 200, true, true)},
                                         Variant{"one_chunk", options(Compression::Zstd, 1 << 20, true, true)},
                                         Variant{"no_message_index", options(Compression::Lz4, 200, false, true)},
                                         Variant{"no_summary", options(Compression::Zstd, 200, true, false)},
                                         Variant{"bare", options(Compression::Zstd, 200, false, false)},
                                         Variant{"unchunked", options(Compression::None, 0, true, true)},
                                         Variant{"unchunked_no_summary", options(Compression::None, 0, true, false)}),
                         [](const auto& variant) { return variant.param.name; });

/// Bytes this process has read from files so far.
std::uint64_t bytesRead() {
  std::ifstream io("/proc/self/io");
  std::string key;
  std::uint64_t value = 0;
  io >> key >> value;
  EXPECT_EQ(key, "rchar:");
  return value;
}

TEST(McapFile, OpeningALargeFileReadsNothingButItsIndex) {
  const TemporaryFile path;
  constexpr std::size_t kChunk = std::size_t{4} << 20;
  constexpr std::uint64_t kChunks = 48;
  {
    auto writer =
        McapWriter::open(path.path(), {.compression = Compression::None, .chunk_bytes = kChunk, .has_crc = false});
    ASSERT_TRUE(writer);
    const auto topic = (*writer)->addChannel("/a", "pkg/A", "ros2msg", "int32 x", "cdr");
    const std::vector<std::byte> bytes(kChunk);
    for (std::uint64_t i = 0; i < kChunks; ++i) {
      ASSERT_TRUE((*writer)->write(topic, i, i, bytes));
    }
    ASSERT_TRUE((*writer)->finish());
  }
  ASSERT_GT(std::filesystem::file_size(path.path()), kChunks * kChunk);
  const std::uint64_t before = bytesRead();
  const auto file = McapFile::open(path.path());
  ASSERT_TRUE(file);
  const std::uint64_t opened = bytesRead();
  EXPECT_EQ((*file)->chunks().size(), kChunks);
  EXPECT_LT(opened - before, 64U << 10);
  std::vector<FoundMessage> found;
  for (std::size_t chunk = 0; chunk < kChunks; ++chunk) {
    (*file)->listMessages(chunk, found);
  }
  EXPECT_EQ(found.size(), kChunks);
  EXPECT_LT(bytesRead() - opened, kChunks * 1024) << "the messages are listed from the indexes of the chunks";
}

TEST(McapWriter, NamesThePathItCannotWrite) {
  const auto writer = McapWriter::open("/nonexistent_folder/out.mcap");
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, "CannotOpen");
  EXPECT_THAT(writer.error().message, testing::HasSubstr("/nonexistent_folder/out.mcap"));
}

TEST(McapWriter, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) {
    GTEST_FAIL() << "/dev/full is part of every Linux";
  }
  const auto writer = McapWriter::open("/dev/full");
  ASSERT_TRUE(writer);
  const auto channel = (*writer)->addChannel("/a", "pkg/A", "ros2msg", "int32 x", "cdr");
  static_cast<void>((*writer)->write(channel, 1, 1, payload(3)));
  const auto finished = (*writer)->finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().code, "CannotWrite");
}

}  // namespace
}  // namespace stillframe::ingest
