#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/store/object_store.h"
#include "tools/ingest/buffer_shelf.h"
#include "tools/ingest/chunk_cache.h"
#include "tools/ingest/mcap_file.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest {

/// Where a message is, in the 64 bits of Entry::locator: 1 bit (1: not in a chunk), 10 bits file, then 22 bits chunk
/// and 31 bits offset in it, or 53 bits offset in the file.
struct Locator {
  static constexpr std::uint64_t kMaxFiles = 1u << 10;
  static constexpr std::uint64_t kMaxChunks = 1u << 22;
  static constexpr std::uint64_t kMaxChunkOffset = std::uint64_t{1} << 31;

  std::size_t file = 0;
  std::uint32_t chunk = FoundMessage::kNoChunk;
  std::uint64_t offset = 0;

  /// nullopt for a place that the bits do not hold.
  [[nodiscard]] std::optional<std::uint64_t> pack() const noexcept;
  [[nodiscard]] static Locator unpack(std::uint64_t bits) noexcept;
};

/// Decodes the messages of the files of a recording. Any thread; the files are no longer changed.
class McapSource final : public scenegraph::EntrySource {
 public:
  /// What a channel of a file is decoded with.
  struct Channel {
    std::string topic;
    std::string schema;
    ChannelDecoder decoder;
  };

  explicit McapSource(std::vector<std::shared_ptr<const McapFile>> files);

  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels(std::size_t file) const { return channels_[file]; }
  /// Codes beside those of the decoders: "BadChunk", "BadMessageIndex" (the index points at something else).
  [[nodiscard]] std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const scenegraph::TopicInfo& topic, const scenegraph::Entry& entry) const override;
  /// Of a large message that is most of its chunk, on a thread that does not read ahead.
  [[nodiscard]] std::optional<scenegraph::EarlyObject> decodeEarly(const scenegraph::TopicInfo& topic,
                                                                   const scenegraph::Entry& entry) const override;

 private:
  struct Located {
    std::shared_ptr<const void> anchor;
    std::span<const std::byte> block;   ///< all that the anchor holds
    std::span<const std::byte> record;  ///< from the opcode of the message on
  };
  [[nodiscard]] std::expected<Located, scenegraph::DecodeError> locate(const Locator& place) const;
  struct Message {
    const MessageDecoder* decoder;
    std::span<const std::byte> data;
  };
  /// What a record holds, whose first bytes are there.
  [[nodiscard]] std::expected<Message, scenegraph::DecodeError> parse(std::span<const std::byte> record,
                                                                      const Locator& place,
                                                                      const scenegraph::TopicInfo& topic,
                                                                      const scenegraph::Entry& entry) const;
  [[nodiscard]] std::function<ChunkCache::Chunk(scenegraph::Arrival&)> unpackingOf(const Locator& place) const;
  [[nodiscard]] bool decodesEarly(std::size_t file, const std::string& topic) const;
  void dropIfNobodyElses(const Locator& place, std::size_t message_bytes, std::size_t block_bytes) const;

  std::vector<std::shared_ptr<const McapFile>> files_;
  std::vector<std::map<std::uint16_t, Channel>> channels_;  // per file
  std::shared_ptr<BufferShelf> shelf_ = std::make_shared<BufferShelf>();
  mutable ChunkCache chunks_;
};

}  // namespace stillframe::ingest
