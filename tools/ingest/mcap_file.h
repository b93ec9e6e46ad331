#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/objects/arrival.h"
#include "scenegraph/status.h"
#include "tools/ingest/compression.h"
#include "tools/ingest/file.h"
#include "tools/ingest/mcap_records.h"
#include "tools/ingest/problem_log.h"

namespace stillframe::ingest {

/// Where a chunk lies in its file.
struct ChunkPlace {
  std::uint64_t offset = 0;                ///< of the record, its opcode
  std::uint64_t length = 0;                ///< of the record, opcode and length included
  std::uint64_t message_index_length = 0;  ///< of the message indexes behind it; 0: none
  std::uint64_t size = 0;                  ///< unpacked, as the index claims
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::vector<std::uint16_t> channels;
  bool is_cut = false;  ///< the file ends within it: its beginning can be read
};

/// Where a message lies in its file.
struct FoundMessage {
  static constexpr std::uint32_t kNoChunk = ~std::uint32_t{0};
  std::uint64_t log_time = 0;
  std::uint64_t offset = 0;  ///< of its record: in the unpacked chunk, or in the file when `chunk` is kNoChunk
  std::uint64_t bytes = 0;   ///< of its data; known from an index it may count the records behind it too
  std::uint32_t chunk = kNoChunk;
  std::uint16_t channel = 0;
};

/// One MCAP file: its summary, where its chunks and messages are, and their bytes.
///
/// open() reads the summary only; a file without a usable one is scanned from the front, chunk by chunk, as far as it
/// goes. Every size is held against the bytes that are there before memory is taken. unpack() may be called from any
/// thread; the rest belongs to one.
class McapFile {
 public:
  /// Codes: "CannotOpen", "NotMcap". Damage further in is a problem instead.
  [[nodiscard]] static std::expected<std::unique_ptr<McapFile>, scenegraph::Status> open(
      const std::filesystem::path& path);

  [[nodiscard]] const File& file() const noexcept { return *file_; }
  [[nodiscard]] const std::map<std::uint16_t, SchemaRecord>& schemas() const noexcept { return index_.schemas; }
  [[nodiscard]] const std::map<std::uint16_t, ChannelRecord>& channels() const noexcept { return index_.channels; }
  /// In file order, not overlapping.
  [[nodiscard]] const std::vector<ChunkPlace>& chunks() const noexcept { return index_.chunks; }
  [[nodiscard]] const std::optional<StatisticsRecord>& statistics() const noexcept { return index_.statistics; }
  [[nodiscard]] const std::vector<AttachmentIndexRecord>& attachments() const noexcept { return index_.attachments; }
  /// The bytes of an attachment of this file. The error is one sentence. Any thread.
  [[nodiscard]] static std::expected<std::vector<std::byte>, std::string> readAttachment(
      const File& file, const AttachmentIndexRecord& attachment);
  /// What keeps the file open for those who read it later.
  [[nodiscard]] const std::shared_ptr<const File>& sharedFile() const noexcept { return file_; }
  [[nodiscard]] const std::vector<std::string>& metadataNames() const noexcept { return index_.metadata_names; }
  /// Whether open() had to scan: then scannedMessages() holds every message.
  [[nodiscard]] bool isScanned() const noexcept { return is_scanned_; }
  [[nodiscard]] const std::vector<FoundMessage>& scannedMessages() const noexcept { return index_.messages; }
  [[nodiscard]] ProblemLog& problems() noexcept { return problems_; }

  /// Appends the messages of a chunk in the order of their offsets: from its message indexes in one read, or by
  /// unpacking it when it has none or they are damaged. Not for a scanned file.
  void listMessages(std::size_t chunk, std::vector<FoundMessage>& out);
  /// How a chunk is unpacked.
  struct Unpack {
    std::function<void()> pause = [] {};                    ///< called every fraction of a millisecond
    scenegraph::Arrival* arrival = nullptr;                 ///< is told of the records as they come, not of their end
    std::function<Buffer(std::size_t)> room = &makeBuffer;  ///< makes the memory
  };
  /// The records of a chunk, CRC checked. The error is one sentence with offset and reason. A chunk of 8 MiB or more
  /// takes a second thread meanwhile, unless it is read ahead in spare time.
  [[nodiscard]] std::expected<Buffer, std::string> unpack(std::size_t chunk, const Unpack& how) const {
    return unpack(index_.chunks[chunk], how);
  }
  [[nodiscard]] std::expected<Buffer, std::string> unpack(std::size_t chunk) const { return unpack(chunk, {}); }

 private:
  struct Index {
    std::map<std::uint16_t, SchemaRecord> schemas;
    std::map<std::uint16_t, ChannelRecord> channels;
    std::vector<ChunkPlace> chunks;
    std::optional<StatisticsRecord> statistics;
    std::vector<AttachmentIndexRecord> attachments;
    std::vector<std::string> metadata_names;
    std::vector<FoundMessage> messages;
  };

  explicit McapFile(std::shared_ptr<const File> file) : file_(std::move(file)) {}
  [[nodiscard]] std::optional<FooterRecord> readFooter() const;
  [[nodiscard]] std::expected<Index, std::string> readSummary(const FooterRecord& footer);
  [[nodiscard]] static bool isComplete(const Index& index);
  void keepSoundChunks(Index& index);
  void scan();
  void scanChunk(std::uint64_t offset, std::uint64_t length, std::uint64_t there);
  void scanRecords(std::span<const std::byte> records, std::uint32_t chunk, std::vector<FoundMessage>& out);
  void addSchema(std::span<const std::byte> content);
  void addChannel(std::span<const std::byte> content);
  [[nodiscard]] bool listFromIndex(std::size_t chunk, std::vector<FoundMessage>& out);
  [[nodiscard]] std::expected<Buffer, std::string> unpack(const ChunkPlace& place, const Unpack& how) const;

  std::shared_ptr<const File> file_;
  Index index_;
  ProblemLog problems_;
  bool is_scanned_ = false;
};

}  // namespace stillframe::ingest
