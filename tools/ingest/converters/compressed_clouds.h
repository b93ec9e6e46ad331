#pragma once

#include <algorithm>
#include <cctype>
#include <span>

#include "scenegraph/objects/compressed_point_cloud.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

struct CompressedCloudRow {
  scenegraph::CompressedPointCloud cloud;
  std::span<const std::byte> data;
};

/// The cloud with its bytes as a payload and its format in lower case.
[[nodiscard]] inline RowDecoder<CompressedCloudRow>::Result compressedCloud(CompressedCloudRow& row,
                                                                            const MessageView& payloads) {
  std::ranges::transform(row.cloud.format, row.cloud.format.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  row.cloud.data = payloadOf(row.data, payloads);
  return finished(std::move(row.cloud));
}

}  // namespace stillframe::ingest::converters
