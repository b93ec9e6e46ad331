#include "tools/cli/view_options.h"

namespace stillframe::cli {

ViewArguments::ViewArguments(CLI::App& command) {
  addRecordingOptions(command, options_.recording);
  command.add_option("--time", time_, "Nanoseconds, +SECONDS from the start, start, or end")->capture_default_str();
  command.add_option("--fixed-frame", fixed_frame_, "Frame that stands still; default: map, world, odom, ...");
  command
      .add_option("--layer", layers_,
                  "TOPIC[:key=value,...]: settings of a layer, e.g. grid:visible=false; may be repeated")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  command.add_flag("--only", options_.only_named_layers, "Draw just the layers named by --layer");
  command.add_option("--eye", eye_, "x,y,z of the eye in the fixed frame; default: where all is seen");
  command.add_option("--look-at", look_at_, "x,y,z that the eye looks at; default: the middle of the data");
  command.add_option("--fov", fov_, "Vertical field of view in degrees, 1 to 170")->capture_default_str();
  command.add_option("--size", size_, "WIDTHxHEIGHT of the picture in pixels")->capture_default_str();
  command
      .add_option("--background", background_, "#rrggbb, or r,g,b with components 0..1 (or 0..255 when one is above 1)")
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
  const auto background = parseColor("--background", background_);
  if (!background) {
    return std::unexpected(background.error());
  }
  view.background = *background;
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
