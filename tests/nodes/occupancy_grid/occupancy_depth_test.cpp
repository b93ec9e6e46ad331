#include <algorithm>
#include <cmath>

#include "tests/nodes/grid_map_builder.h"
#include "tests/nodes/occupancy_grid/grid_builder.h"
#include "tests/nodes/poses/poses_builder.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/golden.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using scenegraph::BytePicture;
using scenegraph::CameraView;
using scenegraph::ObjectType;

constexpr scenegraph::Color kBlack{.r = 0, .g = 0, .b = 0, .a = 1};

/// Three grids, two grid maps lying flat and the reference grid in one plane: a white map, a magenta and a cyan costmap
/// on it in frames of their own, a yellow and a green grid map on those, red lines over all of them, and a blue path.
class OccupancyDepth : public ScenePictureTest {
 protected:
  static constexpr int kSize = 128;

  void openPlane() {
    auto world = makeUniformGrid(200, 200, 0, "map", 0.5);
    world.origin = translate(-50, -50, 0);
    auto global = makeUniformGrid(60, 60, 100, "base", 0.3);
    global.origin = turn(0.6, -8, -9, 0);
    auto local = makeUniformGrid(80, 80, 99, "map", 0.1);
    local.origin = turn(-0.2, -3, -5, 0);
    const auto nothing = [](auto, auto) { return 0.0; };
    auto heights = GridMapBuilder(9, 7).layer("v", nothing).origin(turn(0.9, -2, -5, 0)).build();
    auto slopes = GridMapBuilder(5, 6).layer("v", nothing).frame("base").origin(turn(0.1, -3, 0.5, 0)).build();
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "base", turn(0.37, 3.25, -2.125, 0))
             .topic("/heights", ObjectType::GridMap)
             .at(1_s, heights)
             .topic("/slopes", ObjectType::GridMap)
             .at(1_s, slopes)
             .topic("/path", ObjectType::PosesInFrame)
             .at(1_s,
                 pointsOf(scenegraph::PosesKind::Path, {{-9, -7, 0}, {8, 6, 0}, {9, -8, 0}, {-7, 8, 0}, {-8, -8, 0}}))
             .topic("/world", ObjectType::OccupancyGrid)
             .at(1_s, world)
             .topic("/global", ObjectType::OccupancyGrid)
             .at(1_s, global)
             .topic("/local", ObjectType::OccupancyGrid)
             .at(1_s, local)
             .build(),
         "map");
    // Grid maps before the grids in the list, and before them in the picture all the same.
    add("/path", {{"shape", "none"}, {"line_width", "2"}, {"color", "#0000ff"}});
    add("/heights", {{"flat", "true"}, {"color_field", "flat"}, {"flat_color", "#ffff00"}});
    add("/slopes", {{"flat", "true"}, {"color_field", "flat"}, {"flat_color", "#00ff00"}});
    add("/world");
    add("/global", {{"color_scheme", "costmap"}});
    add("/local", {{"color_scheme", "costmap"}});
    add("grid", {{"color", "#ff0000"}, {"cells", "12"}, {"cell_size", "2"}});
    scene_->update(tf::TimePoint{1_s});
  }
  /// Over the plane at that distance from (0.3, 0.2, 0), so that no line runs through the eye.
  static CameraView viewOf(double distance_m, double elevation_deg) {
    const double elevation = elevation_deg * M_PI / 180;
    const glm::dvec3 target{0.3, 0.2, 0};
    const glm::dvec3 eye =
        target + distance_m * glm::dvec3(-0.8 * std::cos(elevation), -0.6 * std::cos(elevation), std::sin(elevation));
    return {.eye_from_fixed = scenegraph::lookAt(eye, target, {0.1, 0, 1})};
  }
  /// Pixels of a picture of everything that are not what pictures of each layer alone demand, the upmost first.
  template <typename Draw>
  int flips(Draw draw_graph) {
    const char* const names[] = {"/path", "grid", "/slopes", "/heights", "/local", "/global", "/world"};
    const auto showOnly = [&](const char* only) {
      for (const char* const name : names) {
        scene_->findLayer(name)->layer->setVisible(only == nullptr || only == std::string_view(name));
      }
      scene_->update(tf::TimePoint{1_s});
      return draw_graph();
    };
    std::array<BytePicture, std::size(names)> alone;
    std::ranges::transform(names, alone.begin(), showOnly);
    const BytePicture all = showOnly(nullptr);
    int wrong = 0;
    drawn_ = 0;
    for (int y = 0; y < all.height; ++y) {
      for (int x = 0; x < all.width; ++x) {
        const auto top = std::ranges::find_if(
            alone, [&](const BytePicture& picture) { return pixel(picture, x, y) != Bytes3{0, 0, 0}; });
        wrong += top != alone.end() && pixel(all, x, y) != pixel(*top, x, y) ? 1 : 0;
        drawn_ += top != alone.end() ? 1 : 0;
      }
    }
    return wrong;
  }

  static constexpr double kDistances_m[] = {0.05, 0.3, 1, 3, 10, 30, 100, 300, 1000, 3000};
  static constexpr double kElevations_deg[] = {90, 60, 30, 10, 5, 2, 1, 0.5};
  int drawn_ = 0;
};

TEST_F(OccupancyDepth, NothingInOnePlaneFightsAtAnyDistance) {
  openPlane();
  int pictures = 0;
  for (const double distance_m : kDistances_m) {
    for (const double elevation_deg : kElevations_deg) {
      for (const bool is_orthographic : {false, true}) {
        CameraView view = viewOf(distance_m, elevation_deg);
        view.is_orthographic = is_orthographic;
        view.vertical_extent_m = distance_m;
        if (distance_m * std::sin(elevation_deg * M_PI / 180) < view.near_m) {
          continue;  // the plane passes the eye nearer than the near plane
        }
        const int wrong = flips([&] {
          return scenegraph::toBytes(
              render(scene_->root(), view, {.width = kSize, .height = kSize, .background = kBlack}));
        });
        EXPECT_EQ(wrong, 0) << distance_m << " m, " << elevation_deg << " degrees, " << wrong << " of " << drawn_
                            << (is_orthographic ? ", orthographic" : "");
        pictures += drawn_ > 20 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(pictures, 120);
}

TEST_F(OccupancyDepth, NorInAStockViewer) {
  openPlane();
  for (const double distance_m : {0.3, 3.0, 30.0, 300.0, 1000.0}) {
    for (const double elevation_deg : {90.0, 30.0, 5.0}) {
      const CameraView view = viewOf(distance_m, elevation_deg);
      const double far_m = 2 * distance_m + 40;
      const double near_m = 0.0005 * far_m;
      ASSERT_GT(distance_m * std::sin(elevation_deg * M_PI / 180), near_m);
      const int wrong = flips([&] { return drawPlainly(scene_->root(), view, near_m, far_m, kSize, kSize, kBlack); });
      // Depth of 24 bits that is not reversed holds too little apart near the horizon: at 5 degrees 13 pixels at most.
      EXPECT_LE(wrong, elevation_deg < 10 ? 16 : 0)
          << distance_m << " m, " << elevation_deg << " degrees, " << wrong << " of " << drawn_;
      EXPECT_GT(drawn_, 20);
    }
  }
}

TEST_F(OccupancyDepth, HidesWhatIsBelowUnlessDrawnBehind) {
  CloudBuilder below("map");
  below.xyz().point({0.5, 0.5, -0.2});
  CloudBuilder above("map");
  above.xyz().point({0.5, -0.5, 0.2});
  auto grid = makeUniformGrid(20, 20, 50);
  grid.origin = translate(-10, -10, 0);
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "base")
           .topic("/map", ObjectType::OccupancyGrid)
           .at(1_s, grid)
           .topic("/below", ObjectType::PointCloud)
           .at(1_s, below.build())
           .topic("/above", ObjectType::PointCloud)
           .at(1_s, above.build())
           .build(),
       "map");
  auto& map = add("/map");
  for (const char* const name : {"/below", "/above"}) {
    add(name, {{"color_field", "flat"}, {"flat_color", name[1] == 'b' ? "#ff0000" : "#00ff00"}, {"point_size", "5"}});
  }
  const auto count = [&](std::size_t channel) {
    const CameraView view{.eye_from_fixed = scenegraph::lookAt({-3, -2, 8}, {0, 0, 0}, {0, 0, 1})};
    const auto picture = draw(1_s, view);
    int pixels = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      pixels += picture.rgb[i + channel] > 200 ? 1 : 0;
    }
    return pixels;
  };
  EXPECT_EQ(count(0), 0);
  EXPECT_GE(count(1), 16);
  ASSERT_TRUE(map.applySettings({{"draw_behind", "true"}}));
  EXPECT_GE(count(0), 16);
  EXPECT_GE(count(1), 16);
}

/// A map of rooms with unknown beyond, and a costmap of rings on it.
class OccupancyGolden : public ScenePictureTest {
 protected:
  void openRooms() {
    std::vector<std::int8_t> rooms(320 * 280, -1);
    std::vector<std::int8_t> rings(std::size_t{80} * 80);
    for (int y = 0; y < 280; ++y) {
      for (int x = 0; x < 320; ++x) {
        const bool is_wall = x == 40 || x == 160 || x == 280 || y == 40 || y == 140 || y == 240;
        const bool is_inside = x >= 40 && x <= 280 && y >= 40 && y <= 240;
        const bool is_door = std::abs(x - 100) < 8 || std::abs(y - 90) < 8;
        rooms[static_cast<std::size_t>(y * 320 + x)] = static_cast<std::int8_t>(!is_inside            ? -1
                                                                                : is_wall && !is_door ? 100
                                                                                : (x + y) % 60 == 0   ? 120
                                                                                                      : 0);
      }
    }
    for (int i = 0; i < 80 * 80; ++i) {
      const double r = std::hypot(i % 80 - 40, i / 80 - 40);
      rings[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(r < 6    ? 100
                                                                    : r < 10 ? 99
                                                                    : r < 36 ? std::lround(98 * (36 - r) / 26)
                                                                             : 0);
    }
    auto map = makeGrid(320, rooms, "map", 0.05);
    map.origin = translate(-8, -7, 0);
    auto costs = makeGrid(80, rings, "base", 0.05);
    costs.origin = translate(-2, -2, 0);
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "base", turn(0.4, 2, -1))
             .topic("/map", ObjectType::OccupancyGrid)
             .at(1_s, map)
             .topic("/costmap", ObjectType::OccupancyGrid)
             .at(1_s, costs)
             .build(),
         "map");
    add("grid");
    add("/map");
    add("/costmap", {{"color_scheme", "costmap"}, {"alpha", "0.8"}});
  }
  const CameraView view_{.eye_from_fixed = scenegraph::lookAt({5, -9, 7}, {0.5, -0.5, 0}, {0, 0, 1})};
  static int countColor(const BytePicture& picture, const Bytes3& color) {
    int count = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        count += pixel(picture, x, y) == color ? 1 : 0;
      }
    }
    return count;
  }
};

TEST_F(OccupancyGolden, RoomsWithACostmap) {
  openRooms();
  const auto picture = draw(1_s, view_, 320, 240);
  EXPECT_TRUE(matchesGolden(picture, "occupancy_grid"));
  EXPECT_GT(countColor(picture, {112, 137, 134}), 9000) << "unknown";
  EXPECT_GT(countColor(picture, {255, 255, 255}), 15000) << "free";
  EXPECT_GT(countColor(picture, {92, 97, 105}), 1500) << "the lines of the reference grid";
  EXPECT_EQ(scene_->findLayer("/map")->layer->counts()[3].first, "invalid");
  EXPECT_GT(scene_->findLayer("/map")->layer->counts()[3].second, 500U);
}

TEST_F(OccupancyGolden, IsTheSameInAPlainViewer) {
  openRooms();
  ASSERT_TRUE(scene_->findLayer("/costmap")->layer->applySettings({{"alpha", "1"}}));
  const auto ours = draw(1_s, view_, 320, 240);
  for (const char* const extension : kExportExtensions) {
    const osg::ref_ptr<osg::Node> back = exportedAndRead(scene_->root(), extension);
    ASSERT_TRUE(back.valid());
    const auto plain = drawPlainly(*back, view_, 0.1, 100.0, 320, 240, kBlack);
    const auto differs = difference(ours, plain);
    // Partly covered edges of the transparent costmap are blended in linear light by us, in bytes by a stock viewer.
    EXPECT_LE(differs.beyond_one, 400U) << extension << ": largest " << differs.largest;
    EXPECT_GT(drawnPixels(plain), 40000);
  }
}

}  // namespace
}  // namespace stillframe::test
