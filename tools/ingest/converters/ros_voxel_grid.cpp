// nav2_msgs/VoxelGrid: one 32-bit word a column of at most 16 cells, unpacked.
#include "scenegraph/objects/voxel_grid.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::VoxelGrid;

struct BitGridRow {
  VoxelGrid grid;
  std::vector<std::uint32_t> columns;
};

/// Cell z of a column is marked when the bits z and z + 16 are both set, unknown when one is, free when none is
/// (nav2_voxel_grid's VoxelGrid::getVoxel).
RowDecoder<BitGridRow>::Result convert(BitGridRow& row, const MessageView&) {
  constexpr std::uint32_t kMaxSlices = 16;
  constexpr std::uint32_t kCellBytes = 2;
  VoxelGrid& grid = row.grid;
  const std::uint64_t cells = std::uint64_t{grid.column_count} * grid.row_count;
  if (grid.slice_count > kMaxSlices || cells > row.columns.size()) {
    return std::unexpected(scenegraph::DecodeError{
        "BadVoxelGrid", sentence("the grid claims ", grid.column_count, " x ", grid.row_count, " x ", grid.slice_count,
                                 " cells; it has ", row.columns.size(), " columns of at most ", kMaxSlices, " cells")});
  }
  if (cells * kCellBytes > 0xFFFFFFFFu) {
    return std::unexpected(scenegraph::DecodeError{
        "BadVoxelGrid", sentence("the grid of ", grid.column_count, " x ", grid.row_count, " columns is too large")});
  }
  grid.cell_stride = kCellBytes;
  grid.row_stride = kCellBytes * grid.column_count;
  grid.slice_stride = grid.row_stride * grid.row_count;
  grid.fields = {{"marked", 0, scenegraph::FieldType::Uint8, 1}, {"unknown", 1, scenegraph::FieldType::Uint8, 1}};
  const std::size_t bytes = std::size_t{grid.slice_stride} * grid.slice_count;
  auto unpacked = std::make_shared_for_overwrite<std::byte[]>(bytes);
  std::byte* out = unpacked.get();
  for (std::uint32_t slice = 0; slice < grid.slice_count; ++slice) {
    for (std::size_t i = 0; i < cells; ++i) {
      const std::uint32_t low = row.columns[i] >> slice & 1u;
      const std::uint32_t high = row.columns[i] >> (slice + kMaxSlices) & 1u;
      *out++ = static_cast<std::byte>(low & high);
      *out++ = static_cast<std::byte>(low ^ high);
    }
  }
  grid.data = {{unpacked.get(), bytes}, unpacked};
  return finished(std::move(grid));
}

}  // namespace

Created rosBitVoxelGrid(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&BitGridRow::grid, &VoxelGrid::stamp>("header.stamp")
      .field<&BitGridRow::grid, &VoxelGrid::frame_id>("header.frame_id")
      .field<&BitGridRow::columns>("data")
      .row<&BitGridRow::grid, &VoxelGrid::origin, &tf::RigidTransform::translation>("origin", vectorShape())
      .row<&BitGridRow::grid, &VoxelGrid::cell_size_m>("resolutions", vectorShape())
      .field<&BitGridRow::grid, &VoxelGrid::column_count>("size_x")
      .field<&BitGridRow::grid, &VoxelGrid::row_count>("size_y")
      .field<&BitGridRow::grid, &VoxelGrid::slice_count>("size_z");
  return RowDecoder<BitGridRow>::create(schema, message_encoding, shape, convert);
}

}  // namespace stillframe::ingest::converters
