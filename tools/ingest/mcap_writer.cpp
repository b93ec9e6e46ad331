#include "tools/ingest/mcap_writer.h"

#include <algorithm>
#include <cerrno>
#include <concepts>
#include <cstring>

#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

/// One record under construction; bytes() completes its length.
class RecordBuilder {
 public:
  explicit RecordBuilder(Opcode opcode) {
    number(static_cast<std::uint8_t>(opcode));
    number(std::uint64_t{0});
  }
  template <std::integral T>
  RecordBuilder& number(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  RecordBuilder& raw(std::span<const std::byte> bytes) {
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return *this;
  }
  RecordBuilder& string(std::string_view text) {
    return number(static_cast<std::uint32_t>(text.size())).raw(std::as_bytes(std::span(text)));
  }
  template <typename First, typename Second>
  RecordBuilder& pairs(const std::vector<std::pair<First, Second>>& pairs) {
    number(static_cast<std::uint32_t>(pairs.size() * (sizeof(First) + sizeof(Second))));
    for (const auto& [first, second] : pairs) {
      number(first).number(second);
    }
    return *this;
  }
  [[nodiscard]] std::span<const std::byte> content() const {
    return std::as_bytes(std::span(bytes_)).subspan(kRecordHeaderBytes);
  }
  [[nodiscard]] std::span<const std::byte> bytes() {
    const std::uint64_t length = bytes_.size() - kRecordHeaderBytes;
    std::memcpy(bytes_.data() + 1, &length, sizeof(length));
    return std::as_bytes(std::span(bytes_));
  }

 private:
  std::string bytes_;
};

RecordBuilder build(const SchemaRecord& schema) {
  return RecordBuilder(Opcode::Schema)
      .number(schema.id)
      .string(schema.name)
      .string(schema.encoding)
      .string(schema.data);
}

RecordBuilder build(const ChannelRecord& channel) {
  return RecordBuilder(Opcode::Channel)
      .number(channel.id)
      .number(channel.schema_id)
      .string(channel.topic)
      .string(channel.message_encoding)
      .number(std::uint32_t{0});
}

void append(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::expected<std::unique_ptr<McapWriter>, scenegraph::Status> McapWriter::open(const std::filesystem::path& path,
                                                                                McapWriterOptions options) {
  std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "wb"));
  if (file == nullptr) {
    return std::unexpected(scenegraph::Status{scenegraph::StatusLevel::Error, "CannotOpen",
                                              sentence("cannot write '", path.string(), "': ", strerror(errno))});
  }
  std::unique_ptr<McapWriter> writer(new McapWriter(std::move(file), path.string(), std::move(options)));
  writer->put(std::as_bytes(std::span(kMcapMagic)));
  writer->put(RecordBuilder(Opcode::Header).string(writer->options_.profile).string("stillframe").bytes());
  return writer;
}

McapWriter::McapWriter(std::unique_ptr<std::FILE, CloseFile> file, std::string path, McapWriterOptions options)
    : file_(std::move(file)), path_(std::move(path)), options_(std::move(options)) {}

void McapWriter::put(std::span<const std::byte> bytes) {
  if (!failure_.empty() || bytes.empty()) {
    return;
  }
  if (file_ == nullptr || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    failure_ = file_ == nullptr ? "it is finished already" : strerror(errno);
    return;
  }
  position_ += bytes.size();
  crc_ = crc32(bytes, crc_);
}

McapWriter::Result McapWriter::result() const {
  if (failure_.empty()) {
    return {};
  }
  return std::unexpected(scenegraph::Status{scenegraph::StatusLevel::Error, "CannotWrite",
                                            sentence("cannot write '", path_, "': ", failure_)});
}

std::uint16_t McapWriter::addChannel(std::string_view topic, std::string_view schema_name,
                                     std::string_view schema_encoding, std::string_view schema_text,
                                     std::string_view message_encoding) {
  if (channels_.size() == 0xFFFF) {
    failure_ = "it has too many channels";
    return 0;
  }
  std::uint16_t schema_id = 0;
  if (!schema_name.empty()) {
    SchemaRecord schema{0, std::string(schema_name), std::string(schema_encoding), std::string(schema_text)};
    const auto known = std::ranges::find_if(schemas_, [&](const SchemaRecord& other) {
      return other.name == schema.name && other.encoding == schema.encoding && other.data == schema.data;
    });
    schema_id = static_cast<std::uint16_t>(known - schemas_.begin() + 1);
    if (known == schemas_.end()) {
      schema.id = schema_id;
      schemas_.push_back(std::move(schema));
      put(build(schemas_.back()).bytes());
    }
  }
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back({id, schema_id, std::string(topic), std::string(message_encoding)});
  channel_counts_.push_back(0);
  put(build(channels_.back()).bytes());
  return id;
}

McapWriter::Result McapWriter::write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
                                     std::span<const std::byte> bytes) {
  if (channel >= channels_.size()) {
    failure_ = sentence("it has no channel ", channel);
    return result();
  }
  RecordBuilder record(Opcode::Message);
  record.number(channel).number(message_sequence_++).number(log_time).number(publish_time).raw(bytes);
  start_time_ = messages_ == 0 ? log_time : std::min(start_time_, log_time);
  end_time_ = std::max(end_time_, log_time);
  ++messages_;
  ++channel_counts_[channel];
  if (options_.chunk_bytes == 0) {
    put(record.bytes());
    return result();
  }
  if (chunk_.empty()) {
    for (const SchemaRecord& schema : schemas_) {  // a chunk can be read without the summary
      append(chunk_, build(schema).bytes());
    }
    for (const ChannelRecord& known : channels_) {
      append(chunk_, build(known).bytes());
    }
  }
  chunk_start_ = chunk_index_.empty() ? log_time : std::min(chunk_start_, log_time);
  chunk_end_ = chunk_index_.empty() ? log_time : std::max(chunk_end_, log_time);
  chunk_index_[channel].emplace_back(log_time, chunk_.size());
  append(chunk_, record.bytes());
  if (chunk_.size() >= options_.chunk_bytes) {
    closeChunk();
  }
  return result();
}

void McapWriter::closeChunk() {
  if (chunk_.empty()) {
    return;
  }
  const auto packed = compress(options_.compression, chunk_);
  if (!packed) {
    failure_ = packed.error();
    return;
  }
  WrittenChunk chunk{chunk_start_, chunk_end_, position_, 0, 0, packed->size(), chunk_.size(), {}};
  put(RecordBuilder(Opcode::Chunk)
          .number(chunk_start_)
          .number(chunk_end_)
          .number(chunk.size)
          .number(options_.has_crc ? crc32(chunk_) : std::uint32_t{0})
          .string(toString(options_.compression))
          .number(chunk.packed_size)
          .raw(*packed)
          .bytes());
  chunk.length = position_ - chunk.offset;
  if (options_.has_message_index) {
    for (const auto& [channel, entries] : chunk_index_) {
      chunk.index_offsets.emplace_back(channel, position_);
      put(RecordBuilder(Opcode::MessageIndex).number(channel).pairs(entries).bytes());
    }
    chunk.index_length = position_ - chunk.offset - chunk.length;
  }
  chunks_.push_back(std::move(chunk));
  chunk_.clear();
  chunk_index_.clear();
}

McapWriter::Result McapWriter::attach(std::string_view name, std::string_view media_type, std::uint64_t log_time,
                                      std::span<const std::byte> bytes) {
  closeChunk();
  const std::uint64_t offset = position_;
  RecordBuilder record(Opcode::Attachment);
  record.number(log_time).number(log_time).string(name).string(media_type);
  record.number(std::uint64_t{bytes.size()}).raw(bytes);
  record.number(crc32(record.content()));
  put(record.bytes());
  append(attachment_indexes_, RecordBuilder(Opcode::AttachmentIndex)
                                  .number(offset)
                                  .number(position_ - offset)
                                  .number(log_time)
                                  .number(log_time)
                                  .number(std::uint64_t{bytes.size()})
                                  .string(name)
                                  .string(media_type)
                                  .bytes());
  ++attachments_;
  return result();
}

McapWriter::Result McapWriter::addMetadata(std::string_view name, const std::map<std::string, std::string>& metadata) {
  closeChunk();
  const std::uint64_t offset = position_;
  std::uint32_t map_bytes = 0;
  for (const auto& [key, value] : metadata) {
    map_bytes += static_cast<std::uint32_t>(8 + key.size() + value.size());
  }
  RecordBuilder record(Opcode::Metadata);
  record.string(name).number(map_bytes);
  for (const auto& [key, value] : metadata) {
    record.string(key).string(value);
  }
  put(record.bytes());
  append(metadata_indexes_,
         RecordBuilder(Opcode::MetadataIndex).number(offset).number(position_ - offset).string(name).bytes());
  ++metadata_;
  return result();
}

void McapWriter::writeSummary() {
  const std::uint64_t schemas_start = position_;
  std::vector<std::byte> offsets;
  const auto close_group = [&](Opcode opcode, std::uint64_t start) {
    if (position_ > start) {
      append(offsets, RecordBuilder(Opcode::SummaryOffset)
                          .number(static_cast<std::uint8_t>(opcode))
                          .number(start)
                          .number(position_ - start)
                          .bytes());
    }
    return position_;
  };
  for (const SchemaRecord& schema : schemas_) {
    put(build(schema).bytes());
  }
  const std::uint64_t channels_start = close_group(Opcode::Schema, schemas_start);
  for (const ChannelRecord& channel : channels_) {
    put(build(channel).bytes());
  }
  const std::uint64_t statistics_start = close_group(Opcode::Channel, channels_start);
  std::vector<std::pair<std::uint16_t, std::uint64_t>> counts;
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    counts.emplace_back(channels_[channel].id, channel_counts_[channel]);
  }
  put(RecordBuilder(Opcode::Statistics)
          .number(messages_)
          .number(static_cast<std::uint16_t>(schemas_.size()))
          .number(static_cast<std::uint32_t>(channels_.size()))
          .number(attachments_)
          .number(metadata_)
          .number(static_cast<std::uint32_t>(chunks_.size()))
          .number(start_time_)
          .number(end_time_)
          .pairs(counts)
          .bytes());
  const std::uint64_t chunks_start = close_group(Opcode::Statistics, statistics_start);
  for (const WrittenChunk& chunk : chunks_) {
    put(RecordBuilder(Opcode::ChunkIndex)
            .number(chunk.start_time)
            .number(chunk.end_time)
            .number(chunk.offset)
            .number(chunk.length)
            .pairs(chunk.index_offsets)
            .number(chunk.index_length)
            .string(toString(options_.compression))
            .number(chunk.packed_size)
            .number(chunk.size)
            .bytes());
  }
  const std::uint64_t attachments_start = close_group(Opcode::ChunkIndex, chunks_start);
  put(attachment_indexes_);
  const std::uint64_t metadata_start = close_group(Opcode::AttachmentIndex, attachments_start);
  put(metadata_indexes_);
  close_group(Opcode::MetadataIndex, metadata_start);
  put(offsets);
}

McapWriter::Result McapWriter::finish() {
  closeChunk();
  put(RecordBuilder(Opcode::DataEnd).number(std::uint32_t{0}).bytes());
  const std::uint64_t summary_start = position_;
  crc_ = 0;
  if (options_.has_summary) {
    writeSummary();
  }
  RecordBuilder footer(Opcode::Footer);
  footer.number(options_.has_summary ? summary_start : std::uint64_t{0}).number(std::uint64_t{0});
  // The footer's own length and fields belong to the CRC; its last field is the CRC itself.
  RecordBuilder whole_footer = footer;
  whole_footer.number(std::uint32_t{0});
  const std::uint32_t crc = crc32(whole_footer.bytes().first(kFooterBytes - sizeof(std::uint32_t)), crc_);
  footer.number(options_.has_summary && options_.has_crc ? crc : std::uint32_t{0});
  put(footer.bytes());
  put(std::as_bytes(std::span(kMcapMagic)));
  if (failure_.empty() && std::fclose(file_.release()) != 0) {
    failure_ = strerror(errno);
  }
  file_.reset();
  return result();
}

}  // namespace stillframe::ingest
