#include "tools/ingest/mcap_records.h"

#include "tools/ingest/field_reader.h"

namespace stillframe::ingest {

namespace {

template <typename Record>
std::optional<Record> checked(const FieldReader& reader, Record record) {
  return reader.isGood() ? std::optional<Record>(std::move(record)) : std::nullopt;
}

}  // namespace

std::optional<SchemaRecord> parseSchema(std::span<const std::byte> content) {
  FieldReader reader{content};
  SchemaRecord record;
  record.id = reader.number<std::uint16_t>();
  record.name = reader.string();
  record.encoding = reader.string();
  record.data = reader.string();
  return checked(reader, std::move(record));
}

std::optional<ChannelRecord> parseChannel(std::span<const std::byte> content) {
  FieldReader reader{content};
  ChannelRecord record;
  record.id = reader.number<std::uint16_t>();
  record.schema_id = reader.number<std::uint16_t>();
  record.topic = reader.string();
  record.message_encoding = reader.string();
  static_cast<void>(reader.block());  // metadata
  return checked(reader, std::move(record));
}

std::optional<MessageRecord> parseMessage(std::span<const std::byte> content) {
  FieldReader reader{content};
  MessageRecord record;
  record.channel_id = reader.number<std::uint16_t>();
  record.sequence = reader.number<std::uint32_t>();
  record.log_time = reader.number<std::uint64_t>();
  record.publish_time = reader.number<std::uint64_t>();
  record.data = reader.bytes(reader.left());
  return checked(reader, record);
}

std::optional<ChunkHeader> parseChunkHeader(std::span<const std::byte> content) {
  FieldReader reader{content};
  ChunkHeader header;
  header.start_time = reader.number<std::uint64_t>();
  header.end_time = reader.number<std::uint64_t>();
  header.uncompressed_size = reader.number<std::uint64_t>();
  header.uncompressed_crc = reader.number<std::uint32_t>();
  header.compression = reader.string();
  header.packed_size = reader.number<std::uint64_t>();
  header.header_bytes = reader.position();
  return checked(reader, std::move(header));
}

std::optional<MessageIndexRecord> parseMessageIndex(std::span<const std::byte> content) {
  FieldReader reader{content};
  MessageIndexRecord record;
  record.channel_id = reader.number<std::uint16_t>();
  record.entries = reader.block();
  return checked(reader, record);
}

std::optional<ChunkIndexRecord> parseChunkIndex(std::span<const std::byte> content) {
  FieldReader reader{content};
  ChunkIndexRecord record;
  record.start_time = reader.number<std::uint64_t>();
  record.end_time = reader.number<std::uint64_t>();
  record.chunk_offset = reader.number<std::uint64_t>();
  record.chunk_length = reader.number<std::uint64_t>();
  FieldReader offsets{reader.block()};
  while (offsets.left() > 0 && offsets.isGood()) {
    record.channels.push_back(offsets.number<std::uint16_t>());
    static_cast<void>(offsets.number<std::uint64_t>());
  }
  record.message_index_length = reader.number<std::uint64_t>();
  static_cast<void>(reader.string());                 // compression
  static_cast<void>(reader.number<std::uint64_t>());  // packed size
  record.uncompressed_size = reader.number<std::uint64_t>();
  return offsets.isGood() ? checked(reader, std::move(record)) : std::nullopt;
}

std::optional<AttachmentIndexRecord> parseAttachmentIndex(std::span<const std::byte> content) {
  FieldReader reader{content};
  AttachmentIndexRecord record;
  record.offset = reader.number<std::uint64_t>();
  static_cast<void>(reader.number<std::uint64_t>());  // length
  record.log_time = reader.number<std::uint64_t>();
  static_cast<void>(reader.number<std::uint64_t>());  // create time
  record.data_size = reader.number<std::uint64_t>();
  record.name = reader.string();
  record.media_type = reader.string();
  return checked(reader, std::move(record));
}

std::optional<AttachmentIndexRecord> parseAttachmentHeader(std::span<const std::byte> content) {
  FieldReader reader{content};
  AttachmentIndexRecord record;
  record.log_time = reader.number<std::uint64_t>();
  static_cast<void>(reader.number<std::uint64_t>());  // create time
  record.name = reader.string();
  record.media_type = reader.string();
  record.data_size = reader.number<std::uint64_t>();
  return checked(reader, std::move(record));
}

std::optional<StatisticsRecord> parseStatistics(std::span<const std::byte> content) {
  FieldReader reader{content};
  StatisticsRecord record;
  record.message_count = reader.number<std::uint64_t>();
  static_cast<void>(reader.number<std::uint16_t>());  // schemas
  record.channel_count = reader.number<std::uint32_t>();
  static_cast<void>(reader.number<std::uint32_t>());  // attachments
  static_cast<void>(reader.number<std::uint32_t>());  // metadata
  record.chunk_count = reader.number<std::uint32_t>();
  record.start_time = reader.number<std::uint64_t>();
  record.end_time = reader.number<std::uint64_t>();
  FieldReader counts{reader.block()};
  while (counts.left() > 0 && counts.isGood()) {
    const auto channel = counts.number<std::uint16_t>();
    record.channel_counts.emplace_back(channel, counts.number<std::uint64_t>());
  }
  return counts.isGood() ? checked(reader, std::move(record)) : std::nullopt;
}

std::optional<FooterRecord> parseFooter(std::span<const std::byte> content) {
  FieldReader reader{content};
  FooterRecord record;
  record.summary_start = reader.number<std::uint64_t>();
  static_cast<void>(reader.number<std::uint64_t>());  // summary offsets
  record.summary_crc = reader.number<std::uint32_t>();
  return checked(reader, record);
}

std::optional<std::string> parseMetadataName(std::span<const std::byte> content) {
  FieldReader reader{content};
  std::string name{reader.string()};
  return checked(reader, std::move(name));
}

std::optional<std::string> parseMetadataIndexName(std::span<const std::byte> content) {
  FieldReader reader{content};
  static_cast<void>(reader.number<std::uint64_t>());  // offset
  static_cast<void>(reader.number<std::uint64_t>());  // length
  std::string name{reader.string()};
  return checked(reader, std::move(name));
}

}  // namespace stillframe::ingest
