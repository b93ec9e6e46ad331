#include "tools/ingest/wire_plan.h"

#include <algorithm>

#include "tools/ingest/sentence.h"
#include "tools/ingest/wire_reader.h"

namespace stillframe::ingest {

/// Runs steps over a message. A step that fails leaves the name of its field.
struct PlanRunner {
  // Rows that room is made for at once: all, as long as they take no more memory than such messages do.
  static constexpr std::size_t kMaxReserved = 4096;
  static constexpr std::size_t kReservedPerByte = 16;

  const WirePlan& plan;
  std::uint64_t row_budget;  // bytes of rows that may still be made
  std::string_view failed_field;
  bool is_over_budget = false;

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
      case Kind::Numbers:
        return numbers(op, reader, op.locate(row));
      case Kind::Row:
        return run(plan.steps_[op.target], reader, op.locate(row));
      case Kind::Texts:
        return texts(op, reader, *static_cast<std::vector<std::string_view>*>(op.locate(row)));
      case Kind::Text:
        return text(op, reader, op.locate(row));
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
    const std::uint64_t element_bytes =
        op.kind == WirePlan::OpKind::Rows ? std::max<std::uint64_t>(element.min_bytes, 1) : element.min_bytes;
    if (element_bytes > 0 && count > reader.left() / element_bytes) {
      return reader.take(~std::uint64_t{0}, ignored);  // fails, and says so
    }
    if (std::uint64_t{count} * op.row_bytes > row_budget) {
      is_over_budget = true;
      return false;
    }
    row_budget -= std::uint64_t{count} * op.row_bytes;
    const std::size_t most =
        std::max(kMaxReserved, kReservedPerByte * reader.left() / std::max<std::size_t>(op.row_bytes, 1));
    void* rows = op.locate == nullptr ? nullptr : op.locate(row);
    for (std::uint32_t i = 0; i < count; ++i) {
      void* element_row = rows == nullptr ? nullptr : op.append(rows, std::min<std::size_t>(count, most));
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
  static bool text(const WirePlan::Op& op, WireReader<Format>& reader, void* slot) {
    std::string_view view;
    if (!reader.text(view)) {
      return false;
    }
    if (op.slot == SlotKind::String) {
      *static_cast<std::string*>(slot) = view;
    } else {
      *static_cast<std::string_view*>(slot) = view;
    }
    return true;
  }

  template <typename Format>
  static bool texts(const WirePlan::Op& op, WireReader<Format>& reader, std::vector<std::string_view>& out) {
    constexpr std::uint64_t kMinTextBytes = 4;
    std::uint32_t count = op.count;
    std::span<const std::byte> ignored;
    if (op.is_sequence && !reader.number(count)) {
      return false;
    }
    if (count > reader.left() / kMinTextBytes) {
      return reader.take(~std::uint64_t{0}, ignored);  // fails, and says so
    }
    out.resize(count);
    return std::ranges::all_of(out, [&](std::string_view& text) { return reader.text(text); });
  }

  template <typename Format>
  static bool numbers(const WirePlan::Op& op, WireReader<Format>& reader, void* slot) {
    std::uint32_t count = op.count;
    std::span<const std::byte> raw;
    if (op.is_sequence && !reader.number(count)) {
      return false;
    }
    if (count > 0 && (!reader.skip(op.alignment, 0) || !reader.takeNow(count * op.size, raw))) {
      return false;
    }
    switch (op.slot) {
      case SlotKind::Doubles:
        return storeMany<Format>(op.type, raw, count, *static_cast<std::vector<double>*>(slot));
      case SlotKind::Floats:
        return storeMany<Format>(op.type, raw, count, *static_cast<std::vector<float>*>(slot));
      default:
        return storeMany<Format>(op.type, raw, count, *static_cast<std::vector<std::uint32_t>*>(slot));
    }
  }

  template <typename Format, typename T>
  static bool storeMany(WireType type, std::span<const std::byte> raw, std::uint32_t count, std::vector<T>& out) {
    out.resize(count);
    return withWireType(type, [&]<typename Wire>(Wire) {
      if constexpr (std::is_same_v<Wire, T> && !Format::kIsSwapped) {
        if (!raw.empty()) {
          std::memcpy(out.data(), raw.data(), raw.size());
        }
      } else {
        for (std::uint32_t i = 0; i < count; ++i) {
          out[i] = static_cast<T>(loadNumber<Wire, Format::kIsSwapped>(raw.data() + i * sizeof(Wire)));
        }
      }
      return true;
    });
  }

  /// Calls `use` with a value of the C++ type of a wire type; false for one that is no number.
  template <typename Use>
  static bool withWireType(WireType type, const Use& use) {
    switch (type) {
      case WireType::Int8:
        return use(std::int8_t{});
      case WireType::Bool:
      case WireType::Uint8:
        return use(std::uint8_t{});
      case WireType::Int16:
        return use(std::int16_t{});
      case WireType::Uint16:
        return use(std::uint16_t{});
      case WireType::Int32:
        return use(std::int32_t{});
      case WireType::Uint32:
        return use(std::uint32_t{});
      case WireType::Int64:
        return use(std::int64_t{});
      case WireType::Uint64:
        return use(std::uint64_t{});
      case WireType::Float32:
        return use(float{});
      case WireType::Float64:
        return use(double{});
      default:
        return false;
    }
  }

  template <typename Format>
  static bool number(const WirePlan::Op& op, WireReader<Format>& reader, void* slot) {
    return withWireType(op.type, [&]<typename Wire>(Wire value) {
      if (!reader.number(value)) {
        return false;
      }
      switch (op.slot) {
        case SlotKind::Double:
          *static_cast<double*>(slot) = static_cast<double>(value);
          break;
        case SlotKind::Float:
          *static_cast<float*>(slot) = static_cast<float>(value);
          break;
        case SlotKind::Bool:
          *static_cast<bool*>(slot) = value != Wire{};
          break;
        default:
          if constexpr (std::is_integral_v<Wire>) {
            const auto bits = static_cast<std::uint32_t>(value);
            std::memcpy(slot, &bits, sizeof(bits));
          }
      }
      return true;
    });
  }

  template <typename Format>
  std::expected<void, scenegraph::DecodeError> decode(std::span<const std::byte> body, std::size_t there, void* row) {
    WireReader<Format> reader(body, there);
    if (run(plan.steps_[plan.root_], reader, row)) {
      return {};
    }
    if (is_over_budget) {
      return std::unexpected(scenegraph::DecodeError{
          "TooManyElements", sentence("the field '", failed_field, "' of a message of ", body.size(),
                                      " bytes holds more elements than are read")});
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
  return decode(message, message.size(), row);
}

bool WirePlan::decodeEarly(std::span<const std::byte> message, std::size_t there, void* row) const {
  return decode(message, std::min(there, message.size()), row).has_value();
}

std::expected<void, scenegraph::DecodeError> WirePlan::decode(std::span<const std::byte> message, std::size_t there,
                                                              void* row) const {
  PlanRunner runner{*this, rowBudget(message.size()), {}};
  if (is_ros1_) {
    return runner.decode<Ros1Packed>(message, there, row);
  }
  constexpr std::size_t kEncapsulationBytes = 4;
  if (there < kEncapsulationBytes) {
    return std::unexpected(scenegraph::DecodeError{
        "TruncatedMessage", sentence("the message has ", message.size(), " bytes, fewer than the header of CDR")});
  }
  const auto kind = std::to_integer<unsigned>(message[0]) << 8 | std::to_integer<unsigned>(message[1]);
  const auto body = message.subspan(kEncapsulationBytes);
  switch (kind) {
    case 0:
      return runner.decode<CdrBig>(body, there - kEncapsulationBytes, row);
    case 1:
      return runner.decode<CdrLittle>(body, there - kEncapsulationBytes, row);
    default:
      return std::unexpected(
          scenegraph::DecodeError{"BadEncapsulation", sentence("the message is not plain CDR: its kind is ", kind)});
  }
}

}  // namespace stillframe::ingest
