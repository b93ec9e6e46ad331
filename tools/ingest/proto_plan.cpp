#include "tools/ingest/proto_plan.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "tools/ingest/proto_reader.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

/// Walks a message. What fails leaves the name of its field and the reason.
class ProtoRunner {
 public:
  ProtoRunner(const ProtoPlan& plan, std::size_t message_bytes)
      : plan_(plan), message_bytes_(message_bytes), row_budget_(rowBudget(message_bytes)) {}

  bool run(std::size_t index, std::span<const std::byte> bytes, void* row) {
    const ProtoPlan::Message& message = plan_.messages_[index];
    for (const Field& field : message) {
      if (field.kind == OpKind::Number) {
        store(field, 0.0, 0, field.locate(row));
      }
    }
    ProtoReader reader(bytes);
    while (!reader.isAtEnd()) {
      const auto tag = reader.tag();
      if (!tag) {
        return fail("", reader.left() == 0 ? "ends within a tag" : "holds a tag that is none");
      }
      const auto field = std::ranges::find(message, tag->number, &Field::number);
      const std::string_view name = field == message.end() ? std::string_view{} : field->name;
      const auto value = reader.value(tag->type);
      if (!value) {
        return failReading(name, reader);
      }
      if (field != message.end() && !take(*field, *tag, *value, row)) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] scenegraph::DecodeError error() const { return {code_, text_}; }

 private:
  using Field = ProtoPlan::Field;
  using OpKind = ProtoPlan::OpKind;
  using Coding = ProtoPlan::Coding;

  bool fail(std::string_view name, std::string_view reason, std::string code = "BadMessage") {
    code_ = std::move(code);
    text_ = name.empty() ? sentence("the message of ", message_bytes_, " bytes ", reason)
                         : sentence("the field '", name, "' of a message of ", message_bytes_, " bytes ", reason);
    return false;
  }
  bool failReading(std::string_view name, const ProtoReader& reader) {
    return reader.wanted() > 0
               ? fail(name, sentence("needs ", reader.wanted(), " bytes where ", reader.left(), " are left"),
                      "TruncatedMessage")
               : fail(name, "is of a kind that is not supported");
  }

  bool take(const Field& field, const ProtoReader::Tag& tag, const ProtoReader::Value& value, void* row) {
    if (field.kind == OpKind::Number || field.kind == OpKind::Numbers) {
      const bool is_packed = field.kind == OpKind::Numbers && tag.type == ProtoReader::Type::Length;
      if (!is_packed && tag.type != typeOf(field.coding)) {
        return fail(field.name, "is a number of another size than its definition says");
      }
      if (field.kind == OpKind::Number) {
        storeCoded(field, value.number, field.locate(row));
        return true;
      }
      return is_packed ? packed(field, value.bytes, field.locate(row))
                       : pushCoded(field, value.number, field.locate(row));
    }
    if (tag.type != ProtoReader::Type::Length) {
      return fail(field.name, "is a number where its definition says otherwise");
    }
    const std::string_view text(reinterpret_cast<const char*>(value.bytes.data()), value.bytes.size());
    switch (field.kind) {
      case OpKind::Text:
        if (field.slot == SlotKind::String) {
          *static_cast<std::string*>(field.locate(row)) = text;
        } else {
          *static_cast<std::string_view*>(field.locate(row)) = text;
        }
        return true;
      case OpKind::Texts:
        return spend(field, sizeof(text)) &&
               (static_cast<std::vector<std::string_view>*>(field.locate(row))->push_back(text), true);
      case OpKind::Bytes:
        *static_cast<std::span<const std::byte>*>(field.locate(row)) = value.bytes;
        return true;
      case OpKind::Stamp:
        return stamp(field, value.bytes, *static_cast<tf::TimePoint*>(field.locate(row)));
      case OpKind::Inside:
        return run(field.target, value.bytes, row);
      case OpKind::Row:
        return run(field.target, value.bytes, field.locate(row));
      case OpKind::Rows:
        return spend(field, field.row_bytes) && run(field.target, value.bytes, field.append(field.locate(row), 0));
      default:
        return false;
    }
  }

  bool spend(const Field& field, std::size_t bytes) {
    if (bytes > row_budget_) {
      return fail(field.name, "holds more elements than are read", "TooManyElements");
    }
    row_budget_ -= bytes;
    return true;
  }

  bool stamp(const Field& field, std::span<const std::byte> bytes, tf::TimePoint& out) {
    std::int64_t seconds = 0;
    std::int64_t nanos = 0;
    ProtoReader reader(bytes);
    while (!reader.isAtEnd()) {
      const auto tag = reader.tag();
      const auto value = tag ? reader.value(tag->type) : std::nullopt;
      if (!value) {
        return failReading(field.name, reader);
      }
      if (tag->type == ProtoReader::Type::Varint && tag->number <= 2) {
        (tag->number == 1 ? seconds : nanos) = static_cast<std::int64_t>(value->number);
      }
    }
    std::int64_t scaled = 0;
    if (__builtin_mul_overflow(seconds, std::int64_t{1'000'000'000}, &scaled) ||
        __builtin_add_overflow(scaled, nanos, &out.ns)) {
      return fail(field.name, sentence("is ", seconds, " seconds, beyond what 64 bits of nanoseconds hold"));
    }
    return true;
  }

  static ProtoReader::Type typeOf(Coding coding) {
    switch (coding) {
      case Coding::Float:
      case Coding::Fixed32:
      case Coding::Signed32:
        return ProtoReader::Type::Fixed32;
      case Coding::Double:
      case Coding::Fixed64:
      case Coding::Signed64:
        return ProtoReader::Type::Fixed64;
      default:
        return ProtoReader::Type::Varint;
    }
  }

  /// A value in both readings: as a real number, and as an integer's bits.
  struct Decoded {
    double real = 0.0;
    std::uint64_t bits = 0;
  };
  static Decoded decoded(Coding coding, std::uint64_t raw) {
    const auto integer = [](std::int64_t value) {
      return Decoded{static_cast<double>(value), static_cast<std::uint64_t>(value)};
    };
    switch (coding) {
      case Coding::Float:
        return {std::bit_cast<float>(static_cast<std::uint32_t>(raw)), 0};
      case Coding::Double:
        return {std::bit_cast<double>(raw), 0};
      case Coding::Varint32:
      case Coding::Signed32:
        return integer(static_cast<std::int32_t>(raw));
      case Coding::Varint64:
      case Coding::Signed64:
        return integer(static_cast<std::int64_t>(raw));
      case Coding::ZigZag:
        return integer(static_cast<std::int64_t>((raw >> 1) ^ (~(raw & 1) + 1)));
      default:
        return {static_cast<double>(raw), raw};
    }
  }

  static void storeCoded(const Field& field, std::uint64_t raw, void* slot) {
    const Decoded value = decoded(field.coding, raw);
    store(field, value.real, value.bits, slot);
  }
  static void store(const Field& field, double real, std::uint64_t bits, void* slot) {
    switch (field.slot) {
      case SlotKind::Double:
        *static_cast<double*>(slot) = real;
        break;
      case SlotKind::Float:
        *static_cast<float*>(slot) = static_cast<float>(real);
        break;
      case SlotKind::Bool:
        *static_cast<bool*>(slot) = bits != 0;
        break;
      default: {
        const auto low = static_cast<std::uint32_t>(bits);
        std::memcpy(slot, &low, sizeof(low));
      }
    }
  }
  static bool pushCoded(const Field& field, std::uint64_t raw, void* slot) {
    const Decoded value = decoded(field.coding, raw);
    switch (field.slot) {
      case SlotKind::Doubles:
        static_cast<std::vector<double>*>(slot)->push_back(value.real);
        break;
      case SlotKind::Floats:
        static_cast<std::vector<float>*>(slot)->push_back(static_cast<float>(value.real));
        break;
      default:
        static_cast<std::vector<std::uint32_t>*>(slot)->push_back(static_cast<std::uint32_t>(value.bits));
    }
    return true;
  }

  bool packed(const Field& field, std::span<const std::byte> bytes, void* slot) {
    const bool is_copied = (field.coding == Coding::Double && field.slot == SlotKind::Doubles) ||
                           (field.coding == Coding::Float && field.slot == SlotKind::Floats);
    const std::size_t size = field.coding == Coding::Double ? sizeof(double) : sizeof(float);
    if (is_copied && bytes.size() % size == 0) {
      const auto append = [&](auto& out) {
        const std::size_t before = out.size();
        out.resize(before + bytes.size() / size);
        if (!bytes.empty()) {
          std::memcpy(out.data() + before, bytes.data(), bytes.size());
        }
      };
      if (field.slot == SlotKind::Doubles) {
        append(*static_cast<std::vector<double>*>(slot));
      } else {
        append(*static_cast<std::vector<float>*>(slot));
      }
      return true;
    }
    ProtoReader reader(bytes);
    while (!reader.isAtEnd()) {
      const auto value = reader.value(typeOf(field.coding));
      if (!value) {
        return failReading(field.name, reader);
      }
      pushCoded(field, value->number, slot);
    }
    return true;
  }

  const ProtoPlan& plan_;
  std::size_t message_bytes_;
  std::uint64_t row_budget_;  // bytes of rows that may still be made
  std::string code_;
  std::string text_;
};

std::expected<void, scenegraph::DecodeError> ProtoPlan::decode(std::span<const std::byte> message, void* row) const {
  ProtoRunner runner(*this, message.size());
  if (!runner.run(root_, message, row)) {
    return std::unexpected(runner.error());
  }
  return {};
}

}  // namespace stillframe::ingest
