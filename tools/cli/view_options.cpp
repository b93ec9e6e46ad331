#include "tools/cli/view_options.h"

#include <CLI/CLI.hpp>
#include <tuple>

#include "tf/transform_buffer.h"

namespace stillframe::cli {

Result<scenegraph::CameraKind> parseCamera(const std::string& text) {
  if (const auto kind = scenegraph::cameraKindOf(text)) {
    return *kind;
  }
  return usageError("--camera '" + text + "' is none of orbit, xyorbit, topdown, fly");
}

Result<scenegraph::PointWay> parsePointWay(const std::string& text) {
  using scenegraph::PointWay;
  for (const auto& [name, way] : {std::pair("auto", PointWay::Auto), std::pair("gl", PointWay::OpenGl),
                                  std::pair("cpu", PointWay::Cpu), std::pair("compute", PointWay::Compute)}) {
    if (text == name) {
      return way;
    }
  }
  return usageError("--points '" + text + "' is none of auto, gl, cpu, compute");
}

Result<std::pair<std::string, scenegraph::FollowMode>> parseFollow(const std::string& text) {
  std::string frame = text;
  scenegraph::FollowMode mode = scenegraph::FollowMode::Pose;
  if (const std::size_t colon = text.rfind(':'); colon != std::string::npos) {
    if (const auto named = scenegraph::followModeOf(text.substr(colon + 1))) {
      mode = *named;
      frame = text.substr(0, colon);
    }
  }
  frame = std::string(tf::stripLeadingSlashes(frame));
  if (frame.empty() || mode == scenegraph::FollowMode::Off) {
    return usageError("--follow '" + text + "' is not FRAME or FRAME:MODE, MODE being position, heading or pose");
  }
  return std::pair(std::move(frame), mode);
}

ViewArguments::ViewArguments(CLI::App& command) : command_(command), layout_(command) {
  addRecordingOptions(command, options_.recording);
  addRobotOptions(command, options_.recording);
  command.add_option("--time", time_, "Nanoseconds, +SECONDS from the start, start, or end")->capture_default_str();
  command.add_option("--fixed-frame", fixed_frame_, "Frame that stands still; default: map, world, odom, ...");
  command
      .add_option("--layer", layers_,
                  "TOPIC[:key=value,...]: settings of a layer, e.g. grid:visible=false; TOPIC#2 is a second layer of "
                  "it; may be "
                  "repeated")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  command.add_flag("--only", options_.only_named_layers, "Draw just the layers named by --layer");
  command.add_option("--camera", camera_, "orbit, xyorbit, topdown (from above, without perspective) or fly")
      ->type_name("MODEL")
      ->capture_default_str();
  command.add_option("--ortho-height", ortho_height_, "Metres from the picture's bottom to its top, for topdown");
  command
      .add_option("--follow", follow_,
                  "FRAME[:position|heading|pose]: the eye goes along with this frame, and --eye and --look-at count "
                  "from it")
      ->type_name("FRAME[:MODE]");
  command.add_option("--eye", eye_, "x,y,z of the eye in the fixed frame; default: where all is seen");
  command.add_option("--look-at", look_at_, "x,y,z that the eye looks at; default: the middle of the data");
  command.add_option("--fov", fov_, "Vertical field of view in degrees, 1 to 170")->capture_default_str();
  command.add_option("--size", size_, "WIDTHxHEIGHT of the picture in pixels")->capture_default_str();
  command.add_option("--points", points_, kPointsHelp)->type_name("WHO")->capture_default_str();
  command
      .add_option("--background", background_,
                  "#rrggbb, #rrggbbaa, r,g,b or r,g,b,a with components 0..1 (or 0..255 when one is above 1), or "
                  "transparent: with an alpha below 1 the picture has alpha")
      ->type_name("COLOR")
      ->capture_default_str();
}

Result<ViewOptions> ViewArguments::view() const {
  ViewOptions view = options_;
  const auto time = parseTime(time_);
  if (!time) {
    return std::unexpected(time.error());
  }
  view.time = *time;
  const auto size = parseSize(size_);
  if (!size) {
    return std::unexpected(size.error());
  }
  view.size = *size;
  const auto fov = parseNumber("--fov", fov_, 1.0, 170.0);
  if (!fov) {
    return std::unexpected(fov.error());
  }
  view.vertical_fov_deg = *fov;
  const auto camera = parseCamera(camera_);
  if (!camera) {
    return std::unexpected(camera.error());
  }
  view.camera = *camera;
  if (!ortho_height_.empty()) {
    const auto height = parseNumber("--ortho-height", ortho_height_, 1e-6, 1e9);
    if (!height) {
      return std::unexpected(height.error());
    }
    if (view.camera != scenegraph::CameraKind::TopDownOrtho) {
      return usageError("--ortho-height is the height of the picture of --camera topdown");
    }
    view.ortho_height_m = *height;
  }
  if (!follow_.empty()) {
    auto follow = parseFollow(follow_);
    if (!follow) {
      return std::unexpected(follow.error());
    }
    std::tie(view.follow_frame, view.follow) = std::move(*follow);
  }
  auto layout = layout_.view();
  if (!layout) {
    return std::unexpected(layout.error());
  }
  view.layout = std::move(*layout);
  for (const char* const option : {"--camera", "--ortho-height", "--follow", "--eye", "--look-at", "--fov"}) {
    view.is_camera_named = view.is_camera_named || command_.count(option) > 0;
  }
  const auto background = parseColor("--background", background_);
  if (!background) {
    return std::unexpected(background.error());
  }
  view.background = *background;
  const auto points = parsePointWay(points_);
  if (!points) {
    return std::unexpected(points.error());
  }
  view.points = *points;
  for (const auto& [what, text, member] :
       {std::tuple{"--eye", &eye_, &ViewOptions::eye}, std::tuple{"--look-at", &look_at_, &ViewOptions::look_at}}) {
    if (!text->empty()) {
      const auto point = parseVector(what, *text);
      if (!point) {
        return std::unexpected(point.error());
      }
      view.*member = *point;
    }
  }
  if (view.eye && view.eye == view.look_at) {
    return usageError("--eye and --look-at are the same point: there is no direction to look in");
  }
  for (const std::string& text : layers_) {
    auto layer = parseLayer(text);
    if (!layer) {
      return std::unexpected(layer.error());
    }
    view.layers.push_back(std::move(*layer));
  }
  if (!fixed_frame_.empty()) {
    view.fixed_frame = fixed_frame_;
  }
  if (view.only_named_layers && view.layers.empty()) {
    return usageError("--only draws the layers named by --layer, and none is");
  }
  return view;
}

}  // namespace stillframe::cli
