#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/text_format.h>
#include <google/protobuf/timestamp.pb.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tools/ingest/mcap_records.h"

namespace stillframe::ingest::test {

/// Descriptors from a small part of the .proto language (messages, enums and fields; libprotobuf's own parser comes
/// with protoc only), and messages of them as libprotobuf writes them: not by our own code.
class ProtoWriter {
 public:
  explicit ProtoWriter(const std::string& proto) {
    google::protobuf::FileDescriptorProto file;
    file.set_name("test.proto");
    file.set_syntax("proto3");
    file.add_dependency("google/protobuf/timestamp.proto");
    std::string spaced;
    for (const char c : proto) {
      spaced +=
          std::string_view("{};=").find(c) == std::string_view::npos ? std::string(1, c) : std::string{' ', c, ' '};
    }
    std::istringstream tokens(spaced);
    for (std::string token; tokens >> token;) {
      if (token == "package") {
        tokens >> token;
        file.set_package(token);
      } else if (token == "message") {
        readMessage(tokens, *file.add_message_type());
      }
    }
    google::protobuf::Timestamp::descriptor()->file()->CopyTo(set_.add_file());
    *set_.add_file() = file;
    for (const auto& one : set_.file()) {
      EXPECT_NE(pool_.BuildFile(one), nullptr);
    }
  }
  [[nodiscard]] SchemaRecord schema(const std::string& name) const {
    return {1, name, "protobuf", set_.SerializeAsString()};
  }
  /// The bytes of a message given in protobuf's text format.
  [[nodiscard]] std::vector<std::byte> message(const std::string& name, const std::string& text) {
    const auto* descriptor = pool_.FindMessageTypeByName(name);
    EXPECT_NE(descriptor, nullptr) << name;
    const std::unique_ptr<google::protobuf::Message> message(factory_.GetPrototype(descriptor)->New());
    EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, message.get()));
    const std::string bytes = message->SerializeAsString();
    const auto view = std::as_bytes(std::span(bytes));
    return {view.begin(), view.end()};
  }

 private:
  static void readMessage(std::istringstream& tokens, google::protobuf::DescriptorProto& message) {
    std::string token;
    tokens >> token;
    message.set_name(token);
    tokens >> token;  // the brace
    while (tokens >> token && token != "}") {
      if (token == ";") {
        continue;
      }
      if (token == "enum") {
        readEnum(tokens, *message.add_enum_type());
        continue;
      }
      auto& field = *message.add_field();
      const bool is_repeated = token == "repeated";
      if (is_repeated) {
        tokens >> token;
      }
      using Field = google::protobuf::FieldDescriptorProto;
      field.set_label(is_repeated ? Field::LABEL_REPEATED : Field::LABEL_OPTIONAL);
      Field::Type type = Field::TYPE_DOUBLE;
      std::string name = "TYPE_" + token;
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      if (Field::Type_Parse(name, &type)) {
        field.set_type(type);
      } else {
        field.set_type_name(token);
      }
      std::string field_name;
      std::string equals;
      int number = 0;
      tokens >> field_name >> equals >> number;
      field.set_name(field_name);
      field.set_number(number);
    }
  }
  static void readEnum(std::istringstream& tokens, google::protobuf::EnumDescriptorProto& type) {
    std::string token;
    tokens >> token;
    type.set_name(token);
    tokens >> token;  // the brace
    while (tokens >> token && token != "}") {
      if (token != ";") {
        std::string equals;
        int number = 0;
        tokens >> equals >> number;
        type.add_value()->set_name(token);
        type.mutable_value(type.value_size() - 1)->set_number(number);
      }
    }
  }

  google::protobuf::FileDescriptorSet set_;
  google::protobuf::DescriptorPool pool_;
  google::protobuf::DynamicMessageFactory factory_;
};

}  // namespace stillframe::ingest::test
