#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/points/read_value.h"
#include "scenegraph/objects/voxel_grid.h"

namespace stillframe::test {

/// `VoxelBuilder(4, 3, 2).field("cost", FieldType::Uint8, [](auto x, auto y, auto z) { ... }).build()`: cells of 1 m,
/// fields side by side, with `padding` bytes after each cell, row and slice.
class VoxelBuilder {
 public:
  using Value = std::function<double(std::uint32_t x, std::uint32_t y, std::uint32_t z)>;

  VoxelBuilder(std::uint32_t columns, std::uint32_t rows, std::uint32_t slices, std::uint32_t padding = 0)
      : padding_(padding) {
    grid_.column_count = columns;
    grid_.row_count = rows;
    grid_.slice_count = slices;
    grid_.cell_size_m = {1.0, 1.0, 1.0};
    grid_.frame_id = "map";
  }
  VoxelBuilder& frame(const std::string& frame_id) {
    grid_.frame_id = frame_id;
    return *this;
  }
  VoxelBuilder& origin(const tf::RigidTransform& frame_from_grid) {
    grid_.origin = frame_from_grid;
    return *this;
  }
  VoxelBuilder& cell(const glm::dvec3& size_m) {
    grid_.cell_size_m = size_m;
    return *this;
  }
  VoxelBuilder& field(const std::string& name, scenegraph::FieldType type, Value value) {
    grid_.fields.push_back({name, record_bytes_, type});
    record_bytes_ += scenegraph::byteSize(type);
    values_.push_back(std::move(value));
    return *this;
  }
  [[nodiscard]] scenegraph::VoxelGrid build() const {
    scenegraph::VoxelGrid grid = grid_;
    grid.cell_stride = record_bytes_ + padding_;
    grid.row_stride = grid.cell_stride * grid.column_count + padding_;
    grid.slice_stride = grid.row_stride * grid.row_count + padding_;
    auto bytes =
        std::make_shared<std::vector<std::byte>>(std::size_t{grid.slice_stride} * grid.slice_count, std::byte{0xA5});
    for (std::uint32_t z = 0; z < grid.slice_count; ++z) {
      for (std::uint32_t y = 0; y < grid.row_count; ++y) {
        for (std::uint32_t x = 0; x < grid.column_count; ++x) {
          std::byte* const at = bytes->data() + std::size_t{z} * grid.slice_stride + std::size_t{y} * grid.row_stride +
                                std::size_t{x} * grid.cell_stride;
          for (std::size_t i = 0; i < values_.size(); ++i) {
            nodes::withFieldType(grid.fields[i].type, false, [&]<typename T, bool kSwapped>() {
              const T value = static_cast<T>(values_[i](x, y, z));
              std::memcpy(at + grid.fields[i].offset, &value, sizeof value);
            });
          }
        }
      }
    }
    grid.data = {*bytes, bytes};
    return grid;
  }

 private:
  scenegraph::VoxelGrid grid_;
  std::uint32_t padding_;
  std::uint32_t record_bytes_ = 0;
  std::vector<Value> values_;
};

}  // namespace stillframe::test
