#include "tools/ingest/mcap_file.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "scenegraph/thread_priority.h"
#include "tools/ingest/field_reader.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

constexpr std::uint64_t kMaxRecordBytes = std::uint64_t{256} << 20;  // of a record that is read whole
constexpr std::uint64_t kWorthAHelper = std::uint64_t{8} << 20;      // bytes: some milliseconds
constexpr std::size_t kChunkHeaderBytes = 40 + 64;                   // with room for the name of the compression

std::uint32_t crcOfRange(const File& file, std::uint64_t begin, std::uint64_t end) {
  ForwardReader reader(file);
  std::uint32_t crc = 0;
  while (begin < end) {
    const auto bytes = reader.view(begin, std::min<std::uint64_t>(end - begin, std::uint64_t{256} << 10));
    if (bytes.empty()) {
      break;
    }
    crc = crc32(bytes, crc);
    begin += bytes.size();
  }
  return crc;
}

/// What a file is that is no MCAP, and what to do with it.
std::string_view contentOf(const File& file) {
  std::array<std::byte, 16> first{};
  const std::size_t got = file.read(0, first);
  const std::string_view text(reinterpret_cast<const char*>(first.data()), got);
  return text.starts_with("#ROSBAG V") ? "it is a bag of ROS 1; 'mcap convert IN.bag OUT.mcap' makes one of it"
         : text.starts_with("SQLite format")
             ? "it is a database, as ROS 2 bags were; 'ros2 bag convert' makes one of it"
         : text.starts_with("<") ? "it is XML; --robot shows a URDF with a recording, --layout takes a layout"
                                 : "it does not begin with the MCAP magic bytes";
}

}  // namespace

std::expected<std::unique_ptr<McapFile>, scenegraph::Status> McapFile::open(const std::filesystem::path& path) {
  auto file = File::open(path);
  if (!file) {
    return std::unexpected(file.error());
  }
  std::unique_ptr<McapFile> mcap(new McapFile(*std::move(file)));
  std::array<std::byte, kMcapMagic.size()> magic{};
  const std::size_t got = mcap->file_->read(0, magic);
  if (got != magic.size() || std::memcmp(magic.data(), kMcapMagic.data(), magic.size()) != 0) {
    return std::unexpected(scenegraph::Status{
        scenegraph::StatusLevel::Error, "NotMcap",
        sentence("'", path.string(),
                 "' is not an MCAP file: ", mcap->file_->size() == 0 ? "it is empty" : contentOf(*mcap->file_))});
  }
  if (const auto footer = mcap->readFooter(); footer && footer->summary_start != 0) {
    auto index = mcap->readSummary(*footer);
    if (!index) {
      mcap->problems_.add("BadSummary", sentence("the summary of '", path.string(), "' cannot be used: ", index.error(),
                                                 "; the file was scanned instead"));
    } else if (isComplete(*index)) {
      mcap->keepSoundChunks(*index);
      mcap->index_ = *std::move(index);
      return mcap;
    }
  }
  mcap->scan();
  return mcap;
}

std::optional<FooterRecord> McapFile::readFooter() const {
  constexpr std::size_t kTailBytes = kFooterBytes + kMcapMagic.size();
  if (file_->size() < kTailBytes + kMcapMagic.size()) {
    return std::nullopt;
  }
  std::array<std::byte, kTailBytes> tail{};
  if (file_->read(file_->size() - kTailBytes, tail) != kTailBytes ||
      std::memcmp(tail.data() + kFooterBytes, kMcapMagic.data(), kMcapMagic.size()) != 0) {
    return std::nullopt;
  }
  FieldReader reader(tail);
  const auto opcode = reader.number<std::uint8_t>();
  const auto length = reader.number<std::uint64_t>();
  if (opcode != static_cast<std::uint8_t>(Opcode::Footer) || length != kFooterBytes - kRecordHeaderBytes) {
    return std::nullopt;
  }
  return parseFooter(reader.bytes(length));
}

std::expected<McapFile::Index, std::string> McapFile::readSummary(const FooterRecord& footer) {
  const std::uint64_t end = file_->size() - kMcapMagic.size() - kFooterBytes;
  if (footer.summary_start < kMcapMagic.size() || footer.summary_start > end) {
    return std::unexpected(sentence("it is said to begin at byte ", footer.summary_start, " of ", file_->size()));
  }
  if (footer.summary_crc != 0 &&
      crcOfRange(*file_, footer.summary_start, file_->size() - kMcapMagic.size() - sizeof(std::uint32_t)) !=
          footer.summary_crc) {
    return std::unexpected("its CRC is wrong");
  }
  Index index;
  ForwardReader reader(*file_);
  const auto bad = [](std::uint64_t offset) {
    return std::unexpected(sentence("the record at byte ", offset, " is damaged"));
  };
  for (std::uint64_t offset = footer.summary_start; offset < end;) {
    FieldReader header(reader.view(offset, std::min<std::uint64_t>(kRecordHeaderBytes, end - offset)));
    const auto opcode = static_cast<Opcode>(header.number<std::uint8_t>());
    const auto length = header.number<std::uint64_t>();
    if (!header.isGood() || length > end - offset - kRecordHeaderBytes) {
      return bad(offset);
    }
    const auto content = [&] { return reader.view(offset + kRecordHeaderBytes, std::min(length, kMaxRecordBytes)); };
    // Each parsed record is kept, or the whole summary is distrusted.
    const auto keep = [](auto record, auto&& store) {
      const bool is_there = record.has_value();
      if (is_there) {
        store(*std::move(record));
      }
      return is_there;
    };
    bool is_good = true;
    switch (opcode) {
      case Opcode::Schema:
        is_good = keep(parseSchema(content()),
                       [&](const SchemaRecord& record) { index.schemas.try_emplace(record.id, record); });
        break;
      case Opcode::Channel:
        is_good = keep(parseChannel(content()),
                       [&](const ChannelRecord& record) { index.channels.try_emplace(record.id, record); });
        break;
      case Opcode::ChunkIndex:
        is_good = keep(parseChunkIndex(content()), [&](ChunkIndexRecord record) {
          index.chunks.push_back({record.chunk_offset, record.chunk_length, record.message_index_length,
                                  record.uncompressed_size, record.start_time, record.end_time,
                                  std::move(record.channels), false});
        });
        break;
      case Opcode::Statistics:
        is_good =
            keep(parseStatistics(content()), [&](StatisticsRecord record) { index.statistics = std::move(record); });
        break;
      case Opcode::AttachmentIndex:
        is_good = keep(parseAttachmentIndex(content()),
                       [&](AttachmentIndexRecord record) { index.attachments.push_back(std::move(record)); });
        break;
      case Opcode::MetadataIndex:
        is_good = keep(parseMetadataIndexName(content()),
                       [&](std::string name) { index.metadata_names.push_back(std::move(name)); });
        break;
      default:
        break;
    }
    if (!is_good) {
      return bad(offset);
    }
    offset += kRecordHeaderBytes + length;
  }
  return index;
}

bool McapFile::isComplete(const Index& index) {
  for (const ChunkPlace& chunk : index.chunks) {
    for (const std::uint16_t channel : chunk.channels) {
      if (!index.channels.contains(channel)) {
        return false;
      }
    }
  }
  for (const auto& [id, channel] : index.channels) {
    if (channel.schema_id != 0 && !index.schemas.contains(channel.schema_id)) {
      return false;
    }
  }
  if (!index.statistics) {
    return !index.chunks.empty() && !index.channels.empty();
  }
  return index.statistics->message_count == 0 ||
         (!index.chunks.empty() && index.chunks.size() == index.statistics->chunk_count &&
          index.channels.size() >= index.statistics->channel_count);
}

void McapFile::keepSoundChunks(Index& index) {
  std::ranges::stable_sort(index.chunks, {}, &ChunkPlace::offset);
  std::uint64_t free_from = kMcapMagic.size();
  std::erase_if(index.chunks, [&](const ChunkPlace& chunk) {
    const std::uint64_t size = file_->size();
    const bool is_inside = chunk.offset >= free_from && chunk.offset <= size && chunk.length <= size - chunk.offset &&
                           chunk.message_index_length <= size - chunk.offset - chunk.length;
    if (is_inside) {
      free_from = chunk.offset + chunk.length;
    } else {
      problems_.add("BadChunkIndex",
                    sentence("the index of '", file_->path(), "' names a chunk of ", chunk.length, " bytes at byte ",
                             chunk.offset, " that overlaps another or lies outside of the file"));
    }
    return !is_inside;
  });
}

std::expected<Buffer, std::string> McapFile::unpack(const ChunkPlace& place, const Unpack& how) const {
  const auto bad = [&](const auto&... reason) {
    return std::unexpected(
        sentence("the chunk at byte ", place.offset, " of '", file_->path(), "' cannot be read: ", reason...));
  };
  const auto there = static_cast<std::size_t>(std::min(place.length, file_->size() - place.offset));
  std::array<std::byte, kRecordHeaderBytes + kChunkHeaderBytes> head{};
  const std::size_t head_bytes =
      file_->read(place.offset, std::span<std::byte>(head).first(std::min(there, head.size())));
  FieldReader reader(std::span<const std::byte>(head).first(head_bytes));
  const auto opcode = reader.number<std::uint8_t>();
  const auto length = reader.number<std::uint64_t>();
  if (!reader.isGood() || opcode != static_cast<std::uint8_t>(Opcode::Chunk) ||
      (!place.is_cut && length > there - kRecordHeaderBytes)) {
    return bad("there is no chunk");
  }
  const auto header = parseChunkHeader(reader.bytes(reader.left()));
  if (!header) {
    return bad("its header is damaged");
  }
  const auto compression = compressionFromName(header->compression);
  if (!compression) {
    return bad("its compression '", header->compression, "' is not known");
  }
  const std::size_t data_offset = kRecordHeaderBytes + header->header_bytes;
  std::uint64_t packed_size = header->packed_size;
  if (packed_size > there - data_offset) {
    if (!place.is_cut) {
      return bad("it claims ", packed_size, " packed bytes where ", there - data_offset, " are");
    }
    packed_size = there - data_offset;
  }
  if (header->uncompressed_size > maxUnpackedBytes(*compression, header->packed_size)) {
    return bad("it claims ", header->uncompressed_size, " bytes, more than ", header->packed_size, " bytes can hold");
  }
  bool is_short = false;
  const PackedBytes packed{static_cast<std::size_t>(packed_size), [&](std::size_t position, std::span<std::byte> into) {
                             const std::size_t got = file_->read(place.offset + data_offset + position, into);
                             is_short |= got != into.size();
                             return got;
                           }};
  std::uint32_t crc = 0;
  std::size_t made_bytes = 0;
  const bool is_checked = !place.is_cut && header->uncompressed_crc != 0;
  const auto begun = [&](const Buffer& out) {
    if (how.arrival != nullptr && !place.is_cut) {
      how.arrival->begin({out.bytes().first(static_cast<std::size_t>(header->uncompressed_size)), out.data});
    }
  };
  const auto made = [&](std::span<const std::byte> piece) {
    crc = is_checked ? crc32(piece, crc) : 0;
    made_bytes += piece.size();
    if (how.arrival != nullptr) {
      how.arrival->advance(made_bytes);
    }
  };
  auto records = decompress(*compression, packed, header->uncompressed_size,
                            {.completeness = place.is_cut ? Completeness::Prefix : Completeness::Whole,
                             .room = how.room,
                             .begun = begun,
                             .made = made,
                             .pause = how.pause,
                             .has_helper = header->uncompressed_size >= kWorthAHelper && !scenegraph::isSpare()});
  if (is_short) {
    return bad("the file became shorter");
  }
  if (!records) {
    return bad(records.error());
  }
  if (is_checked && crc != header->uncompressed_crc) {
    return bad("its CRC is wrong");
  }
  return records;
}

void McapFile::listMessages(std::size_t chunk, std::vector<FoundMessage>& out) {
  const std::size_t before = out.size();
  if (index_.chunks[chunk].message_index_length > 0) {
    if (listFromIndex(chunk, out)) {
      return;
    }
    out.resize(before);
    problems_.add("BadMessageIndex", sentence("the message index of the chunk at byte ", index_.chunks[chunk].offset,
                                              " of '", file_->path(), "' is damaged; the chunk was read instead"));
  }
  const auto records = unpack(chunk);
  if (!records) {
    problems_.add("BadChunk", records.error());
    return;
  }
  scanRecords(records->bytes(), static_cast<std::uint32_t>(chunk), out);
}

bool McapFile::listFromIndex(std::size_t chunk, std::vector<FoundMessage>& out) {
  const ChunkPlace& place = index_.chunks[chunk];
  const std::size_t before = out.size();
  std::vector<std::byte> bytes(static_cast<std::size_t>(place.message_index_length));
  if (file_->read(place.offset + place.length, bytes) != bytes.size()) {
    return false;
  }
  FieldReader reader(bytes);
  while (reader.left() > 0) {
    const auto opcode = reader.number<std::uint8_t>();
    const auto content = reader.bytes(reader.number<std::uint64_t>());
    const auto record = parseMessageIndex(content);
    if (!reader.isGood() || opcode != static_cast<std::uint8_t>(Opcode::MessageIndex) || !record ||
        record->entries.size() % 16 != 0 || !index_.channels.contains(record->channel_id)) {
      return false;
    }
    FieldReader entries(record->entries);
    while (entries.left() > 0) {
      const auto log_time = entries.number<std::uint64_t>();
      const auto offset = entries.number<std::uint64_t>();
      if (offset >= place.size || place.size - offset < kRecordHeaderBytes + kMessageHeaderBytes) {
        return false;
      }
      out.push_back({log_time, offset, 0, static_cast<std::uint32_t>(chunk), record->channel_id});
    }
  }
  const auto fresh = std::ranges::subrange(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
  std::ranges::stable_sort(fresh, {}, &FoundMessage::offset);
  for (std::size_t i = before; i < out.size(); ++i) {
    const std::uint64_t end = i + 1 < out.size() ? out[i + 1].offset : place.size;
    out[i].bytes = end - std::min(end, out[i].offset + kRecordHeaderBytes + kMessageHeaderBytes);
  }
  return true;
}

}  // namespace stillframe::ingest
