// The compiler of WirePlan: from a definition and a shape to steps.
#include <limits>
#include <optional>

#include "tools/ingest/sentence.h"
#include "tools/ingest/wire_plan.h"

namespace stillframe::ingest {

namespace {

using Array = FieldDefinition::Array;

/// Size and alignment of a value of fixed size; size 0 for texts and messages.
struct Extent {
  std::uint8_t size = 0;
  std::uint8_t alignment = 1;
};

Extent extentOf(WireType type) {
  switch (type) {
    case WireType::Bool:
    case WireType::Int8:
    case WireType::Uint8:
      return {1, 1};
    case WireType::Int16:
    case WireType::Uint16:
      return {2, 2};
    case WireType::Int32:
    case WireType::Uint32:
    case WireType::Float32:
      return {4, 4};
    case WireType::Int64:
    case WireType::Uint64:
    case WireType::Float64:
      return {8, 8};
    case WireType::Time:
    case WireType::Duration:
      return {8, 4};
    case WireType::String:
    case WireType::WString:
    case WireType::Message:
      break;
  }
  return {};
}

bool fits(WireType type, SlotKind slot) {
  const std::size_t size = extentOf(type).size;
  const bool is_float = type == WireType::Float32 || type == WireType::Float64;
  const bool is_number = size > 0 && type != WireType::Time && type != WireType::Duration;
  switch (slot) {
    case SlotKind::Double:
    case SlotKind::Float:
    case SlotKind::Doubles:
    case SlotKind::Floats:
      return is_number && type != WireType::Bool;
    case SlotKind::Uint32:
    case SlotKind::Int32:
    case SlotKind::Uint32s:
      return is_number && !is_float && size <= 4;
    case SlotKind::Bool:
      return is_number && !is_float;
    case SlotKind::Text:
    case SlotKind::String:
    case SlotKind::Texts:
      return type == WireType::String;
    case SlotKind::Bytes:
      return size == 1;
    case SlotKind::Stamp:
    case SlotKind::Row:
    case SlotKind::Rows:
      break;
  }
  return false;
}

std::uint64_t saturatingAdd(std::uint64_t a, std::uint64_t b) {
  return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

std::uint64_t saturatingMultiply(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b ? std::numeric_limits<std::uint64_t>::max()
                                                                     : a * b;
}

/// A binding with the part of its path that is still to go.
struct Wanted {
  const Shape::Binding* binding = nullptr;
  std::string path;
};

}  // namespace

class PlanCompiler {
 public:
  explicit PlanCompiler(const MessageDefinitions& definitions)
      : definitions_(definitions), skip_of_(definitions.messages.size()) {
    plan_.is_ros1_ = definitions.language == DefinitionLanguage::Ros1;
  }

  std::expected<WirePlan, std::string> compile(const Shape& shape) {
    auto root = compileRow(0, shape);
    if (!root) {
      return std::unexpected(std::move(root).error());
    }
    plan_.root_ = *root;
    return std::move(plan_);
  }

 private:
  using Op = WirePlan::Op;
  using OpKind = WirePlan::OpKind;
  using Steps = WirePlan::Steps;
  using Result = std::expected<void, std::string>;

  std::expected<std::size_t, std::string> compileRow(std::size_t message, const Shape& shape) {
    std::vector<Wanted> wanted;
    for (const Shape::Binding& binding : shape.bindings()) {
      wanted.push_back({&binding, binding.path});
    }
    Steps steps;
    if (Result done = compileMessage(message, wanted, steps); !done) {
      return std::unexpected(std::move(done).error());
    }
    return keep(std::move(steps));
  }

  /// Appends the steps of one message, in place of it; fields that are wanted are looked into.
  Result compileMessage(std::size_t message, std::vector<Wanted> wanted, Steps& steps) {
    const MessageDefinition& definition = definitions_.messages[message];
    for (const FieldDefinition& field : definition.fields) {
      std::vector<Wanted> inside;
      const Shape::Binding* leaf = nullptr;
      std::erase_if(wanted, [&](const Wanted& one) {
        if (one.path == field.name) {
          leaf = one.binding;
          return true;
        }
        if (one.path.starts_with(field.name) && one.path[field.name.size()] == '.') {
          inside.push_back({one.binding, one.path.substr(field.name.size() + 1)});
          return true;
        }
        return false;
      });
      Result done;
      if (leaf != nullptr) {
        done = bind(definition, field, *leaf, steps);
      } else if (inside.empty()) {
        skip(field, steps);
      } else if (field.type == WireType::Message && field.array == Array::None) {
        done = compileMessage(field.message, std::move(inside), steps);
      } else {
        done = std::unexpected(sentence(definition.name, " has no field '", field.name, ".", inside[0].path, "'"));
      }
      if (!done) {
        return done;
      }
    }
    for (const Wanted& missing : wanted) {
      if (!missing.binding->is_optional) {
        return std::unexpected(sentence(definition.name, " has no field '", missing.path, "'"));
      }
    }
    if (definition.fields.empty()) {
      skipEmpty(steps);
    }
    return {};
  }

  Result bind(const MessageDefinition& definition, const FieldDefinition& field, const Shape::Binding& binding,
              Steps& steps) {
    const auto mismatch = [&] {
      return std::unexpected(sentence("the field '", field.name, "' of ", definition.name, " has an unexpected type"));
    };
    Op op;
    op.type = field.type;
    op.slot = binding.kind;
    op.locate = binding.locate;
    op.append = binding.append;
    op.row_bytes = binding.row_bytes;
    op.is_sequence = field.array == Array::Sequence;
    op.count = field.array == Array::Fixed ? field.length : 1;
    const bool is_array = field.array != Array::None;
    switch (binding.kind) {
      case SlotKind::Row:
      case SlotKind::Rows: {
        if (is_array != (binding.kind == SlotKind::Rows) || field.type != WireType::Message) {
          return mismatch();
        }
        const auto target = compileRow(field.message, *binding.row);
        if (!target) {
          return std::unexpected(target.error());
        }
        op.kind = is_array ? OpKind::Rows : OpKind::Row;
        op.target = *target;
        add(steps, op, field.name, repeated(op, plan_.steps_[*target].min_bytes));
        return {};
      }
      case SlotKind::Stamp: {
        const auto seconds = secondsType(field);
        if (is_array || !seconds) {
          return mismatch();
        }
        op.kind = OpKind::Stamp;
        op.type = *seconds;
        add(steps, op, field.name, 8);
        return {};
      }
      case SlotKind::Bytes:
        if (!is_array || !fits(field.type, binding.kind)) {
          return mismatch();
        }
        op.kind = OpKind::Bytes;
        add(steps, op, field.name, repeated(op, 1));
        return {};
      case SlotKind::Doubles:
      case SlotKind::Floats:
      case SlotKind::Uint32s:
      case SlotKind::Texts: {
        if (!is_array || !fits(field.type, binding.kind)) {
          return mismatch();
        }
        const Extent extent = extentOf(field.type);
        op.kind = binding.kind == SlotKind::Texts ? OpKind::Texts : OpKind::Numbers;
        op.size = extent.size;
        op.alignment = extent.alignment;
        add(steps, op, field.name, repeated(op, extent.size > 0 ? extent.size : 4));
        return {};
      }
      case SlotKind::Text:
      case SlotKind::String:
      case SlotKind::Double:
      case SlotKind::Float:
      case SlotKind::Uint32:
      case SlotKind::Int32:
      case SlotKind::Bool:
        break;
    }
    if (is_array || !fits(field.type, binding.kind)) {
      return mismatch();
    }
    const bool is_text = field.type == WireType::String;
    op.kind = is_text ? OpKind::Text : OpKind::Number;
    add(steps, op, field.name, is_text ? 4 : extentOf(field.type).size);
    return {};
  }

  /// Type of the seconds of a time: a ROS 1 primitive, or a message of just seconds and nanoseconds.
  [[nodiscard]] std::optional<WireType> secondsType(const FieldDefinition& field) const {
    if (field.type == WireType::Time || field.type == WireType::Duration) {
      return field.type == WireType::Time ? WireType::Uint32 : WireType::Int32;
    }
    if (field.type != WireType::Message) {
      return std::nullopt;
    }
    const auto& parts = definitions_.messages[field.message].fields;
    const auto isPart = [](const FieldDefinition& part) {
      return part.array == Array::None && (part.type == WireType::Int32 || part.type == WireType::Uint32);
    };
    if (parts.size() != 2 || !isPart(parts[0]) || !isPart(parts[1]) || !parts[0].name.starts_with("sec") ||
        !parts[1].name.starts_with("nano")) {
      return std::nullopt;
    }
    return parts[0].type;
  }

  void skip(const FieldDefinition& field, Steps& steps) {
    Op op;
    op.is_sequence = field.array == Array::Sequence;
    op.count = field.array == Array::Fixed ? field.length : 1;
    const Extent extent = extentOf(field.type);
    if (extent.size > 0) {
      op.kind = op.is_sequence ? OpKind::SkipSequence : OpKind::Skip;
      op.alignment = extent.alignment;
      op.size = std::uint64_t{extent.size} * op.count;
      if (op.size > 0) {
        add(steps, op, field.name, repeated(op, extent.size));
      }
      return;
    }
    const std::size_t target = field.type == WireType::Message ? skipOf(field.message) : skipText(field.type);
    const std::uint64_t element_bytes = plan_.steps_[target].min_bytes;
    if (element_bytes == 0) {
      op.kind = OpKind::SkipSequence;  // elements without bytes: at most their count is there
      op.size = 0;
      if (op.is_sequence) {
        add(steps, op, field.name, 4);
      }
      return;
    }
    op.kind = OpKind::SkipMany;
    op.target = target;
    if (op.is_sequence || op.count > 0) {
      add(steps, op, field.name, repeated(op, element_bytes));
    }
  }

  /// Steps over one message, made once for each.
  std::size_t skipOf(std::size_t message) {
    if (!skip_of_[message]) {
      Steps steps;
      for (const FieldDefinition& field : definitions_.messages[message].fields) {
        skip(field, steps);
      }
      if (definitions_.messages[message].fields.empty()) {
        skipEmpty(steps);
      }
      skip_of_[message] = keep(std::move(steps));
    }
    return *skip_of_[message];
  }

  std::size_t skipText(WireType type) {
    auto& known = type == WireType::WString ? wide_text_ : text_;
    if (!known) {
      Steps steps;
      Op op;
      op.kind = OpKind::SkipText;
      op.size = type == WireType::WString ? 4 : 1;  // Fast-CDR 1 writes 32 bits a character
      op.alignment = static_cast<std::uint8_t>(op.size);
      add(steps, op, "text", 4);
      known = keep(std::move(steps));
    }
    return *known;
  }

  /// ROS 2 puts a byte where a message has no fields, because C has no empty structs.
  void skipEmpty(Steps& steps) const {
    if (!plan_.is_ros1_) {
      Op op;
      op.size = 1;
      add(steps, op, "structure_needs_at_least_one_member", 1);
    }
  }

  static std::uint64_t repeated(const Op& op, std::uint64_t element_bytes) {
    return op.is_sequence ? 4 : saturatingMultiply(op.count, element_bytes);
  }
  static void add(Steps& steps, const Op& op, std::string name, std::uint64_t min_bytes) {
    steps.ops.push_back(op);
    steps.names.push_back(std::move(name));
    steps.min_bytes = saturatingAdd(steps.min_bytes, min_bytes);
  }
  std::size_t keep(Steps steps) {
    plan_.steps_.push_back(std::move(steps));
    return plan_.steps_.size() - 1;
  }

  const MessageDefinitions& definitions_;
  WirePlan plan_;
  std::vector<std::optional<std::size_t>> skip_of_;
  std::optional<std::size_t> text_;
  std::optional<std::size_t> wide_text_;
};

std::expected<WirePlan, std::string> WirePlan::compile(const MessageDefinitions& definitions, const Shape& shape) {
  return PlanCompiler(definitions).compile(shape);
}

}  // namespace stillframe::ingest
