// nav2's voxel grids, two bits a cell, from the bytes of their messages to the picture.
#include <gmock/gmock.h>

#include <algorithm>

#include "scenegraph/objects/voxel_grid.h"
#include "tests/nodes/scene_picture.h"
#include "tools/ingest/cdr_writer.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;

const char* const kDefinition =
    "std_msgs/Header header\nuint32[] data\ngeometry_msgs/Point32 origin\ngeometry_msgs/Vector3 resolutions\n"
    "uint32 size_x\nuint32 size_y\nuint32 size_z\n"
    "===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "===\nMSG: geometry_msgs/Point32\nfloat32 x\nfloat32 y\nfloat32 z\n"
    "===\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";

class BitVoxels : public ScenePictureTest {
 protected:
  /// A row of columns along x with cells of 1 m, its corner at the map's origin.
  void openColumns(const std::vector<std::uint32_t>& columns, std::uint32_t slices) {
    ingest::CdrWriter cdr;
    cdr.header(1, "map").length(columns.size());
    for (const std::uint32_t column : columns) {
      cdr.number(column);
    }
    cdr.number(0.0F).number(0.0F).number(0.0F);
    cdr.number(1.0).number(1.0).number(1.0);
    cdr.number(static_cast<std::uint32_t>(columns.size())).number(1U).number(slices);
    const ingest::SchemaRecord schema{1, "nav2_msgs/msg/VoxelGrid", "ros2msg", kDefinition};
    const auto made = ingest::makeDecoder(&schema, "cdr", "/voxels");
    ASSERT_EQ(made.type, ObjectType::VoxelGrid) << made.unsupported_reason;
    const auto object = made.decoder->decode({cdr.bytes(), nullptr, 1, {0}});
    ASSERT_TRUE(object) << object.error().message;
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "base")
             .topic("/voxels", ObjectType::VoxelGrid)
             .at(1_s, *object->get<scenegraph::VoxelGrid>())
             .build(),
         "map");
  }
  /// Cells that are seen from the front, 10 pixels a metre: 'x' or '.', the upmost slice first.
  std::vector<std::string> seen(int columns, int slices) {
    scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({0, -20, 0}, {0, 0, 0}, {0, 0, 1})};
    view.is_orthographic = true;
    view.vertical_extent_m = 40;
    const auto picture = draw(1_s, view, 400, 400);
    std::vector<std::string> rows;
    for (int slice = slices; slice-- > 0;) {
      std::string& row = rows.emplace_back();
      for (int column = 0; column < columns; ++column) {
        row += pixel(picture, 205 + 10 * column, 194 - 10 * slice) == Bytes3{0, 0, 0} ? '.' : 'x';
      }
    }
    return rows;
  }
};

TEST_F(BitVoxels, ShowMarkedCellsFirstAndUnknownOnesWhenAsked) {
  const std::uint32_t marked_at_0 = 0x00010001;
  const std::uint32_t unknown_at_1 = 0x00000002;
  const std::uint32_t both = 0x00010001 | 0x00020000;  // marked below, unknown above
  openColumns({marked_at_0, 0, unknown_at_1, both, 0x00040004}, 3);
  auto& layer = add("/voxels", {{"color_field", "flat"}});
  EXPECT_THAT(seen(5, 3), testing::ElementsAre("....x", ".....", "x..x."));
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_EQ(layer.counts()[1].second, 3U);
  ASSERT_TRUE(layer.applySettings({{"draw_field", "unknown"}}));
  EXPECT_THAT(seen(5, 3), testing::ElementsAre(".....", "..xx.", "....."));
  EXPECT_EQ(layer.counts()[1].second, 2U);
}

TEST_F(BitVoxels, HaveSixteenSlicesAtMost) {
  openColumns({0xFFFFFFFF, 0x80008000, 0x0000FFFF}, 16);
  add("/voxels", {{"color_field", "flat"}});
  const auto rows = seen(3, 16);
  EXPECT_EQ(rows.front(), "xx.");
  EXPECT_EQ(std::ranges::count(rows, "x.."), 15);
}

}  // namespace
}  // namespace stillframe::test
