#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/camera/view_camera.h"
#include "scenegraph/layer_state.h"
#include "scenegraph/layout/xml.h"
#include "scenegraph/pick/pick_result.h"
#include "scenegraph/settings.h"

namespace stillframe::scenegraph {

/// All that makes a view what it is, in plain values: what a copy takes over, what is saved and restored. No Qt, no
/// OpenSceneGraph. Any thread, one at a time.
struct ViewLayout {
  std::string dataset;                     ///< name of the recording or stream it was of, "" for none
  std::optional<std::string> fixed_frame;  ///< chosen by hand; absent: automatic
  ViewpointState viewpoint;
  bool is_camera_touched = false;  ///< false: whatever there is to see is in sight
  bool has_smooth_moves = true;
  std::vector<SavedView> saved_views;
  SettingTexts effects;  ///< ViewEffects::toTexts()
  LayerList layers;
  PickMarks picks;
  bool shows_legend = true;  ///< what colours of values mean, over the picture
  bool shows_layers = true;  ///< the panels beside the picture
  bool shows_effects = false;
  std::optional<int> panel_width;  ///< theirs, in the window's pixels; absent: as wide as they begin
  /// What it was read from: what is unknown there is written again.
  XmlElement source = {};
};

inline constexpr std::string_view kViewElement = "Scene3DDock";
inline constexpr int kViewLayoutVersion = 1;

/// The view as a `<Scene3DDock version="1">` element. Attributes and elements of `source` that mean nothing here stay.
[[nodiscard]] XmlElement toXml(const ViewLayout& layout);
/// Reads one; what is missing keeps its default. Refuses the whole for another version or a value that is none, with
/// the code "WrongVersion" or "BadLayout".
[[nodiscard]] std::expected<ViewLayout, Status> viewLayoutOf(const XmlElement& element);

}  // namespace stillframe::scenegraph
