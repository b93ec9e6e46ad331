// The compiler of ProtoPlan: from descriptors and a shape to fields by number.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/descriptor_database.h>
#include <google/protobuf/duration.pb.h>
#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/timestamp.pb.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <set>
#include <utility>

#include "tools/ingest/proto_plan.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

namespace pb = google::protobuf;

constexpr std::size_t kMaxSchemaBytes = std::size_t{4} << 20;  // Foxglove's largest has 8 kB

/// Keeps the first complaint about the descriptors.
class Complaints final : public pb::DescriptorPool::ErrorCollector {
 public:
  void AddError(const std::string& file, const std::string& element, const pb::Message*, ErrorLocation,
                const std::string& message) override {
    if (first.empty()) {
      first = sentence(file, ": ", element, ": ", message);
    }
  }
  std::string first;
};

bool isDigits(std::string_view text) {
  return !text.empty() && text.size() < 6 && text.find_first_not_of("0123456789") == std::string_view::npos;
}

const pb::FieldDescriptor* findField(const pb::Descriptor& message, const std::string& name) {
  return isDigits(name) ? message.FindFieldByNumber(std::stoi(name)) : message.FindFieldByName(name);
}

struct Wanted {
  const Shape::Binding* binding = nullptr;
  std::string path;
};

}  // namespace

class ProtoCompiler {
 public:
  std::expected<ProtoPlan, std::string> compile(const pb::Descriptor& root, const Shape& shape) {
    auto message = compileRow(root, shape);
    if (!message) {
      return std::unexpected(std::move(message).error());
    }
    plan_.root_ = *message;
    return std::move(plan_);
  }

 private:
  using Coding = ProtoPlan::Coding;
  using OpKind = ProtoPlan::OpKind;
  using Field = ProtoPlan::Field;
  using Index = std::expected<std::size_t, std::string>;

  Index compileRow(const pb::Descriptor& descriptor, const Shape& shape) {
    std::vector<Wanted> wanted;
    for (const Shape::Binding& binding : shape.bindings()) {
      wanted.push_back({&binding, binding.path});
    }
    return compileMessage(descriptor, wanted);
  }

  Index compileMessage(const pb::Descriptor& descriptor, std::span<const Wanted> wanted) {
    ProtoPlan::Message message;
    std::set<std::string> done;  // names of fields looked into
    for (const Wanted& one : wanted) {
      const std::size_t dot = one.path.find('.');
      const std::string name = one.path.substr(0, dot);
      if (dot != std::string::npos && !done.insert(name).second) {
        continue;
      }
      const pb::FieldDescriptor* field = findField(descriptor, name);
      if (field == nullptr) {
        if (one.binding->is_optional) {
          done.erase(name);
          continue;
        }
        return std::unexpected(sentence(descriptor.full_name(), " has no field '", one.path, "'"));
      }
      auto compiled = dot == std::string::npos ? bind(*field, *one.binding) : lookInto(*field, name, wanted);
      if (!compiled) {
        return std::unexpected(std::move(compiled).error());
      }
      compiled->number = static_cast<std::uint32_t>(field->number());
      compiled->name = field->name();
      message.push_back(*std::move(compiled));
    }
    std::ranges::sort(message, {}, &Field::number);
    plan_.messages_.push_back(std::move(message));
    return plan_.messages_.size() - 1;
  }

  /// The field of a message that is not a row of its own.
  std::expected<Field, std::string> lookInto(const pb::FieldDescriptor& field, const std::string& name,
                                             std::span<const Wanted> wanted) {
    if (field.is_repeated() || field.message_type() == nullptr) {
      return mismatch(field);
    }
    std::vector<Wanted> inside;
    for (const Wanted& one : wanted) {
      if (one.path.starts_with(name + '.')) {
        inside.push_back({one.binding, one.path.substr(name.size() + 1)});
      }
    }
    const Index target = compileMessage(*field.message_type(), inside);
    if (!target) {
      return std::unexpected(target.error());
    }
    Field compiled;
    compiled.kind = OpKind::Inside;
    compiled.target = *target;
    return compiled;
  }

  std::expected<Field, std::string> bind(const pb::FieldDescriptor& field, const Shape::Binding& binding) {
    Field compiled;
    compiled.slot = binding.kind;
    compiled.locate = binding.locate;
    compiled.append = binding.append;
    compiled.row_bytes = binding.row_bytes;
    const SlotKind slot = binding.kind;
    const bool is_many = slot == SlotKind::Doubles || slot == SlotKind::Floats || slot == SlotKind::Uint32s ||
                         slot == SlotKind::Texts || slot == SlotKind::Rows;
    if (field.is_repeated() != is_many) {
      return mismatch(field);
    }
    switch (slot) {
      case SlotKind::Row:
      case SlotKind::Rows: {
        if (field.message_type() == nullptr) {
          return mismatch(field);
        }
        const Index target = compileRow(*field.message_type(), *binding.row);
        if (!target) {
          return std::unexpected(target.error());
        }
        compiled.kind = is_many ? OpKind::Rows : OpKind::Row;
        compiled.target = *target;
        return compiled;
      }
      case SlotKind::Stamp:
        compiled.kind = OpKind::Stamp;
        return isTime(field.message_type()) ? compiled : mismatch(field);
      case SlotKind::Text:
      case SlotKind::String:
      case SlotKind::Texts:
        compiled.kind = is_many ? OpKind::Texts : OpKind::Text;
        return field.type() == pb::FieldDescriptor::TYPE_STRING ? compiled : mismatch(field);
      case SlotKind::Bytes:
        compiled.kind = OpKind::Bytes;
        return field.type() == pb::FieldDescriptor::TYPE_BYTES ? compiled : mismatch(field);
      default:
        break;
    }
    const auto coding = codingOf(field);
    const bool is_float = coding == Coding::Float || coding == Coding::Double;
    const bool is_integer_slot = slot == SlotKind::Uint32 || slot == SlotKind::Int32 || slot == SlotKind::Uint32s;
    const bool is_wide = field.cpp_type() == pb::FieldDescriptor::CPPTYPE_INT64 ||
                         field.cpp_type() == pb::FieldDescriptor::CPPTYPE_UINT64;
    if (!coding || (is_float && (is_integer_slot || slot == SlotKind::Bool)) || (is_wide && is_integer_slot)) {
      return mismatch(field);
    }
    compiled.coding = *coding;
    compiled.kind = is_many ? OpKind::Numbers : OpKind::Number;
    return compiled;
  }

  static std::expected<Field, std::string> mismatch(const pb::FieldDescriptor& field) {
    return std::unexpected(sentence("the field '", field.full_name(), "' has an unexpected type"));
  }

  /// google.protobuf.Timestamp and Duration: seconds = 1, nanos = 2.
  static bool isTime(const pb::Descriptor* message) {
    const auto isInteger = [&](int number, pb::FieldDescriptor::Type type) {
      const pb::FieldDescriptor* field = message->FindFieldByNumber(number);
      return field != nullptr && !field->is_repeated() && field->type() == type;
    };
    return message != nullptr && isInteger(1, pb::FieldDescriptor::TYPE_INT64) &&
           isInteger(2, pb::FieldDescriptor::TYPE_INT32);
  }

  static std::optional<Coding> codingOf(const pb::FieldDescriptor& field) {
    using Type = pb::FieldDescriptor;
    switch (field.type()) {
      case Type::TYPE_FLOAT:
        return Coding::Float;
      case Type::TYPE_DOUBLE:
        return Coding::Double;
      case Type::TYPE_INT32:
      case Type::TYPE_ENUM:
        return Coding::Varint32;
      case Type::TYPE_INT64:
        return Coding::Varint64;
      case Type::TYPE_UINT32:
      case Type::TYPE_UINT64:
      case Type::TYPE_BOOL:
        return Coding::Unsigned;
      case Type::TYPE_SINT32:
      case Type::TYPE_SINT64:
        return Coding::ZigZag;
      case Type::TYPE_FIXED32:
        return Coding::Fixed32;
      case Type::TYPE_FIXED64:
        return Coding::Fixed64;
      case Type::TYPE_SFIXED32:
        return Coding::Signed32;
      case Type::TYPE_SFIXED64:
        return Coding::Signed64;
      default:
        return std::nullopt;
    }
  }

  ProtoPlan plan_;
};

std::expected<ProtoPlan, std::string> ProtoPlan::compile(std::string_view schema, const std::string& name,
                                                         const Shape& shape) {
  if (schema.size() > kMaxSchemaBytes) {
    return std::unexpected(
        sentence("its descriptors have ", schema.size(), " bytes, more than the ", kMaxSchemaBytes, " that are read"));
  }
  const pb::LogSilencer silencer;  // what libprotobuf has to say is in the reason
  try {
    pb::FileDescriptorSet set;
    if (!set.ParseFromArray(schema.data(), static_cast<int>(schema.size()))) {
      return std::unexpected(sentence("its ", schema.size(), " bytes are not a FileDescriptorSet"));
    }
    for (const auto* known : {pb::Timestamp::descriptor(), pb::Duration::descriptor()}) {
      known->file()->CopyTo(set.add_file());  // often left out, as every reader knows them
    }
    pb::SimpleDescriptorDatabase database;
    std::set<std::string> names;
    for (const pb::FileDescriptorProto& file : set.file()) {
      if (names.insert(file.name()).second) {
        database.Add(file);
      }
    }
    Complaints complaints;
    pb::DescriptorPool pool(&database, &complaints);
    const pb::Descriptor* root = pool.FindMessageTypeByName(name);
    if (root == nullptr) {
      return std::unexpected(complaints.first.empty() ? sentence("its descriptors do not hold '", name, "'")
                                                      : sentence("its descriptors are wrong: ", complaints.first));
    }
    return ProtoCompiler().compile(*root, shape);
  } catch (const std::exception& error) {
    return std::unexpected(sentence("its descriptors are wrong: ", error.what()));
  }
}

}  // namespace stillframe::ingest
