#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nodes/occupancy_grid/grid_history.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/support/builders.h"

namespace stillframe::test {
namespace {

using nodes::checkGrid;
using nodes::GridCells;
using nodes::GridHeader;
using nodes::GridHistory;
using nodes::GridState;
using nodes::PatchOutcome;
using scenegraph::OccupancyGrid;
using scenegraph::OccupancyGridUpdate;
using testing::HasSubstr;

GridCells cellsOf(const OccupancyGrid& grid) { return {checkGrid(grid).value(), grid.data.bytes}; }

std::vector<std::int8_t> flat(const GridCells& cells, std::uint32_t width, std::uint32_t height) {
  std::vector<std::int8_t> values;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      values.push_back(cells.at(x, y));
    }
  }
  return values;
}

TEST(CheckGrid, SaysWhatIsWrong) {
  const auto codeOf = [](const OccupancyGrid& grid) {
    const auto header = checkGrid(grid);
    return header ? header->note.code : header.error().code;
  };
  const OccupancyGrid good = makeUniformGrid(4, 3, 0);
  EXPECT_EQ(codeOf(good), "Ok");
  OccupancyGrid grid = good;
  grid.height = 4;
  EXPECT_EQ(codeOf(grid), "MalformedGrid");
  EXPECT_THAT(checkGrid(grid).error().message, HasSubstr("4 x 4 cells need 16 bytes, the message holds 12"));
  grid.width = grid.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(codeOf(grid), "MalformedGrid");
  EXPECT_THAT(checkGrid(grid).error().message, HasSubstr("18446744065119617025 bytes"));
  for (const double resolution_m : {0.0, -0.05, std::nan(""), std::numeric_limits<double>::infinity(), 1e-320, 1e300}) {
    grid = good;
    grid.resolution_m = resolution_m;
    EXPECT_EQ(codeOf(grid), "BadResolution") << resolution_m;
  }
  for (const double resolution_m : {1e-6, 1e6}) {
    grid = good;
    grid.resolution_m = resolution_m;
    EXPECT_EQ(codeOf(grid), "Ok") << resolution_m;
  }
  grid = good;
  grid.origin.rotation = {0, 0, 0, 0};
  EXPECT_EQ(codeOf(grid), "ZeroRotation");
  EXPECT_EQ(checkGrid(grid)->frame_from_grid.rotation, glm::dquat(1, 0, 0, 0));
  for (const double scale : {1e-200, 0.5, 1e200}) {
    grid.origin.rotation = {0.6 * scale, 0, 0, 0.8 * scale};
    EXPECT_EQ(codeOf(grid), "UnnormalisedRotation") << scale;
    EXPECT_NEAR(checkGrid(grid)->frame_from_grid.rotation.z, 0.8, 1e-15) << scale;
  }
  grid.origin.rotation = {1, 0, std::nan(""), 0};
  EXPECT_EQ(codeOf(grid), "BadOrigin");
  grid = good;
  grid.origin.translation.y = std::numeric_limits<double>::infinity();
  EXPECT_EQ(codeOf(grid), "BadOrigin");
  EXPECT_EQ(codeOf(makeGrid(0, {})), "Ok") << "a grid without cells is a grid";
}

TEST(CheckGrid, TakesTwentyThousandSquaredAndRefusesWhatIsLarger) {
  EXPECT_EQ(nodes::tileEdge(384, 384), 256U);
  EXPECT_EQ(nodes::tileEdge(20'000, 20'000), 1024U);
  EXPECT_EQ(nodes::blockEdge(8192, 8192), 64U);
  EXPECT_EQ(nodes::blockEdge(20'000, 20'000), 256U);
  EXPECT_EQ(nodes::tileEdge(1, 1U << 28U), 0U) << "a ribbon of too many tiles";
  // The bytes are never looked at: a span is enough.
  std::byte byte{};
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.width = grid.height = 20'000;
  grid.data.bytes = {&byte, 400'000'000};
  EXPECT_TRUE(checkGrid(grid));
  grid.width = grid.height = 30'000;
  grid.data.bytes = {&byte, 900'000'000};
  EXPECT_EQ(checkGrid(grid).error().code, "GridTooLarge");
}

TEST(GridCells, CountsAndSplitsIntoBlocks) {
  std::vector<std::int8_t> values(300 * 270, 0);
  values[0] = -1;
  values[299] = 64;
  values[300] = 65;
  values[301] = 100;
  values[302] = 101;
  values[303] = -2;
  values[300 * 269 + 299] = -128;
  const GridCells cells = cellsOf(makeGrid(300, values));
  EXPECT_EQ(cells.blocks().size(), 25U);
  EXPECT_TRUE(cells.blocks()[6]->isUniform()) << "all free";
  EXPECT_FALSE(cells.blocks()[0]->isUniform());
  EXPECT_EQ(cells.counts(), (nodes::CellCounts{.unknown = 1, .occupied = 2, .invalid = 3}));
  EXPECT_EQ(flat(cells, 300, 270), values);
  const GridCells unknown = cellsOf(makeUniformGrid(300, 270, -1));
  EXPECT_EQ(unknown.counts().unknown, 81'000U);
  EXPECT_LT(unknown.byteSize(), 3000U);
}

TEST(GridCells, ClipsPatchesAndRefusesShortOnes) {
  GridCells cells = cellsOf(makeUniformGrid(3, 3, 0));
  const std::vector<std::int8_t> nine = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(cells.apply(makePatch(-2, -1, 3, nine)), PatchOutcome::Clipped);
  EXPECT_EQ(flat(cells, 3, 3), (std::vector<std::int8_t>{6, 0, 0, 9, 0, 0, 0, 0, 0}));
  EXPECT_EQ(cells.apply(makePatch(1, 2, 3, nine)), PatchOutcome::Clipped);
  EXPECT_EQ(flat(cells, 3, 3), (std::vector<std::int8_t>{6, 0, 0, 9, 0, 0, 0, 1, 2}));
  EXPECT_EQ(cells.apply(makePatch(3, 0, 3, nine)), PatchOutcome::Outside);
  EXPECT_EQ(cells.apply(makePatch(-3, 0, 3, nine)), PatchOutcome::Outside);
  EXPECT_EQ(cells.apply(makePatch(0, 0, 0, {})), PatchOutcome::Applied);
  OccupancyGridUpdate patch = makePatch(0, 0, 3, nine);
  patch.height = 4;
  EXPECT_EQ(cells.apply(patch), PatchOutcome::Short);
  patch.width = patch.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(cells.apply(patch), PatchOutcome::Short);
  for (const std::int32_t far : {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
    EXPECT_EQ(cells.apply(makePatch(far, far, 3, nine)), PatchOutcome::Outside);
  }
  EXPECT_EQ(flat(cells, 3, 3), (std::vector<std::int8_t>{6, 0, 0, 9, 0, 0, 0, 1, 2}));
  EXPECT_EQ(cells.apply(makePatch(0, 0, 3, {-1, 65, 101, 0, 0, 0, 0, 0, 0})), PatchOutcome::Applied);
  EXPECT_EQ(cells.counts(), (nodes::CellCounts{.unknown = 1, .occupied = 1, .invalid = 1}));
}

TEST(GridCells, CopiesShareWhatAPatchDoesNotTouch) {
  std::vector<std::int8_t> values(600 * 300);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<std::int8_t>(i % 101);
  }
  GridCells cells = cellsOf(makeGrid(600, values));
  const GridCells before = cells;
  EXPECT_EQ(cells.apply(makePatch(255, 10, 2, {99, 98})), PatchOutcome::Applied);
  for (std::size_t i = 0; i < cells.blocks().size(); ++i) {
    EXPECT_EQ(cells.blocks()[i] != before.blocks()[i], i == 3 || i == 4) << i;
  }
  EXPECT_EQ(flat(before, 600, 300), values);
  const GridCells after = cells;
  (void)cells.apply(makePatch(255, 10, 2, {1, 1}));
  EXPECT_EQ(after.at(255, 10), 99);
  EXPECT_EQ(after.at(256, 10), 98);
}

/// Random updates over a grid, some clipped, some refused; and the states by brute force.
class GridHistoryTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kWidth = 700;
  static constexpr std::uint32_t kHeight = 500;

  GridHistoryTest() {
    Random random(5);
    for (std::size_t i = 0; i < 400; ++i) {
      const auto width = static_cast<std::uint32_t>(1 + random.index(80));
      const auto height = static_cast<std::uint32_t>(1 + random.index(80));
      std::vector<std::int8_t> values(std::size_t{width} * height, static_cast<std::int8_t>(random.index(256) - 128));
      auto patch =
          makePatch(static_cast<std::int32_t>(random.index(900)) - 100,
                    static_cast<std::int32_t>(random.index(700)) - 100, width, values, i % 7 == 3 ? "/odom" : "/map");
      if (i % 11 == 5) {
        patch.height += 1;
      }
      updates.push_back(i % 50 == 49 ? nullptr : std::make_shared<const OccupancyGridUpdate>(patch));
      ids.push_back(1000 + i);
    }
  }
  GridHistory makeHistory(std::size_t max_bytes = std::size_t{1} << 28U) const {
    return {checkGrid(base).value(), base.data.bytes, max_bytes};
  }
  std::shared_ptr<const GridState> state(GridHistory& history, const std::vector<std::uint64_t>& wanted) {
    return history.at(wanted, [&](std::size_t place) {
      ++fetches;
      return updates[wanted[place] - 1000];
    });
  }
  std::vector<std::int8_t> expected(const std::vector<std::uint64_t>& wanted) const {
    std::vector<std::int8_t> values(std::size_t{kWidth} * kHeight, -1);
    for (const std::uint64_t id : wanted) {
      const auto& patch = updates[id - 1000];
      if (patch == nullptr || patch->data.bytes.size() < std::size_t{patch->width} * patch->height) {
        continue;
      }
      for (std::int64_t j = 0; j < patch->height; ++j) {
        for (std::int64_t i = 0; i < patch->width; ++i) {
          const std::int64_t x = patch->x + i;
          const std::int64_t y = patch->y + j;
          if (x >= 0 && y >= 0 && x < kWidth && y < kHeight) {
            values[static_cast<std::size_t>(y * kWidth + x)] =
                static_cast<std::int8_t>(patch->data.bytes[static_cast<std::size_t>(j * patch->width + i)]);
          }
        }
      }
    }
    return values;
  }
  void expectState(GridHistory& history, const std::vector<std::uint64_t>& wanted) {
    const auto got = state(history, wanted);
    const auto want = expected(wanted);
    ASSERT_EQ(flat(got->cells, kWidth, kHeight), want) << wanted.size() << " updates";
    ASSERT_EQ(got->cells.counts(), nodes::countCells(want));
    ASSERT_EQ(got->applied + got->refused, wanted.size());
  }
  std::vector<std::uint64_t> first(std::size_t count) const {
    return {ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count)};
  }

  OccupancyGrid base = makeUniformGrid(kWidth, kHeight, -1);
  std::vector<GridHistory::Update> updates;
  std::vector<std::uint64_t> ids;
  std::size_t fetches = 0;
};

TEST_F(GridHistoryTest, AnyOrderOfSeeksGivesTheSameStates) {
  GridHistory history = makeHistory();
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    expectState(history, first(random.index(ids.size() + 1)));
  }
  EXPECT_GE(history.checkpointCount(), 2U);
}

TEST_F(GridHistoryTest, FetchesEachUpdateOnceWhereTheyFit) {
  GridHistory history = makeHistory();
  expectState(history, ids);
  expectState(history, {});
  expectState(history, ids);
  const std::size_t undecodable = ids.size() / 50;
  EXPECT_LE(fetches, ids.size() + undecodable * 2);
}

TEST_F(GridHistoryTest, StaysWithinItsBytesAndStaysRight) {
  constexpr std::size_t kBytes = std::size_t{2} << 20U;
  GridHistory history = makeHistory(kBytes);
  const std::size_t at_first = history.byteSize();
  Random random(12);
  for (int i = 0; i < 25; ++i) {
    expectState(history, first(random.index(ids.size() + 1)));
    EXPECT_LE(history.byteSize(), at_first + kBytes + kBytes / 4 + 16 * 2 * ids.size());
  }
  GridHistory tiny = makeHistory(0);
  expectState(tiny, ids);
  EXPECT_EQ(tiny.checkpointCount(), 1U);
  expectState(tiny, first(100));
}

TEST_F(GridHistoryTest, TakesUpdatesThatArriveLate) {
  GridHistory history = makeHistory();
  std::vector<std::uint64_t> known;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i != 57 && i != 200) {
      known.push_back(ids[i]);
    }
  }
  expectState(history, known);
  known.insert(known.begin() + 57, ids[57]);
  expectState(history, {known.begin(), known.begin() + 30});
  expectState(history, known);
  expectState(history, ids);
  expectState(history, first(201));
}

TEST_F(GridHistoryTest, TellsWhatWasNotApplied) {
  GridHistory history = makeHistory();
  const auto all = state(history, ids);
  EXPECT_GT(all->refused, 36U);
  EXPECT_GT(all->clipped, 10U);
  EXPECT_GT(all->other_frame, 20U);
  EXPECT_EQ(all->first_frame, "odom");
  EXPECT_THAT(all->first_refusal, testing::AnyOf(HasSubstr("bytes"), HasSubstr("outside")));
  EXPECT_EQ(state(history, {ids[49]})->first_refusal, "it cannot be decoded");
}

}  // namespace
}  // namespace stillframe::test
