#include "tools/ingest/wire_plan.h"

#include <algorithm>

#include "tools/ingest/sentence.h"
#include "tools/ingest/wire_reader.h"

namespace stillframe::ingest {

/// Runs steps over a message. A step that fails leaves the name of its field.
struct PlanRunner {
  static constexpr std::size_t kMaxReserved = 4096;  // rows before the bytes for them have been seen

  const WirePlan& plan;
  std::string_view failed_field;

  template <typename Format>
  bool run(const WirePlan::Steps& steps, WireReader<Format>& reader, void* row) {
    for (std::size_t i = 0; i < steps.ops.size(); ++i) {
      if (!step(steps.ops[i], reader, row)) {
        if (failed_field.empty()) {
          failed_field = steps.names[i];
        }
        return false;
      }
    }
    return true;
  }

  template <typename Format>
  bool step(const WirePlan::Op& op, WireReader<Format>& reader, void* row) {
    using Kind = WirePlan::OpKind;
    switch (op.kind) {
      case Kind::Skip:
        return reader.skip(op.alignment, op.size);
      case Kind::SkipSequence:
      case Kind::SkipText: {
        std::uint32_t count = 0;
        return reader.number(count) && (count == 0 || reader.skip(op.alignment, count * op.size));
      }
      case Kind::SkipMany:
      case Kind::Rows:
        return many(op, reader, row);
      case Kind::Number:
        return number(op, reader, op.locate(row));
      case Kind::Text:
        return reader.text(*static_cast<std::string_view*>(op.locate(row)));
      case Kind::Bytes: {
        std::uint32_t count = op.count;
        return (!op.is_sequence || reader.number(count)) &&
               reader.take(count, *static_cast<std::span<const std::byte>*>(op.locate(row)));
      }
      case Kind::Stamp:
        return stamp(op, reader, *static_cast<tf::TimePoint*>(op.locate(row)));
    }
    return false;
  }

  template <typename Format>
  bool many(const WirePlan::Op& op, WireReader<Format>& reader, void* row) {
    std::uint32_t count = op.count;
    if (op.is_sequence && !reader.number(count)) {
      return false;
    }
    const WirePlan::Steps& element = plan.steps_[op.target];
    std::span<const std::byte> ignored;
    if (element.min_bytes > 0 && count > reader.left() / element.min_bytes) {
      return reader.take(~std::uint64_t{0}, ignored);  // fails, and says so
    }
    void* rows = op.locate == nullptr ? nullptr : op.locate(row);
    for (std::uint32_t i = 0; i < count; ++i) {
      void* element_row = rows == nullptr ? nullptr : op.append(rows, std::min<std::size_t>(count, kMaxReserved));
      if (!run(element, reader, element_row)) {
        return false;
      }
    }
    return true;
  }

  template <typename Format>
  static bool stamp(const WirePlan::Op& op, WireReader<Format>& reader, tf::TimePoint& out) {
    std::uint32_t seconds = 0;
    std::uint32_t nanoseconds = 0;
    if (!reader.number(seconds) || !reader.number(nanoseconds)) {
      return false;
    }
    const std::int64_t whole =
        op.type == WireType::Int32 ? std::int64_t{static_cast<std::int32_t>(seconds)} : std::int64_t{seconds};
    out.ns = whole * 1'000'000'000 + std::int64_t{nanoseconds};  // at most 4.3e18 + 4.3e9: fits
    return true;
  }

  template <typename Format>
  static bool number(const WirePlan::Op& op, WireReader<Format>& reader, void* slot) {
    switch (op.type) {
      case WireType::Int8:
        return store<std::int8_t>(op, reader, slot);
      case WireType::Bool:
      case WireType::Uint8:
        return store<std::uint8_t>(op, reader, slot);
      case WireType::Int16:
        return store<std::int16_t>(op, reader, slot);
      case WireType::Uint16:
        return store<std::uint16_t>(op, reader, slot);
      case WireType::Int32:
        return store<std::int32_t>(op, reader, slot);
      case WireType::Uint32:
        return store<std::uint32_t>(op, reader, slot);
      case WireType::Int64:
        return store<std::int64_t>(op, reader, slot);
      case WireType::Uint64:
        return store<std::uint64_t>(op, reader, slot);
      case WireType::Float32:
        return store<float>(op, reader, slot);
      case WireType::Float64:
        return store<double>(op, reader, slot);
      default:
        return false;
    }
  }

  template <typename Wire, typename Format>
  static bool store(const WirePlan::Op& op, WireReader<Format>& reader, void* slot) {
    Wire value{};
    if (!reader.number(value)) {
      return false;
    }
    if (op.slot == SlotKind::Double) {
      *static_cast<double*>(slot) = static_cast<double>(value);
    } else if constexpr (std::is_integral_v<Wire>) {
      if (op.slot == SlotKind::Uint32) {
        *static_cast<std::uint32_t*>(slot) = static_cast<std::uint32_t>(value);
      } else {
        *static_cast<bool*>(slot) = value != 0;
      }
    }
    return true;
  }

  template <typename Format>
  std::expected<void, scenegraph::DecodeError> decode(std::span<const std::byte> body, void* row) {
    WireReader<Format> reader(body);
    if (run(plan.steps_[plan.root_], reader, row)) {
      return {};
    }
    const std::uint64_t wanted = reader.wanted();
    return std::unexpected(scenegraph::DecodeError{
        "TruncatedMessage", wanted == ~std::uint64_t{0}
                                ? sentence("the message has ", body.size(), " bytes; the field '", failed_field,
                                           "' claims more elements than its last ", reader.left(), " can hold")
                                : sentence("the message has ", body.size(), " bytes; the field '", failed_field,
                                           "' needs ", wanted, " where ", reader.left(), " are left")});
  }
};

std::expected<void, scenegraph::DecodeError> WirePlan::decode(std::span<const std::byte> message, void* row) const {
  PlanRunner runner{*this, {}};
  if (is_ros1_) {
    return runner.decode<Ros1Packed>(message, row);
  }
  constexpr std::size_t kEncapsulationBytes = 4;
  if (message.size() < kEncapsulationBytes) {
    return std::unexpected(scenegraph::DecodeError{
        "TruncatedMessage", sentence("the message has ", message.size(), " bytes, fewer than the header of CDR")});
  }
  const auto kind = std::to_integer<unsigned>(message[0]) << 8 | std::to_integer<unsigned>(message[1]);
  const auto body = message.subspan(kEncapsulationBytes);
  switch (kind) {
    case 0:
      return runner.decode<CdrBig>(body, row);
    case 1:
      return runner.decode<CdrLittle>(body, row);
    default:
      return std::unexpected(
          scenegraph::DecodeError{"BadEncapsulation", sentence("the message is not plain CDR: its kind is ", kind)});
  }
}

}  // namespace stillframe::ingest
