#include <cmath>
#include <span>

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kVoxelGrid =
    "builtin_interfaces/Time timestamp\n"
    "string frame_id\n"
    "geometry_msgs/Pose pose\n"
    "uint32 row_count\n"
    "uint32 column_count\n"
    "geometry_msgs/Vector3 cell_size\n"
    "uint32 slice_stride\n"
    "uint32 row_stride\n"
    "uint32 cell_stride\n"
    "foxglove_msgs/PackedElementField[] fields\n"
    "uint8[] data\n" STILLFRAME_SEPARATOR
    "MSG: foxglove_msgs/PackedElementField\n"
    "string name\n"
    "uint32 offset\n"
    "uint8 type\n" STILLFRAME_SEPARATOR
    "MSG: geometry_msgs/Vector3\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n" STILLFRAME_SEPARATOR
    "MSG: builtin_interfaces/Time\n"
    "int32 sec\n"
    "uint32 nanosec\n" STILLFRAME_POSE;

constexpr std::uint32_t kColumns = 124;
constexpr std::uint32_t kRows = 84;
constexpr std::uint32_t kSlices = 14;
constexpr double kCell_m = 0.25;
constexpr double kScale = 0.25;
constexpr double kBesideWall_m = 12.0;  // where it begins along y
constexpr std::uint32_t kCellBytes = 2;

/// A model of the warehouse at a scale of one to four, before its wall, where it hides nothing of what is seen within:
/// what stands there below 3.5 m as voxels, once. 100 where something is, the cells about it less the farther they are,
/// 0 in the open. Beside it the material's reflectivity in percent.
class Voxels final : public Topic {
 public:
  explicit Voxels(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/voxels"; }
  Ros2Type type() const override { return {"foxglove_msgs/msg/VoxelGrid", kVoxelGrid}; }
  std::int64_t periodNs() const override { return 0; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    ingest::CdrWriter cdr;
    cdr.stamp(stage_.start_ns + elapsed_ns).string("map");
    constexpr double kVoxel_m = kScale * kCell_m;
    for (const double value : {-0.5 * kColumns * kVoxel_m, kBesideWall_m, 0.0, 0.0, 0.0, 0.0, 1.0}) {
      cdr.number(value);
    }
    cdr.number(kRows).number(kColumns);
    for (int axis = 0; axis < 3; ++axis) {
      cdr.number(kVoxel_m);
    }
    cdr.number(kCellBytes * kColumns * kRows).number(kCellBytes * kColumns).number(kCellBytes);
    constexpr std::uint8_t kFoxgloveUint8 = 1;
    cdr.length(2).string("cost").number(std::uint32_t{0}).number(kFoxgloveUint8);
    cdr.string("reflectivity").number(std::uint32_t{1}).number(kFoxgloveUint8);
    const auto cells = voxels();
    cdr.byteSequence(std::as_bytes(std::span(cells)));
    return cdr.bytes();
  }

 private:
  [[nodiscard]] std::vector<std::uint8_t> voxels() const {
    std::vector<Top> tops;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t column = 0; column < kColumns; ++column) {
        tops.push_back(
            stage_.world.topAt((column + 0.5 - 0.5 * kColumns) * kCell_m, (row + 0.5 - 0.5 * kRows) * kCell_m));
      }
    }
    std::vector<std::uint8_t> cells;
    cells.reserve(kCellBytes * tops.size() * kSlices);
    for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
      for (const Top& top : tops) {
        const double above_m = (slice + 0.5) * kCell_m - top.height_m;
        const bool stands = top.height_m > 0.5 * kCell_m;
        const double cost = !stands ? 0.0 : above_m <= 0.0 ? 100.0 : 50.0 * std::exp(-above_m / 0.2);
        const double reflectivity =
            above_m <= 0.0 ? 100.0 * static_cast<double>(appearance(top.material).reflectivity) : 0.0;
        cells.push_back(static_cast<std::uint8_t>(cost));
        cells.push_back(static_cast<std::uint8_t>(reflectivity));
      }
    }
    return cells;
  }

  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeVoxels(const Stage& stage) { return std::make_unique<Voxels>(stage); }

}  // namespace stillframe::sample
