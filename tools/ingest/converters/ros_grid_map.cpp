// grid_map_msgs/GridMap: layers of a ring buffer whose indices grow against x and y, turned into records by cell.
#include <memory>
#include <span>
#include <vector>

#include "scenegraph/objects/grid_map.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::GridMap;

struct DimensionRow {
  std::string_view label;
  std::uint32_t size = 0;
};

struct LayerRow {
  std::vector<DimensionRow> dimensions;
  std::uint32_t data_offset = 0;
  std::vector<float> values;
};

struct GridMapRow {
  tf::TimePoint stamp;
  std::string frame_id;
  double resolution = 0.0;
  tf::RigidTransform center;
  std::vector<std::string_view> layers;
  std::vector<LayerRow> data;
  std::uint32_t outer_start = 0;
  std::uint32_t inner_start = 0;
};

/// Sizes of a layer as grid_map counts: `rows` along x, `columns` along y. The outer dimension is the one that a layer
/// steps through slowest; grid_map writes column-major but reads both, told apart by the label.
struct LayerSize {
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  bool is_row_major = false;
};

std::unexpected<scenegraph::DecodeError> bad(std::string message) {
  return std::unexpected(scenegraph::DecodeError{"BadGridMap", std::move(message)});
}

std::expected<LayerSize, scenegraph::DecodeError> sizeOf(const LayerRow& layer, std::string_view name) {
  if (layer.dimensions.size() != 2) {
    return bad(sentence("the layer '", name, "' has ", layer.dimensions.size(), " dimensions, not 2"));
  }
  const bool is_row_major = layer.dimensions[0].label == "row_index";
  const auto [outer, inner] = std::pair(layer.dimensions[0].size, layer.dimensions[1].size);
  const std::uint64_t cells = std::uint64_t{outer} * inner;
  if (layer.data_offset > layer.values.size() || cells > layer.values.size() - layer.data_offset) {
    return bad(sentence("the layer '", name, "' has ", layer.values.size(), " values, fewer than ", outer, " x ", inner,
                        " behind the first ", layer.data_offset));
  }
  return LayerSize{is_row_major ? outer : inner, is_row_major ? inner : outer, is_row_major};
}

/// Writes a row of records, whose cells lie along x, one layer after the other. `column` is the row's in grid_map.
void interleave(const GridMapRow& row, std::span<const LayerSize> sizes, std::uint32_t column, float* records) {
  const std::size_t layers = sizes.size();
  for (std::size_t i = 0; i < layers; ++i) {
    const LayerSize& size = sizes[i];
    const std::size_t step = size.is_row_major ? size.columns : 1;
    const float* const values = row.data[i].values.data() + row.data[i].data_offset +
                                (size.is_row_major ? std::size_t{column} : std::size_t{column} * size.rows);
    // Backwards from the last line of the ring to line 0, and on from the other end.
    const std::uint32_t last = (size.rows - 1 + row.outer_start) % size.rows;
    float* out = records + i;
    for (std::size_t line = std::size_t{last} + 1; line-- > 0; out += layers) {
      *out = values[line * step];
    }
    for (std::size_t line = size.rows; line-- > std::size_t{last} + 1; out += layers) {
      *out = values[line * step];
    }
  }
}

RowDecoder<GridMapRow>::Result convert(GridMapRow& row, const MessageView&) {
  const std::size_t layers = row.layers.size();
  if (layers != row.data.size()) {
    return bad(sentence("the grid map names ", layers, " layers and holds ", row.data.size()));
  }
  LayerSize size;
  std::vector<LayerSize> sizes;
  for (std::size_t i = 0; i < layers; ++i) {
    const auto layer_size = sizeOf(row.data[i], row.layers[i]);
    if (!layer_size) {
      return std::unexpected(layer_size.error());
    }
    if (i > 0 && (layer_size->rows != size.rows || layer_size->columns != size.columns)) {
      return bad(sentence("the layer '", row.layers[i], "' has ", layer_size->rows, " x ", layer_size->columns,
                          " cells, the first ", size.rows, " x ", size.columns));
    }
    size = *layer_size;
    sizes.push_back(size);
  }
  // The start indices are 16-bit on the wire and the sizes are justified by the values that are there.
  if (size.rows > 0 && size.columns > 0 && (row.outer_start >= size.rows || row.inner_start >= size.columns)) {
    return bad(sentence("the start index (", row.outer_start, ", ", row.inner_start, ") lies outside ", size.rows,
                        " x ", size.columns, " cells"));
  }
  constexpr std::uint64_t kMaxStride = 0xFFFFFFFFu;
  if (std::uint64_t{size.rows} * layers * sizeof(float) > kMaxStride) {
    return bad(sentence("a row of ", size.rows, " cells of ", layers, " layers is too long"));
  }
  GridMap map;
  map.stamp = row.stamp;
  map.frame_id = std::move(row.frame_id);
  map.cell_size_m = {row.resolution, row.resolution};
  map.column_count = size.rows;
  map.row_count = size.columns;
  map.cell_stride = static_cast<std::uint32_t>(layers * sizeof(float));
  map.row_stride = map.cell_stride * map.column_count;
  const glm::dvec3 center_from_corner(-0.5 * row.resolution * size.rows, -0.5 * row.resolution * size.columns, 0.0);
  map.origin = row.center;
  const double norm = glm::length(row.center.rotation);
  const glm::dquat unit = norm > 0.0 ? row.center.rotation / norm : glm::dquat(1.0, 0.0, 0.0, 0.0);
  map.origin.translation += unit * center_from_corner;
  const std::size_t floats = std::size_t{size.rows} * size.columns * layers;
  auto records = std::make_shared_for_overwrite<float[]>(floats);
  for (std::size_t i = 0; i < layers; ++i) {
    map.fields.push_back(
        {std::string(row.layers[i]), static_cast<std::uint32_t>(i * sizeof(float)), scenegraph::FieldType::Float32, 1});
  }
  for (std::uint32_t y = 0; y < size.columns && size.rows > 0; ++y) {
    interleave(row, sizes, (size.columns - 1 - y + row.inner_start) % size.columns,
               records.get() + std::size_t{y} * size.rows * layers);
  }
  map.data = {std::as_bytes(std::span(records.get(), floats)), records};
  return finished(std::move(map));
}

}  // namespace

Created rosGridMap(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape dimension;
  dimension.field<&DimensionRow::label>("label").field<&DimensionRow::size>("size");
  Shape layer;
  layer.rows<&LayerRow::dimensions>("layout.dim", std::move(dimension))
      .field<&LayerRow::data_offset>("layout.data_offset")
      .field<&LayerRow::values>("data");
  Shape shape;
  shape
      .field<&GridMapRow::stamp>("header.stamp")  // ROS 2; in ROS 1 the info has it
      .optional()
      .field<&GridMapRow::frame_id>("header.frame_id")
      .optional()
      .field<&GridMapRow::stamp>("info.header.stamp")
      .optional()
      .field<&GridMapRow::frame_id>("info.header.frame_id")
      .optional()
      .field<&GridMapRow::resolution>("info.resolution")
      .row<&GridMapRow::center>("info.pose", poseShape())
      .field<&GridMapRow::layers>("layers")
      .rows<&GridMapRow::data>("data", std::move(layer))
      .field<&GridMapRow::outer_start>("outer_start_index")
      .field<&GridMapRow::inner_start>("inner_start_index");
  return RowDecoder<GridMapRow>::create(schema, message_encoding, shape, convert);
}

}  // namespace stillframe::ingest::converters
