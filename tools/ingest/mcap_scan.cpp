// The part of McapFile that reads a file without a usable summary, from the front as far as it goes.
#include <algorithm>

#include "tools/ingest/field_reader.h"
#include "tools/ingest/mcap_file.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

constexpr std::uint64_t kMaxDefinitionBytes = std::uint64_t{64} << 20;  // of a schema or channel record

}  // namespace

void McapFile::scan() {
  is_scanned_ = true;
  ForwardReader reader(*file_);
  const std::uint64_t size = file_->size();
  std::uint64_t offset = kMcapMagic.size();
  bool has_footer = false;
  while (!has_footer && offset < size) {
    FieldReader header(reader.view(offset, kRecordHeaderBytes));
    const auto opcode = header.number<std::uint8_t>();
    const auto length = header.number<std::uint64_t>();
    if (!header.isGood()) {
      break;
    }
    if (opcode == 0) {
      problems_.add("BadRecord", sentence("the record at byte ", offset, " of '", file_->path(),
                                          "' has no valid type; nothing behind it was read"));
      return;
    }
    const std::uint64_t there = std::min(length, size - offset - kRecordHeaderBytes);
    const auto content = [&](std::uint64_t bytes) {
      return reader.view(offset + kRecordHeaderBytes, std::min(bytes, there));
    };
    if (there < length) {
      if (opcode == static_cast<std::uint8_t>(Opcode::Chunk)) {
        scanChunk(offset, length, there);
      }
      break;
    }
    switch (static_cast<Opcode>(opcode)) {
      case Opcode::Schema:
        addSchema(content(kMaxDefinitionBytes));
        break;
      case Opcode::Channel:
        addChannel(content(kMaxDefinitionBytes));
        break;
      case Opcode::Message:
        if (const auto message = parseMessage(content(kMessageHeaderBytes))) {
          index_.messages.push_back(
              {message->log_time, offset, length - kMessageHeaderBytes, FoundMessage::kNoChunk, message->channel_id});
        } else {
          problems_.add("BadRecord", sentence("the message at byte ", offset, " of '", file_->path(), "' has only ",
                                              length, " bytes"));
        }
        break;
      case Opcode::Chunk:
        scanChunk(offset, length, there);
        break;
      case Opcode::Attachment:
        if (auto attachment = parseAttachmentHeader(content(kMaxDefinitionBytes > there ? there : 4096))) {
          attachment->offset = offset;
          index_.attachments.push_back(*std::move(attachment));
        }
        break;
      case Opcode::Metadata:
        if (auto name = parseMetadataName(content(kMaxDefinitionBytes))) {
          index_.metadata_names.push_back(*std::move(name));
        }
        break;
      case Opcode::MessageIndex:
        if (const auto index = parseMessageIndex(content(kMaxDefinitionBytes));
            !index || index->entries.size() + 6 != length) {
          problems_.add("BadRecord",
                        sentence("the message index at byte ", offset, " of '", file_->path(), "' is damaged"));
        }
        break;
      case Opcode::Footer:
        has_footer = true;
        break;
      default:
        if (opcode > static_cast<std::uint8_t>(Opcode::DataEnd)) {
          problems_.add("UnknownRecord", sentence("the record at byte ", offset, " of '", file_->path(),
                                                  "' is of an unknown type ", unsigned{opcode}, "; it was skipped"));
        }
        break;
    }
    offset += kRecordHeaderBytes + length;
  }
  if (!has_footer || size - offset < kMcapMagic.size()) {
    problems_.add("Truncated", sentence("'", file_->path(), "' is cut off: a record at byte ", offset,
                                        " is not complete at its ", size, " bytes; what is there was read"));
  }
}

void McapFile::scanChunk(std::uint64_t offset, std::uint64_t length, std::uint64_t there) {
  ChunkPlace place;
  place.offset = offset;
  place.length = kRecordHeaderBytes + there;
  place.is_cut = there < length;
  const auto records = unpack(place, {});
  if (!records) {
    problems_.add("BadChunk", records.error());
    return;
  }
  place.size = records->size;
  index_.chunks.push_back(std::move(place));
  scanRecords(records->bytes(), static_cast<std::uint32_t>(index_.chunks.size() - 1), index_.messages);
}

void McapFile::scanRecords(std::span<const std::byte> records, std::uint32_t chunk, std::vector<FoundMessage>& out) {
  FieldReader reader(records);
  while (reader.left() > 0) {
    const std::uint64_t offset = reader.position();
    const auto opcode = reader.number<std::uint8_t>();
    const auto length = reader.number<std::uint64_t>();
    const auto content = reader.bytes(length);
    if (!reader.isGood()) {
      if (!index_.chunks[chunk].is_cut) {
        problems_.add("BadChunk", sentence("the chunk at byte ", index_.chunks[chunk].offset, " of '", file_->path(),
                                           "' holds a record of ", length, " bytes that reaches past its end"));
      }
      return;
    }
    switch (static_cast<Opcode>(opcode)) {
      case Opcode::Schema:
        addSchema(content);
        break;
      case Opcode::Channel:
        addChannel(content);
        break;
      case Opcode::Message:
        if (const auto message = parseMessage(content)) {
          out.push_back({message->log_time, offset, message->data.size(), chunk, message->channel_id});
        } else {
          problems_.add("BadRecord", sentence("a message in the chunk at byte ", index_.chunks[chunk].offset, " of '",
                                              file_->path(), "' has only ", length, " bytes"));
        }
        break;
      default:
        break;
    }
  }
}

void McapFile::addSchema(std::span<const std::byte> content) {
  auto schema = parseSchema(content);
  if (!schema || schema->id == 0) {
    problems_.add("BadSchema", sentence("a schema record of '", file_->path(), "' is damaged or has the id 0"));
    return;
  }
  const auto [known, is_new] = index_.schemas.try_emplace(schema->id, *schema);
  if (!is_new && known->second != *schema) {
    problems_.add("SchemaRedefined", sentence("the schema id ", schema->id, " of '", file_->path(), "' is both '",
                                              known->second.name, "' and '", schema->name, "'; the first is used"));
  }
}

void McapFile::addChannel(std::span<const std::byte> content) {
  auto channel = parseChannel(content);
  if (!channel) {
    problems_.add("BadChannel", sentence("a channel record of '", file_->path(), "' is damaged"));
    return;
  }
  const auto [known, is_new] = index_.channels.try_emplace(channel->id, *channel);
  if (!is_new && known->second != *channel) {
    problems_.add("ChannelRedefined", sentence("the channel id ", channel->id, " of '", file_->path(), "' is both '",
                                               known->second.topic, "' and '", channel->topic, "'; the first is used"));
  }
}

std::expected<std::vector<std::byte>, std::string> McapFile::readAttachment(const File& file,
                                                                            const AttachmentIndexRecord& attachment) {
  constexpr std::uint64_t kRecordHead = 1 + sizeof(std::uint64_t);  // opcode, length
  // Times, the lengths of two texts, the length of the data.
  const std::uint64_t head = kRecordHead + 3 * sizeof(std::uint64_t) + 2 * sizeof(std::uint32_t) +
                             attachment.name.size() + attachment.media_type.size();
  std::byte opcode{};
  const bool is_there = attachment.offset < file.size() && head <= file.size() - attachment.offset &&
                        attachment.data_size <= file.size() - attachment.offset - head &&
                        file.read(attachment.offset, std::span(&opcode, 1)) == 1 &&
                        opcode == static_cast<std::byte>(Opcode::Attachment);
  if (!is_there) {
    return std::unexpected(sentence("'", file.path(), "' does not hold it at byte ", attachment.offset));
  }
  std::vector<std::byte> bytes(attachment.data_size);
  if (file.read(attachment.offset + head, bytes) != bytes.size()) {
    return std::unexpected(sentence("'", file.path(), "' ends within it"));
  }
  return bytes;
}

}  // namespace stillframe::ingest
