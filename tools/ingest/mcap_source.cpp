#include "tools/ingest/mcap_source.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "scenegraph/store/large_pages.h"
#include "scenegraph/thread_priority.h"
#include "tools/ingest/field_reader.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

constexpr std::size_t kCachedChunkBytes = std::size_t{128} << 20;
constexpr std::size_t kLargeMessage = std::size_t{8} << 20;

std::uint64_t chunkKey(const Locator& place) { return std::uint64_t{place.file} << 32 | place.chunk; }

scenegraph::DecodeError misplaced(const Locator& place, const std::string& path, const char* why) {
  return {"BadMessageIndex",
          sentence("the index of '", path, "' points at offset ", place.offset, ", where there is ", why)};
}

}  // namespace

std::optional<std::uint64_t> Locator::pack() const noexcept {
  if (file >= kMaxFiles) {
    return std::nullopt;
  }
  if (chunk == FoundMessage::kNoChunk) {
    return offset >> 53 == 0 ? std::optional(std::uint64_t{1} << 63 | std::uint64_t{file} << 53 | offset)
                             : std::nullopt;
  }
  if (chunk >= kMaxChunks || offset >= kMaxChunkOffset) {
    return std::nullopt;
  }
  return std::uint64_t{file} << 53 | std::uint64_t{chunk} << 31 | offset;
}

Locator Locator::unpack(std::uint64_t bits) noexcept {
  const auto file = static_cast<std::size_t>(bits >> 53 & (kMaxFiles - 1));
  if (bits >> 63 != 0) {
    return {file, FoundMessage::kNoChunk, bits & ((std::uint64_t{1} << 53) - 1)};
  }
  return {file, static_cast<std::uint32_t>(bits >> 31 & (kMaxChunks - 1)), bits & (kMaxChunkOffset - 1)};
}

McapSource::McapSource(std::vector<std::shared_ptr<const McapFile>> files)
    : files_(std::move(files)), chunks_(kCachedChunkBytes) {
  for (const auto& file : files_) {
    // Channels share the decoders of their schema.
    std::map<std::tuple<std::uint16_t, std::string, std::string>, ChannelDecoder> decoders;
    auto& channels = channels_.emplace_back();
    for (const auto& [id, channel] : file->channels()) {
      const auto schema = file->schemas().find(channel.schema_id);
      const SchemaRecord* known = schema == file->schemas().end() ? nullptr : &schema->second;
      const std::string topic = known != nullptr && dependsOnTopic(*known) ? channel.topic : "";
      const auto [decoder, is_new] = decoders.try_emplace({channel.schema_id, channel.message_encoding, topic});
      if (is_new) {
        decoder->second = makeDecoder(known, channel.message_encoding, topic);
      }
      channels[id] = {channel.topic, known == nullptr ? "" : known->name, decoder->second};
    }
  }
}

std::function<ChunkCache::Chunk(scenegraph::Arrival&)> McapSource::unpackingOf(const Locator& place) const {
  return [file = files_[place.file], chunk = place.chunk, shelf = shelf_](scenegraph::Arrival& arrival) {
    return file->unpack(chunk, {.pause = &scenegraph::giveWay, .arrival = &arrival, .room = [&](std::size_t size) {
                                  return shelf->take(size);
                                }});
  };
}

std::expected<McapSource::Located, scenegraph::DecodeError> McapSource::locate(const Locator& place) const {
  const McapFile& file = *files_[place.file];
  if (place.chunk == FoundMessage::kNoChunk) {
    std::array<std::byte, kRecordHeaderBytes> head{};
    if (file.file().read(place.offset, head) != head.size()) {
      return std::unexpected(misplaced(place, file.file().path(), "the end of the file"));
    }
    FieldReader reader(head);
    static_cast<void>(reader.number<std::uint8_t>());
    const auto length = reader.number<std::uint64_t>();
    if (length > file.file().size() - place.offset - kRecordHeaderBytes) {
      return std::unexpected(misplaced(place, file.file().path(), "a record that reaches past the end"));
    }
    const auto bytes = static_cast<std::size_t>(kRecordHeaderBytes + length);
    auto record = std::make_shared_for_overwrite<std::byte[]>(bytes);
    scenegraph::useLargePages(record.get(), bytes);
    if (file.file().read(place.offset, {record.get(), bytes}) != bytes) {
      return std::unexpected(misplaced(place, file.file().path(), "the end of the file"));
    }
    const std::span<const std::byte> view(record.get(), bytes);
    return Located{std::move(record), view, view};
  }
  if (place.chunk >= file.chunks().size()) {
    return std::unexpected(misplaced(place, file.file().path(), "no chunk"));
  }
  auto chunk = chunks_.get(chunkKey(place), unpackingOf(place));
  if (!*chunk) {
    return std::unexpected(scenegraph::DecodeError{"BadChunk", chunk->error()});
  }
  const auto records = (*chunk)->bytes();
  if (place.offset >= records.size()) {
    return std::unexpected(misplaced(place, file.file().path(), "the end of the chunk"));
  }
  return Located{std::move(chunk), records, records.subspan(static_cast<std::size_t>(place.offset))};
}

std::expected<McapSource::Message, scenegraph::DecodeError> McapSource::parse(std::span<const std::byte> record,
                                                                              const Locator& place,
                                                                              const scenegraph::TopicInfo& topic,
                                                                              const scenegraph::Entry& entry) const {
  const std::string& path = files_[place.file]->file().path();
  FieldReader reader(record);
  const auto opcode = reader.number<std::uint8_t>();
  const auto message = parseMessage(reader.bytes(reader.number<std::uint64_t>()));
  if (!reader.isGood() || opcode != static_cast<std::uint8_t>(Opcode::Message) || !message) {
    return std::unexpected(misplaced(place, path, "no message"));
  }
  const auto channel = channels_[place.file].find(message->channel_id);
  if (channel == channels_[place.file].end() || channel->second.topic != topic.name) {
    return std::unexpected(misplaced(place, path, "a message of another topic"));
  }
  if (toTimePoint(message->log_time) != entry.log_time) {
    return std::unexpected(misplaced(place, path, "a message of another time"));
  }
  if (channel->second.decoder.decoder == nullptr) {
    return std::unexpected(scenegraph::DecodeError{"Unsupported", channel->second.decoder.unsupported_reason});
  }
  return Message{channel->second.decoder.decoder.get(), message->data};
}

/// A chunk of one large message, a cloud's, serves nobody but who reads that again; it is as large as a whole cache.
void McapSource::dropIfNobodyElses(const Locator& place, std::size_t message_bytes, std::size_t block_bytes) const {
  if (place.chunk != FoundMessage::kNoChunk && message_bytes > std::max(block_bytes / 2, kLargeMessage)) {
    chunks_.drop(chunkKey(place));
  }
}

std::expected<scenegraph::AnyObject, scenegraph::DecodeError> McapSource::decode(const scenegraph::TopicInfo& topic,
                                                                                 const scenegraph::Entry& entry) const {
  const Locator place = Locator::unpack(entry.locator);
  if (place.file >= files_.size()) {
    return std::unexpected(scenegraph::DecodeError{"BadMessageIndex", "the entry is not of this recording"});
  }
  auto located = locate(place);
  if (!located) {
    return std::unexpected(std::move(located).error());
  }
  const auto message = parse(located->record, place, topic, entry);
  if (!message) {
    return std::unexpected(message.error());
  }
  dropIfNobodyElses(place, message->data.size(), located->block.size());
  return message->decoder->decode({message->data, std::move(located->anchor), located->block.size(), entry.log_time});
}

bool McapSource::decodesEarly(std::size_t file, const std::string& topic) const {
  return std::ranges::any_of(channels_[file], [&](const auto& channel) {
    const auto& decoder = channel.second.decoder.decoder;
    return channel.second.topic == topic && decoder != nullptr && decoder->decodesEarly();
  });
}

std::optional<scenegraph::EarlyObject> McapSource::decodeEarly(const scenegraph::TopicInfo& topic,
                                                               const scenegraph::Entry& entry) const {
  constexpr std::size_t kHead = std::size_t{64} << 10;  // bytes: what lies before the points, and more
  const Locator place = Locator::unpack(entry.locator);
  if (scenegraph::isSpare() || place.file >= files_.size() || entry.payload_bytes < kLargeMessage ||
      place.chunk >= files_[place.file]->chunks().size() ||
      entry.payload_bytes < files_[place.file]->chunks()[place.chunk].size / 2 ||
      !decodesEarly(place.file, topic.name)) {
    return std::nullopt;
  }
  auto early = chunks_.getEarly(chunkKey(place), unpackingOf(place));
  const auto block = early ? early->arrival->block() : std::nullopt;
  if (!block || place.offset >= block->bytes.size()) {
    return std::nullopt;
  }
  const auto offset = static_cast<std::size_t>(place.offset);
  const auto there = early->arrival->wait(std::min(offset + kHead, block->bytes.size()));
  const auto message = there ? parse(block->bytes.subspan(offset), place, topic, entry)
                             : std::expected<Message, scenegraph::DecodeError>(std::unexpect);
  if (!message) {
    return std::nullopt;
  }
  const auto data_at = static_cast<std::size_t>(message->data.data() - block->bytes.data());
  // The chunk is found by others as long as somebody holds the arrival, which has it; the bytes outlive a failure.
  using Held = std::pair<std::shared_ptr<const void>, std::shared_ptr<const void>>;
  auto object = message->decoder->decodeEarly({.data = message->data,
                                               .anchor = std::make_shared<const Held>(early->arrival, block->owner),
                                               .anchored_bytes = block->bytes.size(),
                                               .log_time = entry.log_time,
                                               .arrival = early->arrival,
                                               .place = data_at},
                                              *there - std::min(*there, data_at));
  if (!object) {
    return std::nullopt;
  }
  dropIfNobodyElses(place, message->data.size(), block->bytes.size());
  return scenegraph::EarlyObject{*std::move(object), std::move(early->writer)};
}

}  // namespace stillframe::ingest
