#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/grid_map.h"

namespace stillframe::test {

/// `GridMapBuilder(20, 10).layer("elevation", [](auto column, auto row) { ... }).build()`: cells of 1 m, FLOAT32 layers
/// side by side, with `padding` bytes after each cell and row.
class GridMapBuilder {
 public:
  using Value = std::function<double(std::uint32_t column, std::uint32_t row)>;

  GridMapBuilder(std::uint32_t columns, std::uint32_t rows, std::uint32_t padding = 0) : padding_(padding) {
    map_.column_count = columns;
    map_.row_count = rows;
    map_.cell_size_m = {1.0, 1.0};
    map_.frame_id = "map";
  }
  GridMapBuilder& frame(const std::string& frame_id) {
    map_.frame_id = frame_id;
    return *this;
  }
  GridMapBuilder& origin(const tf::RigidTransform& frame_from_grid) {
    map_.origin = frame_from_grid;
    return *this;
  }
  GridMapBuilder& layer(const std::string& name, Value value) {
    map_.fields.push_back({name, static_cast<std::uint32_t>(4 * values_.size()), scenegraph::FieldType::Float32});
    values_.push_back(std::move(value));
    return *this;
  }
  [[nodiscard]] scenegraph::GridMap build() const {
    scenegraph::GridMap map = map_;
    map.cell_stride = static_cast<std::uint32_t>(4 * values_.size()) + padding_;
    map.row_stride = map.cell_stride * map.column_count + padding_;
    auto bytes = std::make_shared<std::vector<std::byte>>(std::size_t{map.row_stride} * map.row_count, std::byte{0xA5});
    for (std::uint32_t row = 0; row < map.row_count; ++row) {
      for (std::uint32_t column = 0; column < map.column_count; ++column) {
        for (std::size_t i = 0; i < values_.size(); ++i) {
          const auto value = static_cast<float>(values_[i](column, row));
          std::memcpy(bytes->data() + std::size_t{row} * map.row_stride + std::size_t{column} * map.cell_stride + 4 * i,
                      &value, sizeof value);
        }
      }
    }
    map.data = {*bytes, bytes};
    return map;
  }

 private:
  scenegraph::GridMap map_;
  std::uint32_t padding_;
  std::vector<Value> values_;
};

}  // namespace stillframe::test
