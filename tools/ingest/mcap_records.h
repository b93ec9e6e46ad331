#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tf/time.h"

namespace stillframe::ingest {

/// The records of the MCAP format (https://mcap.dev/spec), as read from their content.
///
/// A record is an opcode byte, a 64-bit length and that many bytes of content. The parse functions take the content
/// and give nullopt when it is shorter than its fields; bytes after the known fields are allowed, as the format says.
inline constexpr std::array<std::uint8_t, 8> kMcapMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kRecordHeaderBytes = 9;
inline constexpr std::size_t kFooterBytes = kRecordHeaderBytes + 20;
inline constexpr std::size_t kMessageHeaderBytes = 22;

enum class Opcode : std::uint8_t {
  Header = 0x01,
  Footer = 0x02,
  Schema = 0x03,
  Channel = 0x04,
  Message = 0x05,
  Chunk = 0x06,
  MessageIndex = 0x07,
  ChunkIndex = 0x08,
  Attachment = 0x09,
  AttachmentIndex = 0x0A,
  Statistics = 0x0B,
  Metadata = 0x0C,
  MetadataIndex = 0x0D,
  SummaryOffset = 0x0E,
  DataEnd = 0x0F,
};

struct SchemaRecord {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;
  friend bool operator==(const SchemaRecord&, const SchemaRecord&) = default;
};

struct ChannelRecord {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: no schema
  std::string topic;
  std::string message_encoding;
  friend bool operator==(const ChannelRecord&, const ChannelRecord&) = default;
};

/// A message; `data` is a view into the record.
struct MessageRecord {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;
  std::uint64_t publish_time = 0;
  std::span<const std::byte> data;
};

/// The fields of a chunk before its data.
struct ChunkHeader {
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: none
  std::string compression;
  std::uint64_t packed_size = 0;
  std::size_t header_bytes = 0;  ///< from the start of the content to the packed data
};

struct MessageIndexRecord {
  std::uint16_t channel_id = 0;
  std::span<const std::byte> entries;  ///< pairs of (uint64 log time, uint64 offset in the unpacked chunk)
};

struct ChunkIndexRecord {
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::uint64_t chunk_offset = 0;
  std::uint64_t chunk_length = 0;
  std::vector<std::uint16_t> channels;  ///< those that have a message index
  std::uint64_t message_index_length = 0;
  std::uint64_t uncompressed_size = 0;
};

struct AttachmentIndexRecord {
  std::uint64_t offset = 0;  ///< of the attachment's record in the file
  std::uint64_t log_time = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
};

struct StatisticsRecord {
  std::uint64_t message_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channel_counts;
};

struct FooterRecord {
  std::uint64_t summary_start = 0;  ///< 0: no summary
  std::uint32_t summary_crc = 0;    ///< 0: none
};

/// A time of the file, unsigned there; beyond int64 it is taken as the last instant.
[[nodiscard]] constexpr tf::TimePoint toTimePoint(std::uint64_t ns) noexcept {
  constexpr auto kLast = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return {static_cast<std::int64_t>(ns < kLast ? ns : kLast)};
}

[[nodiscard]] std::optional<SchemaRecord> parseSchema(std::span<const std::byte> content);
[[nodiscard]] std::optional<ChannelRecord> parseChannel(std::span<const std::byte> content);
[[nodiscard]] std::optional<MessageRecord> parseMessage(std::span<const std::byte> content);
/// Needs only the beginning of the content: 40 bytes and the name of the compression.
[[nodiscard]] std::optional<ChunkHeader> parseChunkHeader(std::span<const std::byte> content);
[[nodiscard]] std::optional<MessageIndexRecord> parseMessageIndex(std::span<const std::byte> content);
[[nodiscard]] std::optional<ChunkIndexRecord> parseChunkIndex(std::span<const std::byte> content);
[[nodiscard]] std::optional<AttachmentIndexRecord> parseAttachmentIndex(std::span<const std::byte> content);
/// The same facts from the beginning of an attachment itself: its fields before the data.
[[nodiscard]] std::optional<AttachmentIndexRecord> parseAttachmentHeader(std::span<const std::byte> content);
[[nodiscard]] std::optional<StatisticsRecord> parseStatistics(std::span<const std::byte> content);
[[nodiscard]] std::optional<FooterRecord> parseFooter(std::span<const std::byte> content);
/// Name of a metadata record.
[[nodiscard]] std::optional<std::string> parseMetadataName(std::span<const std::byte> content);
/// Name in a metadata index record.
[[nodiscard]] std::optional<std::string> parseMetadataIndexName(std::span<const std::byte> content);

}  // namespace stillframe::ingest
