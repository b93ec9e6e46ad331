#include "tools/ingest/json_plan.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/ingest/json_text.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

using Json = nlohmann::json;
using Buffers = std::list<std::vector<std::byte>>;

std::optional<double> realOf(const Json& value) {
  if (value.is_number()) {
    return value.get<double>();
  }
  if (value.is_null() || value == "NaN") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (value == "Infinity" || value == "-Infinity") {
    return value == "Infinity" ? HUGE_VAL : -HUGE_VAL;
  }
  return std::nullopt;
}

/// An integer of -2^31 .. 2^32 - 1, as its low 32 bits.
std::optional<std::uint32_t> bitsOf(const Json& value) {
  if (!value.is_number() || (value.is_number_unsigned() && value.get<std::uint64_t>() > 0xFFFFFFFFu)) {
    return std::nullopt;
  }
  const auto real = value.get<double>();
  if (!(real >= -2147483648.0 && real <= 4294967295.0) || real != std::floor(real)) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(real));
}

std::optional<tf::TimePoint> timeOf(const Json& value) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    const auto time = parseTime(text);
    const auto ns = time ? time : parseDuration(text);
    return ns ? std::optional(tf::TimePoint{*ns}) : std::nullopt;
  }
  if (!value.is_object()) {
    return std::nullopt;
  }
  const auto part = [&](std::initializer_list<const char*> names) -> std::optional<std::int64_t> {
    for (const char* name : names) {
      if (const auto found = value.find(name); found != value.end()) {
        return found->is_number_integer() ? std::optional(found->get<std::int64_t>()) : std::nullopt;
      }
    }
    return 0;
  };
  const auto seconds = part({"sec", "seconds"});
  const auto nanoseconds = part({"nsec", "nanosec", "nanos"});
  std::int64_t ns = 0;
  if (!seconds || !nanoseconds || __builtin_mul_overflow(*seconds, std::int64_t{1'000'000'000}, &ns) ||
      __builtin_add_overflow(ns, *nanoseconds, &ns)) {
    return std::nullopt;
  }
  return tf::TimePoint{ns};
}

}  // namespace

/// Fills a row from a parsed message. What fails leaves the name of its field.
class JsonRunner {
 public:
  JsonRunner(const JsonPlan& plan, std::size_t message_bytes, Buffers& buffers)
      : plan_(plan), row_budget_(rowBudget(message_bytes)), buffers_(buffers) {}

  bool run(std::size_t index, const Json& object, void* row) {
    if (!object.is_object()) {
      return false;
    }
    for (const JsonPlan::Field& field : plan_.rows_[index]) {
      const Json* value = &object;
      for (const std::string& name : field.path) {
        const auto found = value->is_object() ? value->find(name) : value->end();
        if (found == value->end()) {
          value = nullptr;
          break;
        }
        value = &*found;
      }
      if (value == nullptr ? !clear(field, row) : !take(field, *value, row)) {
        if (failed_field.empty()) {
          failed_field = field.path.back();
        }
        return false;
      }
    }
    return true;
  }

  std::string failed_field;
  bool is_over_budget = false;
  std::size_t byte_count = 0;

 private:
  /// Numbers that are left out are 0, unless another spelling of the field has filled them.
  static bool clear(const JsonPlan::Field& field, void* row) {
    void* slot = field.binding.locate(row);
    switch (field.binding.is_optional ? SlotKind::Text : field.binding.kind) {
      case SlotKind::Double:
        *static_cast<double*>(slot) = 0.0;
        break;
      case SlotKind::Float:
        *static_cast<float*>(slot) = 0.0F;
        break;
      case SlotKind::Uint32:
      case SlotKind::Int32:
        std::memset(slot, 0, sizeof(std::uint32_t));
        break;
      case SlotKind::Bool:
        *static_cast<bool*>(slot) = false;
        break;
      default:
        break;
    }
    return true;
  }

  template <typename T, typename From>
  static bool store(void* slot, const std::optional<From>& value) {
    if (!value) {
      return false;
    }
    *static_cast<T*>(slot) = static_cast<T>(*value);
    return true;
  }
  template <typename T, typename Convert>
  bool storeMany(const Json& value, void* slot, const Convert& convert) {
    if (!value.is_array()) {
      return false;
    }
    auto& out = *static_cast<std::vector<T>*>(slot);
    out.reserve(value.size());
    for (const Json& element : value) {
      const auto converted = convert(element);
      if (!converted) {
        return false;
      }
      out.push_back(static_cast<T>(*converted));
    }
    return true;
  }

  bool take(const JsonPlan::Field& field, const Json& value, void* row) {
    void* slot = field.binding.locate(row);
    const auto textOf = [](const Json& text) {
      return text.is_string() ? std::optional<std::string_view>(text.get_ref<const std::string&>()) : std::nullopt;
    };
    switch (field.binding.kind) {
      case SlotKind::Double:
        return store<double>(slot, realOf(value));
      case SlotKind::Float:
        return store<float>(slot, realOf(value));
      case SlotKind::Uint32:
      case SlotKind::Int32: {
        const auto bits = bitsOf(value);
        if (bits) {
          std::memcpy(slot, &*bits, sizeof(*bits));
        }
        return bits.has_value();
      }
      case SlotKind::Bool:
        *static_cast<bool*>(slot) = value.is_boolean() && value.get<bool>();
        return value.is_boolean();
      case SlotKind::Text:
        return store<std::string_view>(slot, textOf(value));
      case SlotKind::String:
        return store<std::string>(slot, textOf(value));
      case SlotKind::Bytes:
        return bytes(value, *static_cast<std::span<const std::byte>*>(slot));
      case SlotKind::Stamp:
        return store<tf::TimePoint>(slot, timeOf(value));
      case SlotKind::Doubles:
        return storeMany<double>(value, slot, realOf);
      case SlotKind::Floats:
        return storeMany<float>(value, slot, realOf);
      case SlotKind::Uint32s:
        return storeMany<std::uint32_t>(value, slot, bitsOf);
      case SlotKind::Texts:
        return storeMany<std::string_view>(value, slot, textOf);
      case SlotKind::Row:
        return run(field.target, value, slot);
      case SlotKind::Rows:
        return rows(field, value, slot);
    }
    return false;
  }

  bool rows(const JsonPlan::Field& field, const Json& value, void* slot) {
    if (!value.is_array()) {
      return false;
    }
    if (value.size() > row_budget_ / field.binding.row_bytes) {
      is_over_budget = true;
      return false;
    }
    row_budget_ -= value.size() * field.binding.row_bytes;
    for (const Json& element : value) {
      if (!run(field.target, element, field.binding.append(slot, value.size()))) {
        return false;
      }
    }
    return true;
  }

  bool bytes(const Json& value, std::span<const std::byte>& out) {
    auto decoded = value.is_string() ? decodeBase64(value.get_ref<const std::string&>()) : std::nullopt;
    if (!decoded) {
      return false;
    }
    out = buffers_.emplace_back(*std::move(decoded));
    byte_count += out.size();
    return true;
  }

  const JsonPlan& plan_;
  std::uint64_t row_budget_;
  Buffers& buffers_;
};

JsonPlan JsonPlan::compile(const Shape& shape) {
  JsonPlan plan;
  plan.root_ = plan.add(shape);
  return plan;
}

std::size_t JsonPlan::add(const Shape& shape) {
  std::vector<Field> fields;
  for (const Shape::Binding& binding : shape.bindings()) {
    Field field;
    field.binding = binding;
    for (std::string left = binding.path; !left.empty();) {
      const std::size_t dot = left.find('.');
      field.path.push_back(left.substr(0, dot));
      left = dot == std::string::npos ? "" : left.substr(dot + 1);
    }
    field.target = binding.row == nullptr ? 0 : add(*binding.row);
    fields.push_back(std::move(field));
  }
  rows_.push_back(std::move(fields));
  return rows_.size() - 1;
}

std::expected<JsonPlan::Kept, scenegraph::DecodeError> JsonPlan::decode(std::span<const std::byte> message,
                                                                        void* row) const {
  const auto bad = [&](std::string code, const auto&... parts) {
    return std::unexpected(
        scenegraph::DecodeError{std::move(code), sentence("the message of ", message.size(), " bytes ", parts...)});
  };
  auto json = std::make_shared<Json>();
  const auto* text = reinterpret_cast<const char*>(message.data());
  try {
    *json = Json::parse(text, text + message.size());
  } catch (const Json::parse_error& error) {
    return bad("BadJson", "is not JSON from byte ", error.byte, " on");
  } catch (const Json::exception& error) {
    return bad("BadJson", "is not JSON: ", error.what());
  }
  auto buffers = std::make_shared<Buffers>();
  JsonRunner runner(*this, message.size(), *buffers);
  if (!runner.run(root_, *json, row)) {
    if (runner.is_over_budget) {
      return bad("TooManyElements", "holds more elements of '", runner.failed_field, "' than are read");
    }
    return runner.failed_field.empty() ? bad("BadJson", "is not an object")
                                       : bad("BadJson", "has a '", runner.failed_field, "' of another kind or range");
  }
  return Kept{std::move(json), std::move(buffers), runner.byte_count};
}

}  // namespace stillframe::ingest
