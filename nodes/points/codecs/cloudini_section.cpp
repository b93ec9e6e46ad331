#include "nodes/points/codecs/cloudini_section.h"

#include <bit>
#include <cstring>
#include <vector>

namespace stillframe::nodes::cloudini {
namespace {

enum class Mode : std::uint8_t { Differences = 0, Palette = 1, Runs = 2, DifferenceRuns = 3 };

/// Stores one value after the other. `Value` is an unsigned integer as wide as the field.
template <typename Value>
class Writer {
 public:
  explicit Writer(const SectionTarget& target) : at_(target.first), step_(target.step), left_(target.points) {}
  [[nodiscard]] std::size_t left() const { return left_; }
  void write(std::uint64_t value) {
    if (at_ != nullptr) {
      const auto narrow = static_cast<Value>(value);
      std::memcpy(at_, &narrow, sizeof(Value));
      at_ += step_;
    }
    --left_;
  }

 private:
  std::byte* at_;
  std::size_t step_;
  std::size_t left_;
};

template <typename Value>
void readDifferences(Reader& reader, Writer<Value>& writer) {
  std::uint64_t value = 0;
  while (writer.left() > 0 && !reader.hasFailed()) {
    value += reader.difference().value;
    writer.write(value);
  }
}

template <typename Value>
void readPalette(Reader& reader, Writer<Value>& writer) {
  const auto size = static_cast<std::size_t>(reader.raw(2));
  if (size == 0 || reader.left() < size * sizeof(Value)) {
    reader.fail();
    return;
  }
  std::vector<std::uint64_t> palette(size);
  for (std::uint64_t& value : palette) {
    value = reader.raw(sizeof(Value));
  }
  const auto index_bits = static_cast<unsigned>(std::bit_width(size - 1));
  if (reader.left() < (writer.left() * index_bits + 7) / 8) {
    reader.fail();
    return;
  }
  BitReader<Reader> bits(reader);
  while (writer.left() > 0) {
    const std::uint64_t index = bits.bits(index_bits);
    if (index >= size) {
      reader.fail();
      return;
    }
    writer.write(palette[index]);
  }
}

/// Runs of a value, or of a difference to the value before.
template <typename Value, bool kIsDifference>
void readRuns(Reader& reader, Writer<Value>& writer) {
  const std::uint64_t run_count = reader.raw(4);
  std::uint64_t value = 0;
  for (std::uint64_t run = 0; run < run_count && !reader.hasFailed(); ++run) {
    std::uint64_t difference = 0;
    if constexpr (kIsDifference) {
      difference = reader.difference().value;
    } else {
      value = reader.raw(sizeof(Value));
    }
    const std::uint64_t length = reader.varint();
    if (length > writer.left()) {
      reader.fail();
      return;
    }
    for (std::uint64_t i = 0; i < length; ++i) {
      value += difference;
      writer.write(value);
    }
  }
  if (writer.left() > 0) {
    reader.fail();
  }
}

template <typename Value>
void readValues(Reader& reader, const SectionTarget& target) {
  Writer<Value> writer(target);
  switch (static_cast<Mode>(reader.raw(1))) {
    case Mode::Differences:
      return readDifferences(reader, writer);
    case Mode::Palette:
      return readPalette(reader, writer);
    case Mode::Runs:
      return readRuns<Value, false>(reader, writer);
    case Mode::DifferenceRuns:
      return readRuns<Value, true>(reader, writer);
  }
  reader.fail();
}

}  // namespace

void readSection(Reader& reader, const SectionTarget& target) {
  switch (target.value_bytes) {
    case 2:
      return readValues<std::uint16_t>(reader, target);
    case 4:
      return readValues<std::uint32_t>(reader, target);
    default:
      return readValues<std::uint64_t>(reader, target);
  }
}

}  // namespace stillframe::nodes::cloudini
