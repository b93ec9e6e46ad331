#include "nodes/occupancy_grid/grid_tiles.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "nodes/flat_order.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"

namespace stillframe::test {
namespace {

using nodes::FlatKind;

/// A grid of 3 x 2 tiles of 256 cells and less, and patches on it.
class GridTilesTest : public testing::Test {
 protected:
  GridTilesTest() {
    std::vector<std::int8_t> cells(std::size_t{600} * 500);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i] = static_cast<std::int8_t>(i % 7);
    }
    const auto grid = makeGrid(600, cells);
    const auto header = nodes::checkGrid(grid);
    EXPECT_EQ(header->tile_edge, 256U);
    history_ = std::make_unique<nodes::GridHistory>(*header, grid.data.bytes);
  }
  /// Bytes that going to the state after the first `count` patches uploads.
  std::uint64_t uploadOf(std::size_t count) {
    std::vector<std::uint64_t> ids;
    for (std::size_t i = 0; i < count; ++i) {
      ids.push_back(i);
    }
    auto snapshot = std::make_shared<nodes::GridSnapshot>();
    snapshot->header = history_->header();
    snapshot->state = history_->at(ids, [&](std::size_t place) {
      return std::make_shared<const scenegraph::OccupancyGridUpdate>(patches_[place]);
    });
    const std::uint64_t before = tiles_.uploadedBytes();
    tiles_.show(snapshot);
    return tiles_.uploadedBytes() - before;
  }

  std::unique_ptr<nodes::GridHistory> history_;
  std::vector<scenegraph::OccupancyGridUpdate> patches_;
  osg::ref_ptr<osg::MatrixTransform> node_ = new osg::MatrixTransform;
  nodes::GridTiles tiles_{*node_};
};

TEST_F(GridTilesTest, UploadOnlyTilesInWhichACellDiffers) {
  const std::vector<std::int8_t> hundreds(16, 100);
  patches_ = {makePatch(10, 10, 4, hundreds),    // in the first tile, of 256 x 256
              makePatch(10, 10, 4, hundreds),    // the same once more: nothing differs
              makePatch(598, 498, 4, hundreds),  // clipped, in the last tile, of 88 x 244
              makePatch(254, 254, 4, hundreds),  // over four tiles
              makePatch(700, 0, 4, hundreds)};   // outside
  EXPECT_EQ(uploadOf(0), 600U * 500);
  EXPECT_EQ(uploadOf(1), 256U * 256);
  EXPECT_EQ(uploadOf(2), 0U);
  EXPECT_EQ(uploadOf(3), 88U * 244);
  EXPECT_EQ(uploadOf(4), 512U * 500);
  EXPECT_EQ(uploadOf(5), 0U);
  EXPECT_EQ(uploadOf(4), 0U);
  EXPECT_EQ(uploadOf(0), 600U * 500 - 88U * 256) << "back, all but the tile that no patch has touched";
  EXPECT_EQ(uploadOf(0), 0U);
}

TEST_F(GridTilesTest, HoldsTheCellsOfTheStateAfterAnyWay) {
  patches_ = {makePatch(100, 60, 40, std::vector<std::int8_t>(1600, 50)),
              makePatch(120, 70, 3, std::vector<std::int8_t>(9, 99))};
  for (const std::size_t count : {2U, 0U, 1U, 2U, 1U, 0U, 2U}) {
    uploadOf(count);
    const auto* const geometry = node_->getChild(0)->asGeometry();
    const auto* const texture =
        static_cast<const osg::Texture*>(geometry->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    const osg::Image& image = *texture->getImage(0);
    ASSERT_EQ(image.s(), 256);
    EXPECT_EQ(*image.data(100, 60), count > 0 ? 50 : (60 * 600 + 100) % 7) << count;
    EXPECT_EQ(*image.data(121, 71), count > 1 ? 99 : count > 0 ? 50 : (71 * 600 + 121) % 7) << count;
    EXPECT_EQ(*image.data(99, 60), (60 * 600 + 99) % 7) << count;
  }
}

TEST(FlatOrder, PutsLinesBeforeTheReferenceGridBeforeGridMapsBeforeOccupancyGrids) {
  for (const std::uint32_t count : {1U, 2U, 5U, 40U}) {
    float before = nodes::flatDepthStep(FlatKind::ReferenceGrid, 0, 1);
    EXPECT_GT(before, 0.0F) << "of lines";
    for (const FlatKind kind : {FlatKind::GridMap, FlatKind::OccupancyGrid}) {
      for (std::uint32_t place = count; place-- > 0;) {  // the last in the list is the foremost
        const float step = nodes::flatDepthStep(kind, place, count);
        EXPECT_GT(step, before);
        before = step;
      }
    }
  }
}

}  // namespace
}  // namespace stillframe::test
