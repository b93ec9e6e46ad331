#pragma once

#include <cstddef>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/layout/view_layout.h"

namespace stillframe::scenegraph {

/// A place in a window: one view, or places side by side or one above the other. Depth is bounded by that of XML.
struct Place {
  std::optional<ViewLayout> view;  ///< present: this one view, no children
  bool is_vertical = false;        ///< children one above the other
  std::vector<int> sizes = {};     ///< of the children along the splitter, in pixels; any unit, as they are shared out
  std::vector<Place> children = {};
  XmlElement source = {};  ///< what is unknown in it is written again
};

/// A window of the inspector: the first of a layout is the main one, the others hold views that were taken out of it.
struct WindowLayout {
  std::optional<std::pair<int, int>> corner = {};  ///< upper left on the desktop, of the whole frame; absent: anywhere
  bool is_maximized = false;
  int width = 1280;  ///< when it is not maximized
  int height = 800;
  std::string docks = {};  ///< state of its docks and tool bars, as text that only the window system's toolkit reads
  Place place = {};
  XmlElement source = {};
};

/// A whole arrangement: what `view --layout` opens and Save layout writes.
struct Layout {
  std::vector<WindowLayout> windows;
  int active_view = 1;  ///< the one that had the focus last, by its number in viewsOf(), from 1
  XmlElement source = {};
};

inline constexpr std::string_view kLayoutElement = "StillframeLayout";

[[nodiscard]] XmlElement toXml(const Layout& layout);
/// Reads a `<StillframeLayout>`, or a single `<Scene3DDock>`, or any XML (a host's own layout) that holds some: those
/// side by side. Code "NoView" when there is none.
[[nodiscard]] std::expected<Layout, Status> layoutOf(const XmlElement& root);
/// The same from a text, and from a file of at most 16 MiB; the errors of a file name it.
[[nodiscard]] std::expected<Layout, Status> parseLayout(std::string_view text);
[[nodiscard]] std::expected<Layout, Status> readLayout(const std::filesystem::path& file);

/// All views of a layout, window by window.
[[nodiscard]] std::vector<const ViewLayout*> viewsOf(const Layout& layout);
[[nodiscard]] std::vector<ViewLayout*> viewsOf(Layout& layout);

}  // namespace stillframe::scenegraph
