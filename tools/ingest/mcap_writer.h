#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <expected>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/status.h"
#include "tools/ingest/compression.h"
#include "tools/ingest/mcap_records.h"

namespace stillframe::ingest {

/// What a written file looks like.
struct McapWriterOptions {
  Compression compression = Compression::Zstd;
  std::size_t chunk_bytes = std::size_t{1} << 20;  ///< a chunk is closed when it holds that much; 0: no chunks
  std::string profile = "ros2";
  bool has_message_index = true;
  bool has_summary = true;
  bool has_crc = true;
};

/// Writes a valid MCAP: chunks, message indexes, summary with statistics, CRCs. One thread.
///
/// Memory: one chunk, and a few bytes per chunk for the index. Nothing is complete before finish(); a writer that is
/// destroyed without it leaves a file without a summary. The first failure sticks: every later call returns it.
class McapWriter {
 public:
  using Result = std::expected<void, scenegraph::Status>;

  /// Creates or replaces `path`. Codes: "CannotOpen".
  [[nodiscard]] static std::expected<std::unique_ptr<McapWriter>, scenegraph::Status> open(
      const std::filesystem::path& path, McapWriterOptions options = {});
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// A channel of a topic; equal schemas are written once. An empty `schema_name` makes a channel without a schema.
  /// At most 65535 of each.
  std::uint16_t addChannel(std::string_view topic, std::string_view schema_name, std::string_view schema_encoding,
                           std::string_view schema_text, std::string_view message_encoding);
  /// Adds a message; times are nanoseconds since the epoch, in any order. Codes: "CannotWrite".
  Result write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
               std::span<const std::byte> bytes);
  Result attach(std::string_view name, std::string_view media_type, std::uint64_t log_time,
                std::span<const std::byte> bytes);
  Result addMetadata(std::string_view name, const std::map<std::string, std::string>& metadata);
  /// Writes what is pending, the summary and the footer, and closes the file.
  Result finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct WrittenChunk {
    std::uint64_t start_time, end_time, offset, length, index_length, packed_size, size;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> index_offsets;
  };

  McapWriter(std::unique_ptr<std::FILE, CloseFile> file, std::string path, McapWriterOptions options);
  void put(std::span<const std::byte> bytes);
  void closeChunk();
  void writeSummary();
  [[nodiscard]] Result result() const;

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::string path_;
  McapWriterOptions options_;
  std::string failure_;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;  // of what was put since it was last reset
  std::uint32_t message_sequence_ = 0;
  std::vector<SchemaRecord> schemas_;
  std::vector<ChannelRecord> channels_;
  std::vector<std::uint64_t> channel_counts_;
  std::vector<std::byte> chunk_;
  std::uint64_t chunk_start_ = 0;
  std::uint64_t chunk_end_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_index_;
  std::vector<WrittenChunk> chunks_;
  std::vector<std::byte> attachment_indexes_;  // whole records, as the summary wants them
  std::vector<std::byte> metadata_indexes_;
  std::uint32_t attachments_ = 0;
  std::uint32_t metadata_ = 0;
  std::uint64_t start_time_ = 0;
  std::uint64_t end_time_ = 0;
  std::uint64_t messages_ = 0;
};

}  // namespace stillframe::ingest
