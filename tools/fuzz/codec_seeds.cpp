// codec_seeds OUT: writes the blobs that the codecs' fuzzers start from: OUT/cloudini and OUT/draco.
#include <draco/compression/encode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "tools/sample/cloudini_writer.h"

using namespace stillframe;

namespace {

bool write(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file.good();
}

nodes::cloudini::Header everyField() {
  using nodes::cloudini::ValueType;
  nodes::cloudini::Header header;
  header.width = 6;
  header.point_step = 40;
  header.fields = {
      {"x", 0, ValueType::Float32, 0.01F}, {"y", 4, ValueType::Float32, 0.01F}, {"z", 8, ValueType::Float32, 0.01F},
      {"a", 12, ValueType::Uint8, {}},     {"b", 13, ValueType::Int16, {}},     {"c", 16, ValueType::Uint32, {}},
      {"d", 20, ValueType::Float64, {}},   {"e", 28, ValueType::Int64, {}},     {"f", 36, ValueType::Float32, 0.01F}};
  return header;
}

bool writeCloudinis(const std::filesystem::path& folder) {
  nodes::cloudini::Header header = everyField();
  std::vector<std::byte> points(std::size_t{header.width} * header.point_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = static_cast<std::byte>(i * 37 / 11);
  }
  bool is_written = true;
  for (unsigned i = 0; i < 3 * 3 * 3 * 4; ++i) {
    header.version = 3 + i % 3;
    header.encoding = static_cast<nodes::cloudini::Encoding>(i / 3 % 3);
    header.compression = static_cast<nodes::cloudini::Compression>(i / 9 % 3);
    const auto blob = sample::writeCloudini(
        header, points, {.has_binary_header = i % 2 == 0, .section_mode = static_cast<sample::SectionMode>(i / 27)});
    is_written = write(folder / std::to_string(i), blob) && is_written;
  }
  return is_written;
}

bool writeDraco(const std::filesystem::path& path, const draco::EncoderBuffer& buffer) {
  return write(path, std::as_bytes(std::span(buffer.data(), buffer.size())));
}

bool writeDracoCloud(const std::filesystem::path& path, int method, bool is_quantised) {
  constexpr unsigned kPoints = 20;
  draco::PointCloudBuilder builder;
  builder.Start(kPoints);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 3, draco::DT_UINT8);
  for (unsigned i = 0; i < kPoints; ++i) {
    const auto at = static_cast<float>(i);
    const std::array<float, 3> xyz = {at, at * at, -at};
    const std::array<std::uint8_t, 3> rgb = {static_cast<std::uint8_t>(i), 7, static_cast<std::uint8_t>(200 - i)};
    builder.SetAttributeValueForPoint(position, draco::PointIndex(i), xyz.data());
    builder.SetAttributeValueForPoint(color, draco::PointIndex(i), rgb.data());
  }
  const auto cloud = builder.Finalize(false);
  auto metadata = std::make_unique<draco::AttributeMetadata>();
  metadata->AddEntryString("name", "position");
  cloud->AddAttributeMetadata(position, std::move(metadata));
  draco::ExpertEncoder encoder(*cloud);
  encoder.SetEncodingMethod(method);
  if (is_quantised) {
    encoder.SetAttributeQuantization(position, 10);
  }
  draco::EncoderBuffer buffer;
  return encoder.EncodeToBuffer(&buffer).ok() && writeDraco(path, buffer);
}

bool writeDracoMesh(const std::filesystem::path& path, int method, int speed = 5) {
  constexpr int kFaces = 12;
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(kFaces);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int texture = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (int i = 0; i < kFaces; ++i) {
    const auto at = static_cast<float>(i);
    const std::array<float, 3> a = {at, 0, 0};
    const std::array<float, 3> b = {at + 1, 0, 0};
    const std::array<float, 3> c = {at, 1, at / 2};
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<unsigned>(i)), a.data(), b.data(),
                                      c.data());
    const std::array<float, 2> uv = {at / kFaces, 0.5F};
    builder.SetAttributeValuesForFace(texture, draco::FaceIndex(static_cast<unsigned>(i)), a.data(), uv.data(),
                                      b.data());
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 8);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 8);
  draco::EncoderBuffer buffer;
  return encoder.EncodeMeshToBuffer(*mesh, &buffer).ok() && writeDraco(path, buffer);
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder / "cloudini");
  std::filesystem::create_directories(folder / "draco");
  const bool is_written =
      writeCloudinis(folder / "cloudini") &&
      writeDracoCloud(folder / "draco" / "sequential", draco::POINT_CLOUD_SEQUENTIAL_ENCODING, true) &&
      writeDracoCloud(folder / "draco" / "lossless", draco::POINT_CLOUD_SEQUENTIAL_ENCODING, false) &&
      writeDracoCloud(folder / "draco" / "tree", draco::POINT_CLOUD_KD_TREE_ENCODING, true) &&
      writeDracoMesh(folder / "draco" / "mesh_sequential", draco::MESH_SEQUENTIAL_ENCODING) &&
      writeDracoMesh(folder / "draco" / "mesh_edgebreaker", draco::MESH_EDGEBREAKER_ENCODING) &&
      writeDracoMesh(folder / "draco" / "mesh_textured", draco::MESH_EDGEBREAKER_ENCODING, 0);
  return is_written ? 0 : 1;
}
