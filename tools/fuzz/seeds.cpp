// seeds OUT: writes the files that the fuzzers start from: OUT/mcap and OUT/cdr.
#include <filesystem>
#include <fstream>
#include <string>

#include "tools/ingest/cdr_writer.h"
#include "tools/ingest/mcap_writer.h"

using namespace stillframe;

namespace {

const std::string kSection = "\n================\nMSG: ";
const std::string kTransforms =
    "geometry_msgs/TransformStamped[] transforms" + kSection +
    "geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\nTransform transform" + kSection +
    "geometry_msgs/Transform\nVector3 translation\nQuaternion rotation" + kSection +
    "geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z" + kSection +
    "geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w" + kSection +
    "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";
const std::string kCloud =
    "std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\nuint32 point_step\n"
    "uint32 row_step\nuint8[] data\nbool is_dense" +
    kSection + "sensor_msgs/PointField\nuint8 INT8=1\nstring name\nuint32 offset\nuint8 datatype\nuint32 count" +
    kSection + "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";

std::vector<std::byte> transforms(double x) {
  ingest::CdrWriter cdr;
  cdr.length(1).header(1'000'000'000, "map").string("base");
  for (const double value : {x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) {
    cdr.number(value);
  }
  return cdr.bytes();
}

std::vector<std::byte> cloud() {
  ingest::CdrWriter cdr;
  cdr.header(1, "base").number(1u).number(1u).length(1).string("x").number(0u).number(std::uint8_t{7}).number(1u);
  cdr.number(std::uint8_t{0}).number(4u).number(4u).byteSequence(std::vector<std::byte>(4)).number(std::uint8_t{1});
  return cdr.bytes();
}

bool writeMcap(const std::filesystem::path& path, const ingest::McapWriterOptions& options) {
  auto writer = ingest::McapWriter::open(path, options);
  if (!writer) {
    return false;
  }
  const auto tf = (*writer)->addChannel("/tf", "tf2_msgs/msg/TFMessage", "ros2msg", kTransforms, "cdr");
  const auto points = (*writer)->addChannel("/points", "sensor_msgs/PointCloud2", "ros2msg", kCloud, "cdr");
  for (std::uint64_t time = 1; time < 4; ++time) {
    if (!(*writer)->write(tf, time, time, transforms(static_cast<double>(time))) ||
        !(*writer)->write(points, time, time, cloud())) {
      return false;
    }
  }
  return (*writer)->attach("a", "b", 1, {}).has_value() && (*writer)->addMetadata("m", {{"k", "v"}}).has_value() &&
         (*writer)->finish().has_value();
}

bool writeCdr(const std::filesystem::path& path, char schema, const std::string& text,
              const std::vector<std::byte>& message) {
  std::ofstream out(path, std::ios::binary);
  out << schema << text << '\0';
  out.write(reinterpret_cast<const char*>(message.data()), static_cast<std::streamsize>(message.size()));
  return out.good();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  const std::filesystem::path out = argv[1];
  std::filesystem::create_directories(out / "mcap");
  std::filesystem::create_directories(out / "cdr");
  using ingest::Compression;
  bool is_good = writeCdr(out / "cdr/transforms", '\0', kTransforms, transforms(1.0)) &&
                 writeCdr(out / "cdr/cloud", '\3', kCloud, cloud());
  int name = 0;
  for (const Compression compression : {Compression::None, Compression::Lz4, Compression::Zstd}) {
    for (const std::size_t chunk_bytes : {std::size_t{0}, std::size_t{1} << 20}) {
      for (const bool has_summary : {true, false}) {
        // Without CRCs, so that what is behind them is reached.
        is_good = is_good && writeMcap(out / "mcap" / std::to_string(name++),
                                       {compression, chunk_bytes, "ros2", true, has_summary, false});
      }
    }
  }
  return is_good ? 0 : 1;
}
