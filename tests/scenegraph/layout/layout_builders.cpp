#include "tests/scenegraph/layout/layout_builders.h"

#include "tests/support/builders.h"

namespace stillframe::test {

using namespace scenegraph;

PickResult makePick(const std::string& frame, const glm::dvec3& point_in_frame) {
  PickResult pick{
      .topic = "/lidar/points", .layer = "Point cloud", .frame = frame, .picked = {}, .fixed_frame = "map", .time = {}};
  pick.picked = {.kind = "point",
                 .id = "17",
                 .point_in_frame = point_in_frame,
                 .stamp = tf::TimePoint{-9'223'372'036'854'775'807},
                 .fields = {{"intensity", PickValue(std::string("0.1"))}, {"na\nme", PickValue(std::string("<&>"))}},
                 .radius_m = 0.3};
  pick.point_in_fixed = {-1e5 / 3.0, 2e-7, 1e12};
  pick.time = tf::TimePoint{1'700'000'000'123'456'789};
  return pick;
}

ViewLayout makeViewLayout() {
  ViewLayout layout;
  layout.dataset = "drive.mcap";
  layout.fixed_frame = "odom";
  CameraRig rig;
  rig.look({.focal_point = {1.0 / 3.0, -2e5, 1e-9}, .yaw_rad = 0.1, .pitch_rad = -1.2, .radius_m = 123.456});
  rig.setKind(CameraKind::Fly);
  Follow follow;
  follow.setMode(FollowMode::Heading, turn(0.3, 1.0, 2.0, 3.0), rig);
  layout.viewpoint = {rig.state(), follow.state(), "base_link"};
  layout.is_camera_touched = true;
  layout.has_smooth_moves = false;
  layout.saved_views = {{"above <&> \"all\"", {}}, {"behind", layout.viewpoint}};
  layout.effects = {{"ssao", "true"}, {"ssao.radius", "0.25"}};
  layout.layers.removed_topics = {"/camera/points"};
  layout.layers.layers = {
      {"tf", "", true, {{"size", "0.3"}}},
      {"/lidar/points", "Front lidar", false, {{"color_field", "intensity"}, {"link.a/b-c.visible", "0"}}},
      {"/lidar/points#2", "", true, {}}};
  layout.shows_layers = false;
  layout.shows_effects = true;
  layout.panel_width = 217;
  layout.shows_legend = false;
  layout.picks.selected = makePick("lidar", {1.0 / 3.0, -0.1, 1e-9});
  layout.picks.measured = {{makePick("lidar", {1, 2, 3}), makePick("map", {0, 0, 0})},
                           {makePick("base_link", {0, 0, 0}), makePick("lidar", {4, 5, 6})}};
  return layout;
}

Layout makeLayout() {
  Place view;
  view.view = makeViewLayout();
  Place column;
  column.is_vertical = true;
  column.sizes = {300, 500};
  column.children = {view, view};
  Place row;
  row.sizes = {640, 641};
  row.children = {view, column};
  Layout layout;
  layout.windows.resize(2);
  layout.windows[0].docks = "AAAA/w==";
  layout.windows[0].place = row;
  layout.active_view = 3;
  layout.windows[0].corner = {-1920, 27};
  layout.windows[1].is_maximized = true;
  layout.windows[1].width = 800;
  layout.windows[1].height = 600;
  layout.windows[1].place = view;
  return layout;
}

std::string viewText(const std::string& attributes, const std::string& children) {
  return "<Scene3DDock version=\"1\" " + attributes + ">" + children + "</Scene3DDock>";
}

}  // namespace stillframe::test
