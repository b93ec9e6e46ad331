#include "nodes/points/codecs/cloudini.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "nodes/points/codecs/cloudini_chunk.h"
#include "nodes/points/codecs/cloudini_header.h"
#include "nodes/points/codecs/unpack.h"

namespace stillframe::nodes {
namespace {

using namespace cloudini;
using scenegraph::FieldType;
using std::unexpected;

unexpected<CodecError> fail(CodecErrorCode code, const std::string& message) {
  return unexpected(CodecError{code, message});
}

std::string claim(const Header& header) {
  return std::to_string(header.width) + " x " + std::to_string(header.height) + " points of " +
         std::to_string(header.point_step) + " bytes";
}

/// Refuses a header that claims more than `body_bytes` can hold at best, or more than anybody wants decoded.
std::expected<void, CodecError> checkClaim(const Header& header, const ChunkDecoder& decoder, std::size_t body_bytes) {
  const std::uint64_t points = header.points();
  // What a point costs in memory or in work, whichever is more.
  std::uint64_t point_bytes = header.point_step;
  std::uint64_t field_bytes = 0;
  for (const Field& field : header.fields) {
    field_bytes += byteSize(field.type);
  }
  point_bytes = std::max<std::uint64_t>({point_bytes, field_bytes, 1});
  const std::uint64_t limit = maxDecodedBytes(header.size + body_bytes);
  if (points > limit / point_bytes) {
    return fail(CodecErrorCode::ImplausibleSize, "the Cloudini header claims " + claim(header) + ", but " +
                                                     std::to_string(body_bytes) + " bytes follow; the limit is " +
                                                     std::to_string(limit) + " bytes");
  }
  const std::uint64_t chunks = (points + kPointsPerChunk - 1) / kPointsPerChunk;
  const std::uint64_t best = chunks * sizeof(std::uint32_t) > body_bytes
                                 ? 0
                                 : maxUnpackedBytes(header.compression, body_bytes - chunks * sizeof(std::uint32_t));
  if (points > 0 && (best == 0 || decoder.minBytes(points) > best)) {
    return fail(CodecErrorCode::ImplausibleSize, "the Cloudini header claims " + claim(header) + ", which the " +
                                                     std::to_string(body_bytes) + " bytes that follow cannot hold");
  }
  return {};
}

std::vector<scenegraph::PackedField> fieldsOf(const Header& header) {
  std::vector<scenegraph::PackedField> fields;
  for (const Field& field : header.fields) {
    // PointCloud has no integers of 64 bits.
    if (field.type <= ValueType::Float64 && field.isInPoint(header.point_step)) {
      fields.push_back({field.name, field.offset, static_cast<FieldType>(field.type), 1});
    }
  }
  return fields;
}

unexpected<CodecError> corrupt(std::size_t chunk, const std::string& what) {
  return fail(CodecErrorCode::CorruptCloud, "chunk " + std::to_string(chunk) + " of the Cloudini cloud " + what);
}

std::expected<std::vector<std::byte>, CodecError> decodeChunks(const Header& header, ChunkDecoder& decoder,
                                                               std::span<const std::byte> body) {
  const std::uint64_t total = header.points();
  std::vector<std::byte> points;
  // A claim that the bytes make likely gets its memory at once; any other grows with what is decoded.
  if (total * header.point_step <= 64 * std::uint64_t{body.size()}) {
    points.reserve(static_cast<std::size_t>(total * header.point_step));
  }
  Unpacker unpacker(header.compression);
  std::uint64_t done = 0;
  for (std::size_t chunk = 0; done < total; ++chunk) {
    std::uint32_t chunk_bytes = 0;
    if (body.size() < sizeof(chunk_bytes)) {
      return corrupt(chunk,
                     "is missing: " + std::to_string(done) + " of " + std::to_string(total) + " points are there");
    }
    std::memcpy(&chunk_bytes, body.data(), sizeof(chunk_bytes));
    body = body.subspan(sizeof(chunk_bytes));
    if (chunk_bytes > body.size()) {
      return corrupt(chunk,
                     "claims " + std::to_string(chunk_bytes) + " bytes; there are " + std::to_string(body.size()));
    }
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(total - done, kPointsPerChunk));
    const auto unpacked = unpacker.unpack(body.first(chunk_bytes), decoder.maxBytes(count));
    if (!unpacked) {
      return corrupt(chunk, unpacked.error());
    }
    const std::size_t begin = points.size();
    points.resize(begin + count * header.point_step);
    if (!decoder.decode(*unpacked, points.data() + begin, count)) {
      return corrupt(chunk, "does not hold exactly " + std::to_string(count) + " points");
    }
    body = body.subspan(chunk_bytes);
    done += count;
  }
  if (!body.empty()) {
    return fail(CodecErrorCode::CorruptCloud,
                std::to_string(body.size()) + " bytes follow behind the last point of the Cloudini cloud");
  }
  return points;
}

}  // namespace

std::expected<scenegraph::PointCloud, CodecError> decodeCloudini(const scenegraph::Payload& blob) {
  auto header = readHeader(blob.bytes);
  if (!header) {
    return unexpected(std::move(header.error()));
  }
  ChunkDecoder decoder(*header);
  const auto body = blob.bytes.subspan(header->size);
  if (const auto checked = checkClaim(*header, decoder, body.size()); !checked) {
    return unexpected(checked.error());
  }
  auto points = decodeChunks(*header, decoder, body);
  if (!points) {
    return unexpected(std::move(points.error()));
  }
  scenegraph::PointCloud cloud;
  cloud.width = header->width;
  cloud.height = header->height;
  cloud.point_step = header->point_step;
  cloud.row_step = static_cast<std::uint32_t>(std::min<std::uint64_t>(std::uint64_t{header->width} * header->point_step,
                                                                      std::numeric_limits<std::uint32_t>::max()));
  cloud.is_dense = false;
  cloud.color_packing = scenegraph::ColorPacking::PclWord;  // Cloudini packs sensor_msgs/PointCloud2
  cloud.fields = fieldsOf(*header);
  const auto anchor = std::make_shared<const std::vector<std::byte>>(std::move(*points));
  cloud.data = {*anchor, anchor};
  return cloud;
}

}  // namespace stillframe::nodes
