#include "nodes/voxel_grid/voxel_values.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "nodes/voxel_grid/voxel_cells.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"
#include "tests/support/builders.h"

namespace stillframe::test {
namespace {

using nodes::VoxelRule;
using scenegraph::FieldType;
using scenegraph::VoxelGrid;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr FieldType kTypes[] = {FieldType::Int8,  FieldType::Uint8,  FieldType::Int16,   FieldType::Uint16,
                                FieldType::Int32, FieldType::Uint32, FieldType::Float32, FieldType::Float64};

/// A field of a grid as it would be uploaded.
struct Converted {
  nodes::PackedCells cells;
  nodes::VoxelFormat format;
  nodes::ChannelValues limits;
  std::vector<std::uint32_t> words;
  FieldType type = FieldType::Unknown;

  explicit Converted(const VoxelGrid& grid, std::size_t layer = 0) {
    auto read = nodes::readVoxelCells(grid);
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    cells = std::move(*read);
    type = cells.layers.at(layer).type;
    format = nodes::voxelFormat(type);
    words.resize(format.words(cells.all.points));
    limits = nodes::convertVoxels(cells, cells.layers[layer], words);
  }
  [[nodiscard]] double value(std::size_t i) const {
    return nodes::voxelValue(nodes::rawVoxel(words, format, i), format, limits);
  }
  [[nodiscard]] std::vector<std::size_t> drawn(const VoxelRule& rule) const {
    const auto test = nodes::makeVoxelTest(rule, type, limits);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < cells.all.points; ++i) {
      if (nodes::isDrawn(nodes::rawVoxel(words, format, i), format, limits, test)) {
        all.push_back(i);
      }
    }
    EXPECT_EQ(nodes::countDrawn(words, format, cells.all.points, limits, test), all.size());
    return all;
  }
};

std::string codeOf(const VoxelGrid& grid) {
  const auto cells = nodes::readVoxelCells(grid);
  return cells ? std::string("Ok") : cells.error().code;
}

/// Values at the ends of what a type holds, and about 0.
std::vector<double> telling(FieldType type) {
  switch (type) {
    case FieldType::Int8:
      return {-128, -1, 0, 1, 127};
    case FieldType::Uint8:
      return {0, 1, 127, 128, 255};
    case FieldType::Int16:
      return {-32768, -1, 0, 1, 32767};
    case FieldType::Uint16:
      return {0, 1, 32768, 65535};
    case FieldType::Int32:
      return {-2147483648.0, -2147483647.0, -1, 0, 1, 2147483646, 2147483647};
    case FieldType::Uint32:
      return {0, 1, 2147483648.0, 4294967294.0, 4294967295.0};
    case FieldType::Float32:
      return {-0x1p100, -0.5, -0.0, 0.0, 0.25, 0x1p100};
    default:
      return {-1000.5, -0.0, 0.0, 0.125, 1000.5};
  }
}

TEST(VoxelValues, KeepEveryTypeExactlyThroughAnyStride) {
  for (const FieldType type : kTypes) {
    const auto values = telling(type);
    for (const std::uint32_t padding : {0U, 1U, 5U}) {
      const auto valueAt = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return values[(x + 3 * y + 7 * z) % values.size()];
      };
      const Converted grid(VoxelBuilder(5, 3, 4, padding).field("a", type, valueAt).build());
      ASSERT_EQ(grid.cells.all.points, 60U);
      EXPECT_EQ(grid.cells.all.runs.size(), padding == 0 ? 1U : 12U);
      for (std::size_t i = 0; i < 60; ++i) {
        const auto at = static_cast<std::uint32_t>(i);
        EXPECT_EQ(grid.value(i), valueAt(at % 5, at / 5 % 3, at / 15)) << static_cast<int>(type) << " at " << i;
      }
      EXPECT_EQ(grid.limits.low, *std::ranges::min_element(values));
      EXPECT_EQ(grid.limits.high, *std::ranges::max_element(values));
      EXPECT_EQ(grid.limits.finite, 60U);
    }
  }
}

TEST(VoxelTest, AgreesWithTheRuleOnEveryTypeAndBound) {
  for (const FieldType type : kTypes) {
    const auto values = telling(type);
    const auto count = static_cast<std::uint32_t>(values.size());
    const Converted grid(
        VoxelBuilder(count, 1, 1).field("a", type, [&](auto x, auto, auto) { return values[x]; }).build());
    std::vector<double> bounds = values;
    for (const double value : values) {
      bounds.insert(bounds.end(), {value - 0.5, value + 0.5, value - 1.0, value + 1.0});
    }
    bounds.insert(bounds.end(), {-1e300, 1e300, 5e9, -5e9});
    const auto asStored = [&](double bound) {
      return type == FieldType::Float32 ? static_cast<double>(static_cast<float>(std::clamp(bound, -1e37, 1e37)))
                                        : bound;
    };
    for (const double from : bounds) {
      for (const double to : bounds) {
        const auto expected = [&](auto passes) {
          std::vector<std::size_t> all;
          for (std::size_t i = 0; i < values.size(); ++i) {
            if (passes(values[i])) {
              all.push_back(i);
            }
          }
          return all;
        };
        SCOPED_TRACE(std::to_string(static_cast<int>(type)) + ": " + std::to_string(from) + " to " +
                     std::to_string(to));
        EXPECT_EQ(grid.drawn({.mode = VoxelRule::Mode::Above, .from = from}),
                  expected([&](double v) { return v > asStored(from); }));
        EXPECT_EQ(grid.drawn({.mode = VoxelRule::Mode::Equals, .from = from}),
                  expected([&](double v) { return v == asStored(from); }));
        EXPECT_EQ(grid.drawn({.mode = VoxelRule::Mode::Range, .from = from, .to = to}),
                  expected([&](double v) { return v >= asStored(from) && v <= asStored(to); }));
      }
    }
    EXPECT_EQ(grid.drawn({.mode = VoxelRule::Mode::All}).size(), values.size());
  }
}

TEST(VoxelTest, FindsBitsInEveryType) {
  for (const FieldType type : kTypes) {
    const Converted grid(
        VoxelBuilder(8, 1, 1).field("a", type, [](auto x, auto, auto) { return static_cast<double>(x); }).build());
    EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Bits, .bits = 4}), testing::ElementsAre(4, 5, 6, 7));
    EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Bits, .bits = 5}), testing::ElementsAre(1, 3, 4, 5, 6, 7));
    EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Bits, .bits = 0}), testing::IsEmpty());
  }
  const Converted wide(VoxelBuilder(3, 1, 1)
                           .field("a", FieldType::Uint32,
                                  [](auto x, auto, auto) {
                                    return x == 0 ? 2147483648.0 : x == 1 ? 4294967295.0 : 7.0;
                                  })
                           .build());
  EXPECT_THAT(wide.drawn({.mode = VoxelRule::Mode::Bits, .bits = 0x80000000U}), testing::ElementsAre(0, 1));
}

TEST(VoxelTest, DrawsNanByAllAloneAndInfinitiesByTheirSide) {
  for (const FieldType type : {FieldType::Float32, FieldType::Float64}) {
    const double values[] = {kNan, -kInfinity, 0.0, kInfinity};
    const Converted grid(VoxelBuilder(4, 1, 1).field("a", type, [&](auto x, auto, auto) { return values[x]; }).build());
    EXPECT_TRUE(std::isnan(grid.value(0)));
    EXPECT_EQ(grid.limits.finite, 1U);
    EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Above, .from = -1e300}), testing::ElementsAre(2, 3));
    EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Range, .from = -kInfinity, .to = kInfinity}),
                testing::ElementsAre(1, 2, 3));
    EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Bits, .bits = 0xFFFFFFFFU}), testing::IsEmpty());
    EXPECT_EQ(grid.drawn({.mode = VoxelRule::Mode::All}).size(), 4U);
  }
}

TEST(VoxelTest, TellsLargeDoublesApartByTheirOffset) {
  const Converted grid(
      VoxelBuilder(4, 1, 1).field("t", FieldType::Float64, [](auto x, auto, auto) { return 1.7e9 + x; }).build());
  EXPECT_NE(grid.limits.offset, 0.0);
  EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Above, .from = 1.7e9 + 1}), testing::ElementsAre(2, 3));
  EXPECT_THAT(grid.drawn({.mode = VoxelRule::Mode::Equals, .from = 1.7e9 + 2}), testing::ElementsAre(2));
}

/// Drawn voxels with a side that no other drawn voxel covers, by definition.
template <typename Passes, typename Alpha>
std::set<std::uint32_t> seenOf(const glm::uvec3& count, const Passes& passes, const Alpha& alpha) {
  std::set<std::uint32_t> seen;
  const auto index = [&](const glm::ivec3& at) {
    return static_cast<std::uint32_t>((at.z * static_cast<int>(count.y) + at.y) * static_cast<int>(count.x) + at.x);
  };
  const glm::ivec3 size(count);
  for (glm::ivec3 at(0); at.z < size.z; ++at.z) {
    for (at.y = 0; at.y < size.y; ++at.y) {
      for (at.x = 0; at.x < size.x; ++at.x) {
        const std::uint32_t own = index(at);
        if (!passes(own) || alpha(own) == 0) {
          continue;
        }
        for (int axis = 0; axis < 3; ++axis) {
          for (const int way : {-1, 1}) {
            glm::ivec3 beyond = at;
            beyond[axis] += way;
            const bool is_outside = beyond[axis] < 0 || beyond[axis] >= size[axis];
            if (is_outside || !passes(index(beyond)) || alpha(index(beyond)) < alpha(own)) {
              seen.insert(own);
            }
          }
        }
      }
    }
  }
  return seen;
}

TEST(ExposedVoxels, HoldEveryVoxelThatAnyRuleCanShow) {
  Random random(5);
  for (int round = 0; round < 60; ++round) {
    const glm::uvec3 count(1 + random.index(20), 1 + random.index(7), 1 + random.index(7));
    const FieldType type = kTypes[random.index(std::size(kTypes))];
    std::vector<double> values(std::size_t{count.x} * count.y * count.z);
    const double most = round % 2 == 0 ? 1.15 : 4.0;  // large blocks of equals, or many edges
    for (double& value : values) {
      value = std::floor(random.number(0, most));
    }
    const Converted grid(
        VoxelBuilder(count.x, count.y, count.z)
            .field("a", type, [&](auto x, auto y, auto z) { return values[(z * count.y + y) * count.x + x]; })
            .build());
    std::vector<std::uint32_t> rgba(round % 3 == 0 ? values.size() : 0);
    for (std::uint32_t& word : rgba) {
      word = static_cast<std::uint32_t>(random.index(3) * 127) << 24U | 0x123456U;
    }
    const auto listed = nodes::exposedVoxels(count, grid.words, grid.format, rgba, values.size());
    ASSERT_TRUE(listed);
    ASSERT_TRUE(std::ranges::is_sorted(*listed));
    const auto alpha = [&](std::uint32_t i) { return rgba.empty() ? 255U : rgba[i] >> 24U; };
    for (unsigned shown = 0; shown < 16; ++shown) {  // every set of the values 0 to 3
      const auto passes = [&](std::uint32_t i) { return (shown >> static_cast<unsigned>(values[i]) & 1U) != 0; };
      const auto seen = seenOf(count, passes, alpha);
      EXPECT_TRUE(std::ranges::includes(*listed, seen)) << "round " << round << ", values " << shown;
    }
  }
}

TEST(ExposedVoxels, LeaveOutWhatIsEnclosedAmongEquals) {
  const glm::uvec3 count(64, 64, 64);
  const auto solid = [](auto x, auto y, auto z) { return std::hypot(x - 31.5, y - 31.5, z - 31.5) < 20.0 ? 1.0 : 0.0; };
  const Converted grid(VoxelBuilder(64, 64, 64).field("a", FieldType::Uint8, solid).build());
  const auto listed = nodes::exposedVoxels(count, grid.words, grid.format, {}, count.x * count.y * count.z);
  ASSERT_TRUE(listed);
  const std::size_t border = 64 * 64 * 64 - 62 * 62 * 62;
  EXPECT_LT(listed->size(), border + 16'000) << "two layers of a ball's surface of 5027 cells";
  EXPECT_FALSE(nodes::exposedVoxels(count, grid.words, grid.format, {}, 1000));
  EXPECT_TRUE(nodes::exposedVoxels({0, 5, 5}, {}, {}, {}, 10)->empty());
}

TEST(VoxelCells, RefuseWhatCannotBeDrawn) {
  const VoxelGrid good =
      VoxelBuilder(4, 3, 2).field("a", FieldType::Float32, [](auto, auto, auto) { return 1.0; }).build();
  EXPECT_EQ(codeOf(good), "Ok");
  const auto changed = [&](const std::function<void(VoxelGrid&)>& change) {
    VoxelGrid grid = good;
    change(grid);
    return codeOf(grid);
  };
  for (const double size : {0.0, -1.0, kNan, kInfinity, 1e300}) {
    EXPECT_EQ(changed([&](VoxelGrid& grid) { grid.cell_size_m.y = size; }), "MalformedGrid") << size;
  }
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.origin.translation.z = kNan; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.data.bytes = grid.data.bytes.first(95); }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.cell_stride = 0; }), "MalformedGrid") << "voxels in one place";
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.cell_stride = 3; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.row_stride = 15; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.slice_stride = 0; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.slice_stride = 0xFFFFFFFFU; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.fields.clear(); }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.fields[0].type = FieldType::Unknown; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.fields[0].offset = 0xFFFFFFFEU; }), "MalformedGrid");
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.fields[0].count = 0xFFFFFFFFU; }), "MalformedGrid");
  const std::uint32_t all = 0xFFFFFFFFU;
  EXPECT_EQ(changed([&](VoxelGrid& grid) { grid.column_count = grid.row_count = grid.slice_count = all; }),
            "TooManyVoxels");
  EXPECT_EQ(changed([&](VoxelGrid& grid) { grid.slice_count = 1U << 30U; }), "TooManyVoxels");
  EXPECT_EQ(changed([&](VoxelGrid& grid) { grid.slice_count = 1U << 20U; }), "MalformedGrid") << "not that much data";
  EXPECT_EQ(changed([](VoxelGrid& grid) { grid.row_count = 0; }), "Ok");
  EXPECT_THAT(nodes::readVoxelCells(VoxelBuilder(2, 2, 2).build()).error().message, HasSubstr("0 fields"));
}

TEST(VoxelCells, ReadTheAlphaOfPackedAndSeparateColours) {
  VoxelBuilder packed(2, 1, 1);
  packed.field("rgba", FieldType::Uint32, [](auto x, auto, auto) { return x == 0 ? 4278190335.0 : 8388863.0; });
  VoxelBuilder separate(2, 1, 1);
  for (const char* const name : {"red", "green", "blue", "alpha"}) {
    const bool is_red = name[0] == 'r';
    const bool is_alpha = name[0] == 'a';
    separate.field(name, FieldType::Uint8, [=](auto x, auto, auto) {
      return is_red || (is_alpha && x == 0) ? 255.0 : name[0] == 'b' && x == 1 ? 128.0 : 0.0;
    });
  }
  const std::vector<std::uint8_t> expected[] = {{255, 0, 0, 255, 255, 0, 128, 0}, {255, 0, 0, 255, 255, 0, 128, 0}};
  std::size_t i = 0;
  for (const VoxelBuilder& builder : {packed, separate}) {
    const VoxelGrid grid = builder.build();
    const auto cells = nodes::readVoxelCells(grid);
    ASSERT_TRUE(cells) << cells.error().message;
    EXPECT_TRUE(cells->layers.empty());
    std::vector<std::uint8_t> rgba(8);
    nodes::convertCellColors(*cells, rgba);
    EXPECT_EQ(rgba, expected[i++]);
  }
}

}  // namespace
}  // namespace stillframe::test
