#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/points/codecs/cloudini_reader.h"

namespace stillframe::nodes::cloudini {

/// Where the values of one field go: `points` of them, `step` bytes apart. `first` may be null: read, not stored.
struct SectionTarget {
  std::byte* first = nullptr;
  std::size_t step = 0;
  std::size_t points = 0;
  std::uint32_t value_bytes = 0;  ///< 2, 4 or 8
};

/// Reads one integer field of a version 5 chunk: a mode byte, then differences, a palette with packed indexes, runs of
/// a value, or runs of a difference. Fails the reader when it does not hold exactly the points.
void readSection(Reader& reader, const SectionTarget& target);

}  // namespace stillframe::nodes::cloudini
