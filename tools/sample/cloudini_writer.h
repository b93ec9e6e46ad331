#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "nodes/points/codecs/cloudini_header.h"
#include "scenegraph/objects/payload.h"

namespace stillframe::sample {

/// How an integer field of a version 5 chunk is written.
enum class SectionMode : unsigned char { Differences = 0, Palette = 1, Runs = 2, DifferenceRuns = 3 };

struct CloudiniOptions {
  bool has_binary_header = false;
  SectionMode section_mode = SectionMode::Differences;
};

/// A Cloudini blob of the points that `header` describes; `points` are as many records of header.point_step bytes.
/// Plain and slow: what the reader is held against.
[[nodiscard]] std::vector<std::byte> writeCloudini(const nodes::cloudini::Header& header,
                                                   std::span<const std::byte> points, CloudiniOptions options = {});
/// The header alone.
[[nodiscard]] std::vector<std::byte> writeCloudiniHeader(const nodes::cloudini::Header& header, bool is_binary);

/// The bytes as a payload of their own.
[[nodiscard]] scenegraph::Payload toPayload(std::vector<std::byte> bytes);

}  // namespace stillframe::sample
