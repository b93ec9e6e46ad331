#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <osg/Group>
#include <osg/ref_ptr>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/settings.h"
#include "scenegraph/status.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// What an exported file says of itself, as description strings "key=value" of its root node.
struct ExportInfo {
  tf::TimePoint time;                                        ///< time_ns
  std::string fixed_frame;                                   ///< fixed_frame
  std::string source;                                        ///< source: the recording
  std::vector<std::pair<std::string, SettingTexts>> layers;  ///< layer=TOPIC:key=value,... one string a layer
  int viewport_height_px = 720;                              ///< for sizes in metres; a stock viewer does not tell
};

/// What is visible beneath `root` as a graph of its own that stock OpenSceneGraph draws, with the descriptions above.
/// Nodes of mask 0 are left out; drawables and state are shared with `root`.
[[nodiscard]] osg::ref_ptr<osg::Node> makeExportGraph(const osg::Group& root, const ExportInfo& info);

/// Writes what is visible beneath `root` as .osgt (text, 17 digits) or .osgb (binary) for a stock osgviewer.
///
/// Nodes of mask 0 are left out; frame nodes keep their names and double matrices. The graph itself is not changed.
/// Before anything is written every object is checked: "NotExportable" names a class that OSG would drop in silence (a
/// subclass, a foreign class, an Image-backed TextureBuffer); "NotFinite" names an array, uniform or matrix with a NaN
/// or infinity, which would come back as 0. "UnknownFormat" for another extension, "CannotWrite" as picture_io.h says.
/// Thread that owns the graph; cost is that of the file.
std::expected<void, Status> exportGraph(const osg::Group& root, const ExportInfo& info,
                                        const std::filesystem::path& path);

}  // namespace stillframe::scenegraph
