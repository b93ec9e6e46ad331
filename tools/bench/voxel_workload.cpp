#include "tools/bench/voxel_workload.h"

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace stillframe::bench {
namespace {

class OneGrid final : public scenegraph::EntrySource {
 public:
  explicit OneGrid(scenegraph::VoxelGrid grid) : grid_(scenegraph::AnyObject::make(std::move(grid))) {}
  [[nodiscard]] std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const scenegraph::TopicInfo&, const scenegraph::Entry&) const override {
    return grid_;
  }

 private:
  scenegraph::AnyObject grid_;
};

}  // namespace

scenegraph::VoxelGrid makeVoxels(std::uint32_t side, bool with_noise) {
  scenegraph::VoxelGrid grid;
  grid.frame_id = "map";
  grid.cell_size_m = glm::dvec3(0.05);
  grid.column_count = grid.row_count = grid.slice_count = side;
  grid.fields = {{"occupancy", 0, scenegraph::FieldType::Uint8, 1}};
  if (with_noise) {
    grid.fields.push_back({"noisy", 1, scenegraph::FieldType::Float32, 1});
  }
  grid.cell_stride = with_noise ? 5 : 1;
  grid.row_stride = grid.cell_stride * side;
  grid.slice_stride = grid.row_stride * side;
  std::vector<double> floor(std::size_t{side} * side);
  const double scale = 256.0 / side;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const std::size_t row = i / side;
    const double x = scale * static_cast<double>(i % side);
    const double y = scale * static_cast<double>(row);
    floor[i] = 40.0 + 15.0 * std::sin(0.05 * x) * std::cos(0.04 * y);
  }
  const auto bytes = std::make_shared<std::vector<std::byte>>(std::size_t{grid.slice_stride} * side);
  std::byte* out = bytes->data();
  std::mt19937 random(5);
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x, out += grid.cell_stride) {
        // Balls of 20 cells on a lattice of 64, all in cells of a grid of 256.
        const auto offset = [&](std::uint32_t at) { return std::fmod(scale * at, 64.0) - 32.0; };
        const double dx = offset(x);
        const double dy = offset(y);
        const double dz = offset(z);
        const bool is_solid = scale * z < floor[std::size_t{y} * side + x] || dx * dx + dy * dy + dz * dz < 20.0 * 20.0;
        out[0] = static_cast<std::byte>(is_solid ? 100 : 0);
        if (with_noise) {
          const float noisy = (is_solid ? 100.0F : 0.0F) + static_cast<float>(random() >> 8U) * 0x1p-24F;
          std::memcpy(out + 1, &noisy, sizeof noisy);
        }
      }
    }
  }
  grid.data = {*bytes, bytes};
  return grid;
}

std::shared_ptr<scenegraph::Dataset> datasetOfVoxels(std::uint32_t side, bool with_noise) {
  auto dataset = std::make_shared<scenegraph::Dataset>("voxels");
  scenegraph::VoxelGrid grid = makeVoxels(side, with_noise);
  const std::size_t bytes = grid.byteSize();
  scenegraph::TopicInfo info;
  info.name = "/voxels";
  info.type = scenegraph::ObjectType::VoxelGrid;
  const auto topic = dataset->store().addTopic(info, std::make_shared<OneGrid>(std::move(grid)));
  const scenegraph::Entry entry{.log_time = {0}, .payload_bytes = bytes};
  dataset->store().append(topic, {&entry, 1});
  return dataset;
}

}  // namespace stillframe::bench
