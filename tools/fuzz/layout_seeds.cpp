// layout_seeds OUT: writes what the fuzzer of layouts starts from: an arrangement of everything a view keeps, one view
// alone, and a layout of a host.
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "scenegraph/layout/window_layout.h"

using namespace stillframe;

namespace {

scenegraph::PickResult pointOn(const char* topic, double x) {
  scenegraph::PickResult pick{
      .topic = topic, .layer = "Point cloud", .frame = "lidar", .picked = {}, .fixed_frame = "map", .time = {}};
  pick.picked.kind = "point";
  pick.picked.id = "7";
  pick.picked.point_in_frame = {x, -0.1, 1e-9};
  pick.picked.stamp = tf::TimePoint{-1};
  pick.picked.add("intensity", 0.5F);
  return pick;
}

scenegraph::ViewLayout everything() {
  scenegraph::ViewLayout view;
  view.dataset = "drive.mcap";
  view.fixed_frame = "odom";
  view.viewpoint.display_frame = "base_link";
  view.is_camera_touched = true;
  view.saved_views = {{"above", {}}};
  view.effects = {{"ssao", "true"}};
  view.layers.layers = {{"tf", "", true, {{"size", "0.3"}}}, {"/lidar/points#2", "Front", false, {}}};
  view.layers.removed_topics = {"/camera"};
  view.picks.selected = pointOn("/lidar/points", 1.0 / 3.0);
  view.picks.measured.emplace_back(pointOn("/a", 1.0), pointOn("/b", 2.0));
  return view;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  const std::filesystem::path out = argv[1];
  std::filesystem::create_directories(out);
  scenegraph::Place one;
  one.view = everything();
  scenegraph::Place both;
  both.is_vertical = true;
  both.sizes = {300, 500};
  both.children = {one, one};
  scenegraph::Layout layout;
  layout.windows.resize(2);
  layout.windows[0].corner = {-5, 40};
  layout.windows[0].docks = "AAAA/w==";
  layout.windows[0].place = both;
  layout.windows[1].is_maximized = true;
  layout.windows[1].place = one;
  std::ofstream(out / "windows.xml", std::ios::binary) << scenegraph::writeXml(toXml(layout));
  const std::string view = scenegraph::writeXml(toXml(everything()));
  std::ofstream(out / "view.xml", std::ios::binary) << view;
  std::ofstream(out / "host.xml", std::ios::binary)
      << "<root><tab>" << view.substr(view.find("<Scene3DDock")) << "</tab></root>";
  return std::filesystem::file_size(out / "host.xml") > view.size() / 2 ? 0 : 1;
}
