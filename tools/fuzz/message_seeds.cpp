// message_seeds OUT: writes what the fuzzers of JSON and protobuf start from: OUT/json and OUT/protobuf.
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/timestamp.pb.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

#include "tools/ingest/converters/converter.h"

using namespace stillframe;

namespace {

using Field = google::protobuf::FieldDescriptorProto;

struct FieldSpec {
  const char* name;
  Field::Type type;
  const char* message = "";
  bool is_repeated = false;
};

void addMessage(google::protobuf::FileDescriptorProto& file, const char* name, std::initializer_list<FieldSpec> specs) {
  auto& message = *file.add_message_type();
  message.set_name(name);
  int number = 0;
  for (const FieldSpec& spec : specs) {
    Field& field = *message.add_field();
    field.set_name(spec.name);
    field.set_number(++number);
    field.set_type(spec.type);
    field.set_label(spec.is_repeated ? Field::LABEL_REPEATED : Field::LABEL_OPTIONAL);
    if (*spec.message != 0) {
      field.set_type_name(spec.message);
    }
  }
}

/// A cloud and a scan of Foxglove.
std::string descriptors() {
  google::protobuf::FileDescriptorSet set;
  auto& file = *set.add_file();
  file.set_name("seed.proto");
  file.set_package("foxglove");
  file.set_syntax("proto3");
  file.add_dependency("google/protobuf/timestamp.proto");
  constexpr const char* kTime = ".google.protobuf.Timestamp";
  addMessage(file, "Vector3", {{"x", Field::TYPE_DOUBLE}, {"y", Field::TYPE_FLOAT}, {"z", Field::TYPE_SINT32}});
  addMessage(
      file, "Quaternion",
      {{"x", Field::TYPE_DOUBLE}, {"y", Field::TYPE_DOUBLE}, {"z", Field::TYPE_INT64}, {"w", Field::TYPE_DOUBLE}});
  addMessage(file, "Pose",
             {{"position", Field::TYPE_MESSAGE, "Vector3"}, {"orientation", Field::TYPE_MESSAGE, "Quaternion"}});
  addMessage(file, "Packed",
             {{"name", Field::TYPE_STRING}, {"offset", Field::TYPE_FIXED32}, {"type", Field::TYPE_INT32}});
  addMessage(file, "PointCloud",
             {{"timestamp", Field::TYPE_MESSAGE, kTime},
              {"frame_id", Field::TYPE_STRING},
              {"pose", Field::TYPE_MESSAGE, "Pose"},
              {"point_stride", Field::TYPE_FIXED32},
              {"fields", Field::TYPE_MESSAGE, "Packed", true},
              {"data", Field::TYPE_BYTES}});
  addMessage(file, "LaserScan",
             {{"timestamp", Field::TYPE_MESSAGE, kTime},
              {"frame_id", Field::TYPE_STRING},
              {"pose", Field::TYPE_MESSAGE, "Pose"},
              {"start_angle", Field::TYPE_DOUBLE},
              {"end_angle", Field::TYPE_DOUBLE},
              {"ranges", Field::TYPE_DOUBLE, "", true},
              {"intensities", Field::TYPE_SINT64, "", true}});
  return set.SerializeAsString();
}

char schemaByte(std::string_view name) {
  const auto converters = ingest::converterTypes();
  return static_cast<char>(std::ranges::find(converters, name, &ingest::ConverterType::schema) - converters.begin());
}

bool write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream out(path, std::ios::binary);
  out << bytes;
  return out.good();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  const std::filesystem::path out = argv[1];
  std::filesystem::create_directories(out / "json");
  std::filesystem::create_directories(out / "protobuf");
  const std::string cloud_json =
      R"({"timestamp":{"sec":3,"nsec":4},"frame_id":"a","pose":{"position":{"x":1}},"point_stride":3,)"
      R"("fields":[{"name":"a","offset":0,"type":7}],"data":"AQIDBAUG"})";
  const std::string scene_json =
      R"({"deletions":[{"type":1}],"entities":[{"id":"a","timestamp":"2024-02-29T12:00:00.25+01:00","lifetime":"1.5s",)"
      R"("lines":[{"type":2,"points":[{"x":1,"y":null,"z":"NaN"}],"colors":[{"a":1}],"indices":[0]}]}]})";
  const std::string definition = descriptors();
  const auto protobuf = [&](std::string_view name, const std::string& message) {
    std::string bytes(1, schemaByte(name));
    bytes += static_cast<char>(definition.size() & 0xFFu);
    bytes += static_cast<char>(definition.size() >> 8);
    return bytes + definition + message;
  };
  using namespace std::string_literals;
  const std::string cloud =
      "\x0A\x04\x08\x01\x10\x02\x12\x01\x61\x1A\x0B\x0A\x09\x09\0\0\0\0\0\0\xF0\x3F\x25\x03\0\0\0"
      "\x2A\x05\x0A\x01\x61\x18\x07\x32\x03\x61\x62\x63"s;
  const std::string scan = "\x21\0\0\0\0\0\0\xF0\x3F\x32\x10\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\xF0\x3F\x3A\x02\x01\x02"s;
  const bool is_good = write(out / "json/cloud", schemaByte("foxglove.PointCloud") + cloud_json) &&
                       write(out / "json/scene", schemaByte("foxglove.SceneUpdate") + scene_json) &&
                       write(out / "protobuf/cloud", protobuf("foxglove.PointCloud", cloud)) &&
                       write(out / "protobuf/scan", protobuf("foxglove.LaserScan", scan));
  return is_good ? 0 : 1;
}
