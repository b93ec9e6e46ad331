#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <optional>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/TextureBuffer>

#include "nodes/points/colormap.h"
#include "tests/nodes/scene_picture.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::ObjectType;
using scenegraph::VoxelGrid;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<scenegraph::Dataset> datasetOf(const VoxelGrid& grid) {
  return DatasetBuilder()
      .topic("/tf", ObjectType::FrameTransforms)
      .transform(0, "map", "base")
      .topic("/voxels", ObjectType::VoxelGrid)
      .at(1_s, grid)
      .build();
}

Bytes3 mapped(const char* colormap, double t) {
  const nodes::SrgbColor color = nodes::findColormap(colormap)->at(t);
  return {static_cast<int>(std::lround(255 * color[0])), static_cast<int>(std::lround(255 * color[1])),
          static_cast<int>(std::lround(255 * color[2]))};
}

bool isNear(const Bytes3& a, const Bytes3& b) {
  return std::abs(a[0] - b[0]) <= 3 && std::abs(a[1] - b[1]) <= 3 && std::abs(a[2] - b[2]) <= 3;
}

/// A voxel that is drawn, and its colour.
struct Solid {
  glm::uvec3 at;
  Bytes3 color;
};

/// The first voxel that a ray in the grid's frame hits from outside, by intersecting all of them.
const Solid* firstHit(const VoxelGrid& grid, const std::vector<Solid>& solids, const glm::dvec3& from,
                      const glm::dvec3& way) {
  const Solid* hit = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids) {
    const glm::dvec3 low = glm::dvec3(solid.at) * grid.cell_size_m;
    const glm::dvec3 a = (low - from) / way;
    const glm::dvec3 b = (low + grid.cell_size_m - from) / way;
    const double enter = std::max({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)});
    const double leave = std::min({std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
    if (enter < leave && enter > 0.0 && enter < nearest) {
      nearest = enter;
      hit = &solid;
    }
  }
  return hit;
}

/// Counts of everything that OSG would upload when it changes, by object.
std::map<const osg::Referenced*, unsigned> uploadsOf(osg::Node& root) {
  class Visitor : public osg::NodeVisitor {
   public:
    Visitor() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Node& node) override {
      visit(node.getStateSet());
      traverse(node);
    }
    void apply(osg::Geometry& geometry) override {
      visit(geometry.getStateSet());
      if (const osg::Array* const vertices = geometry.getVertexArray()) {
        counts[vertices] = vertices->getModifiedCount();
      }
      for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
        counts[geometry.getPrimitiveSet(i)] = geometry.getPrimitiveSet(i)->getModifiedCount();
      }
    }
    void visit(osg::StateSet* state) {
      for (unsigned unit = 0; state != nullptr && unit < state->getTextureAttributeList().size(); ++unit) {
        if (const auto* texture = dynamic_cast<const osg::TextureBuffer*>(
                state->getTextureAttribute(unit, osg::StateAttribute::TEXTURE))) {
          counts[texture] = 0;
          counts[texture->getBufferData()] = texture->getBufferData()->getModifiedCount();
        }
      }
    }
    std::map<const osg::Referenced*, unsigned> counts;
  };
  Visitor visitor;
  root.accept(visitor);
  return visitor.counts;
}

/// 8 x 6 x 5 cells of 1 x 1.5 x 0.75 m, values 0 to 100 in clumps.
double clumps(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const double wave = std::sin(1.1 * x + 0.3 * z) + std::cos(1.7 * y - 0.9 * z) + std::sin(0.8 * x * y);
  return wave > 0.4 ? std::floor(10.0 + 30.0 * wave) : 0.0;
}

class VoxelPicture : public ScenePictureTest {
 protected:
  /// Every pixel against the voxel that its ray hits first.
  void expectVoxels(const VoxelGrid& grid, const scenegraph::CameraView& view,
                    const std::function<std::optional<Bytes3>(const glm::uvec3&)>& colorOf) {
    constexpr int kSize = 100;
    const auto picture = draw(1_s, view, kSize, kSize);
    const glm::dmat4 grid_from_eye = glm::inverse(view.eye_from_fixed * tf::toMatrix(grid.origin));
    const double half = view.is_orthographic ? 0.5 * view.vertical_extent_m : std::tan(0.5 * view.vertical_fov_rad);
    std::vector<Solid> solids;
    for (glm::uvec3 at(0); at.z < grid.slice_count; ++at.z) {
      for (at.y = 0; at.y < grid.row_count; ++at.y) {
        for (at.x = 0; at.x < grid.column_count; ++at.x) {
          if (const auto color = colorOf(at)) {
            solids.push_back({at, *color});
          }
        }
      }
    }
    int wrong = 0;
    int drawn = 0;
    for (int row = 0; row < kSize; ++row) {
      for (int column = 0; column < kSize; ++column) {
        const double u = half * (2.0 * (column + 0.5) / kSize - 1.0);
        const double v = half * (1.0 - 2.0 * (row + 0.5) / kSize);
        const glm::dvec4 from = view.is_orthographic ? glm::dvec4(u, v, 0, 1) : glm::dvec4(0, 0, 0, 1);
        const glm::dvec4 way = view.is_orthographic ? glm::dvec4(0, 0, -1, 0) : glm::dvec4(u, v, -1, 0);
        const Solid* const hit =
            firstHit(grid, solids, glm::dvec3(grid_from_eye * from), glm::dvec3(grid_from_eye * way) + 1e-12);
        const Bytes3 expected = hit != nullptr ? hit->color : Bytes3{0, 0, 0};
        wrong += isNear(pixel(picture, column, row), expected) ? 0 : 1;
        drawn += hit != nullptr ? 1 : 0;
      }
    }
    EXPECT_LE(wrong, 1 + drawn / 400) << "of " << drawn << " pixels: those whose rays meet an edge";
    EXPECT_GT(drawn, 50);
  }
  static std::optional<Bytes3> clumpColor(const glm::uvec3& at, double above = 0.0) {
    const double value = clumps(at.x, at.y, at.z);
    return value > above ? std::optional(mapped("viridis", value / 100.0)) : std::nullopt;
  }
  static std::vector<scenegraph::CameraView> views() {
    return {fromAbove(4, 4.5),
            {.eye_from_fixed = scenegraph::lookAt({-6, -5, 7}, {4, 4, 2}, {0, 0, 1})},
            {.eye_from_fixed = scenegraph::lookAt({13, 12, -4}, {4, 4, 2}, {0, 0, 1})},
            {.eye_from_fixed = scenegraph::lookAt({-3, 4, 1.9}, {4, 4.2, 2}, {0, 0, 1})}};
  }
};

const scenegraph::SettingTexts kPlain{
    {"colormap", "viridis"}, {"range_mode", "manual"}, {"range_max", "100"}, {"shading", "false"}};

TEST_F(VoxelPicture, IsWhatRaysHitForEveryTypeAndStride) {
  for (const FieldType type : {FieldType::Int8, FieldType::Uint8, FieldType::Int16, FieldType::Uint16, FieldType::Int32,
                               FieldType::Uint32, FieldType::Float32, FieldType::Float64}) {
    const VoxelGrid grid = VoxelBuilder(8, 6, 5, static_cast<std::uint32_t>(type) % 3)
                               .cell({1.0, 1.5, 0.75})
                               .field("cost", type, clumps)
                               .build();
    open(datasetOf(grid), "map");
    const auto& layer = add("/voxels", kPlain);
    for (const auto& view : views()) {
      expectVoxels(grid, view, [](const glm::uvec3& at) { return clumpColor(at); });
    }
    EXPECT_EQ(layer.status(), scenegraph::Status{});
  }
}

TEST_F(VoxelPicture, StaysRightWithAListOfWhatIsExposed) {
  // A ball in a box: most voxels are listed nowhere, inside and outside.
  const auto ball = [](auto x, auto y, auto z) {
    return std::hypot(x - 10.5, y - 10.5, z - 10.5) < 6.5 ? (x < 11 ? 20.0 : 50.0) : 0.0;
  };
  const VoxelGrid grid = VoxelBuilder(22, 22, 22)
                             .cell({0.33, 0.33, 0.3})
                             .origin(turn(0.4, 1, 1, 0))
                             .field("cost", FieldType::Uint8, ball)
                             .build();
  open(datasetOf(grid), "map");
  auto& layer = add("/voxels", kPlain);
  for (const double above : {0.0, 30.0}) {
    ASSERT_TRUE(layer.applySettings({{"draw_from", std::to_string(above)}}));
    for (const auto& view : views()) {
      expectVoxels(grid, view, [&](const glm::uvec3& at) -> std::optional<Bytes3> {
        const double value = ball(at.x, at.y, at.z);
        return value > above ? std::optional(mapped("viridis", value / 100.0)) : std::nullopt;
      });
    }
  }
  const auto counts = layer.counts();
  EXPECT_EQ(counts[0], (std::pair<std::string, std::uint64_t>{"voxels", 22 * 22 * 22}));
  EXPECT_EQ(counts[2].first, "listed");
  EXPECT_LT(counts[2].second, 22U * 22 * 22 / 2);
}

TEST_F(VoxelPicture, UploadsNothingForAnySettingOfTestAndColours) {
  open(datasetOf(VoxelBuilder(8, 6, 5).field("cost", FieldType::Uint8, clumps).build()), "map");
  auto& layer = add("/voxels");
  draw(1_s, views()[1]);
  const auto before = uploadsOf(scene_->root());
  ASSERT_GE(before.size(), 4U);
  std::size_t different = 0;
  auto last = draw(1_s, views()[1]);
  for (const scenegraph::SettingTexts& texts :
       std::vector<scenegraph::SettingTexts>{{{"draw_from", "60"}},
                                             {{"draw_if", "range"}, {"draw_from", "20"}, {"draw_to", "50"}},
                                             {{"draw_if", "bits"}, {"draw_bits", "16"}},
                                             {{"draw_if", "equals"}, {"draw_from", "40"}},
                                             {{"draw_if", "all"}},
                                             {{"draw_if", "above"}, {"draw_from", "0"}, {"colormap", "plasma"}},
                                             {{"range_mode", "manual"}, {"range_max", "50"}},
                                             {{"reverse_colormap", "true"}},
                                             {{"shading", "false"}},
                                             {{"opacity", "0.5"}}}) {
    ASSERT_TRUE(layer.applySettings(texts));
    const auto picture = draw(1_s, views()[1]);
    different += picture != last ? 1U : 0U;
    last = picture;
    EXPECT_EQ(uploadsOf(scene_->root()), before);
  }
  EXPECT_EQ(different, 10U);
  ASSERT_TRUE(layer.applySettings({{"draw_field", "nothing"}, {"color_field", "flat"}}));
  draw(1_s, views()[1]);
  EXPECT_EQ(layer.status().code, "UnknownField");
}

TEST_F(VoxelPicture, TakesColoursOfTheirOwnWithAlpha) {
  VoxelBuilder builder(8, 6, 5);
  builder.cell({1.0, 1.5, 0.75})
      .field("red", FieldType::Uint8, [](auto x, auto, auto) { return 30.0 * x; })
      .field("green", FieldType::Uint8, [](auto, auto y, auto) { return 40.0 * y; })
      .field("blue", FieldType::Uint8, [](auto, auto, auto z) { return 50.0 * z; })
      .field("alpha", FieldType::Uint8, [](auto x, auto y, auto z) { return clumps(x, y, z) > 0 ? 255.0 : 0.0; });
  const VoxelGrid grid = builder.build();
  open(datasetOf(grid), "map");
  auto& layer = add("/voxels", {{"shading", "false"}});
  for (const auto& view : views()) {
    expectVoxels(grid, view, [](const glm::uvec3& at) -> std::optional<Bytes3> {
      if (clumps(at.x, at.y, at.z) <= 0) {
        return std::nullopt;
      }
      return Bytes3{30 * static_cast<int>(at.x), 40 * static_cast<int>(at.y), 50 * static_cast<int>(at.z)};
    });
  }
  const auto drawn = layer.counts()[1];
  EXPECT_EQ(drawn.first, "drawn");
  EXPECT_LT(drawn.second, 240U);
}

TEST_F(VoxelPicture, ColoursByHeightFlatAndMissingValues) {
  const VoxelGrid grid =
      VoxelBuilder(6, 6, 6)
          .origin(translate(0, 0, 10))
          .field("marked", FieldType::Uint8, [](auto x, auto y, auto z) { return x + y + z < 9 ? 1.0 : 0.0; })
          .field("cost", FieldType::Float32, [](auto, auto, auto z) { return z < 5 ? z : kNan; })
          .build();
  open(datasetOf(grid), "map");
  auto& layer = add("/voxels", {{"shading", "false"}, {"color_field", "z"}, {"colormap", "viridis"}});
  const auto marked = [](const glm::uvec3& at) { return at.x + at.y + at.z < 9; };
  const auto view = fromAbove(3, 3, 100);
  expectVoxels(grid, view, [&](const glm::uvec3& at) {
    return marked(at) ? std::optional(mapped("viridis", (at.z + 0.5) / 6)) : std::nullopt;
  });
  ASSERT_TRUE(layer.applySettings({{"color_field", "cost"}, {"missing_color", "#ff00ff"}}));
  expectVoxels(grid, view, [&](const glm::uvec3& at) {
    return !marked(at) ? std::nullopt : std::optional(at.z < 5 ? mapped("viridis", at.z / 4.0) : Bytes3{255, 0, 255});
  });
  ASSERT_TRUE(layer.applySettings({{"color_field", "flat"}, {"flat_color", "#102030"}}));
  expectVoxels(grid, view,
               [&](const glm::uvec3& at) { return marked(at) ? std::optional(Bytes3{16, 32, 48}) : std::nullopt; });
  const auto box = scene_->boundsInFixed();
  EXPECT_EQ(box.zMin(), 10.0);
  EXPECT_EQ(box.xMax(), 6.0);
}

TEST_F(VoxelPicture, SaysWhatIsWrong) {
  VoxelGrid grid = VoxelBuilder(2, 2, 2).field("cost", FieldType::Uint8, [](auto, auto, auto) { return 0.0; }).build();
  open(datasetOf(grid), "map");
  const auto& nothing = add("/voxels");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(nothing.status().code, "NothingDrawn");
  EXPECT_THAT(nothing.status().message, HasSubstr("none of its 8 voxels"));
  grid.slice_count = 3;
  open(datasetOf(grid), "map");
  const auto& malformed = add("/voxels");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(malformed.status().code, "MalformedGrid");
  EXPECT_THAT(malformed.status().message, HasSubstr("needs 12 bytes, it has 8"));
  grid.slice_count = 0;
  open(datasetOf(grid), "map");
  const auto& empty = add("/voxels");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(empty.status().code, "EmptyGrid");
}

TEST_F(VoxelPicture, KeepsToWhatTheDriverTakesInABuffer) {
  EXPECT_GE(renderer_->context().info().max_buffer_texels, 65536U) << "what OpenGL 4.5 promises";
  open(datasetOf(VoxelBuilder(8, 8, 8).field("cost", FieldType::Float32, clumps).build()), "map");
  const auto& layer = add("/voxels");
  scene_->setBufferTexels(511);
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  EXPECT_EQ(layer.status().code, "BufferTooLarge");
  EXPECT_THAT(layer.status().message,
              HasSubstr("its 512 voxels need a buffer of 512 texels; this OpenGL driver takes 511"));
  EXPECT_EQ(layer.counts()[1].second, 0U);
  EXPECT_FALSE(layer.boundsInFixed().valid());
  scene_->setBufferTexels(512);
  EXPECT_GT(drawnPixels(draw(1_s, fromAbove())), 1000);
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  EXPECT_GT(layer.counts()[1].second, 0U);
}

TEST_F(VoxelPicture, FillsWithoutGapsFarFromTheCornerOfALargeGrid) {
  const VoxelGrid grid = VoxelBuilder(4000, 8, 1)
                             .cell({0.1, 0.1, 0.1})
                             .field("cost", FieldType::Uint8, [](auto, auto, auto) { return 1.0; })
                             .build();
  open(datasetOf(grid), "map");
  add("/voxels", {{"color_field", "flat"}, {"flat_color", "#ffffff"}, {"shading", "false"}});
  scenegraph::CameraView view = fromAbove(399.0, 0.4);
  view.vertical_extent_m = 0.5;
  EXPECT_EQ(drawnPixels(draw(1_s, view)), 200 * 200);
}

}  // namespace
}  // namespace stillframe::test
