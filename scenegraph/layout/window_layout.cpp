#include "scenegraph/layout/window_layout.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "scenegraph/layout/read_values.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kLayoutVersion = 1;
constexpr int kLargestSide = 65'535;  // pixels
constexpr int kFarthest = 1'000'000;  // of a window's corner, where many screens make one desktop
constexpr std::size_t kMostViews = 64;
constexpr std::size_t kLongestSizes = 8 * kMostViews;  // characters

const std::vector<KnownElement>& knownInWindows() {
  static const std::vector<KnownElement> kKnown = {
      {kLayoutElement, {"version", "active_view"}, {"Window"}},
      {"Window", {"x", "y", "maximized", "width", "height", "docks"}, {"Splitter", kViewElement}},
      {"Splitter", {"orientation", "sizes"}, {"Splitter", kViewElement}},
  };
  return kKnown;
}

/// `element` with no more than the names of the children that are read from it: comments have their places by them.
XmlElement unreadPart(const XmlElement& element) {
  XmlElement rest{element.name};
  rest.attributes = element.attributes;
  for (const XmlElement& child : element.children) {
    const bool is_read = child.name == "Window" || child.name == "Splitter" || child.name == kViewElement;
    rest.children.push_back(is_read ? XmlElement{child.name} : child);
  }
  return rest;
}

std::string joined(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) {
    text += (text.empty() ? "" : ",") + std::to_string(number);
  }
  return text;
}

std::expected<std::vector<int>, Status> readSizes(const XmlElement& splitter) {
  std::vector<int> sizes;
  std::string text = readText(splitter, "sizes");
  if (text.size() > kLongestSizes) {
    return std::unexpected(badElement(splitter, "too many sizes"));
  }
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    XmlElement one{splitter.name};
    one.set("sizes", text.substr(0, comma));
    const auto size = readInt(one, "sizes", 0, 0, kLargestSide);
    if (!size) {
      return std::unexpected(size.error());
    }
    sizes.push_back(*size);
    text = comma == std::string::npos ? std::string() : text.substr(comma + 1);
  }
  return sizes;
}

XmlElement placeElement(const Place& place) {
  if (place.view) {
    return toXml(*place.view);
  }
  XmlElement splitter{"Splitter"};
  splitter.set("orientation", place.is_vertical ? "vertical" : "horizontal");
  splitter.set("sizes", joined(place.sizes));
  for (const Place& child : place.children) {
    splitter.children.push_back(placeElement(child));
  }
  keepUnknown(splitter, place.source, knownInWindows());
  return splitter;
}

bool isPlace(const XmlElement& element) { return element.name == kViewElement || element.name == "Splitter"; }

std::expected<Place, Status> placeOf(const XmlElement& element) {  // as deep as parseXml() allows
  Place place;
  if (element.name == kViewElement) {
    auto view = viewLayoutOf(element);
    if (!view) {
      return std::unexpected(view.error());
    }
    place.view = std::move(*view);
    return place;
  }
  const std::string orientation = readText(element, "orientation");
  if (orientation != "horizontal" && orientation != "vertical") {
    return std::unexpected(badElement(element, "orientation is horizontal or vertical"));
  }
  place.is_vertical = orientation == "vertical";
  auto sizes = readSizes(element);
  if (!sizes) {
    return std::unexpected(sizes.error());
  }
  for (const XmlElement& child : element.children) {
    if (isPlace(child)) {
      auto read = placeOf(child);
      if (!read) {
        return std::unexpected(read.error());
      }
      place.children.push_back(std::move(*read));
    }
  }
  if (place.children.empty() || sizes->size() != place.children.size()) {
    return std::unexpected(badElement(element, "it has " + std::to_string(place.children.size()) + " places and " +
                                                   std::to_string(sizes->size()) + " sizes"));
  }
  place.sizes = std::move(*sizes);
  place.source = unreadPart(element);
  return place;
}

std::expected<WindowLayout, Status> windowOf(const XmlElement& element) {
  WindowLayout window;
  const auto width = readInt(element, "width", window.width, 1, kLargestSide);
  const auto height = readInt(element, "height", window.height, 1, kLargestSide);
  if (!width || !height) {
    return std::unexpected(width ? height.error() : width.error());
  }
  window.width = *width;
  window.height = *height;
  const auto x = readInt(element, "x", 0, -kFarthest, kFarthest);
  const auto y = readInt(element, "y", 0, -kFarthest, kFarthest);
  const auto is_maximized = readBool(element, "maximized", false);
  if (!x || !y || !is_maximized) {
    return std::unexpected(!x ? x.error() : !y ? y.error() : is_maximized.error());
  }
  if (element.attribute("x") != nullptr && element.attribute("y") != nullptr) {
    window.corner = {*x, *y};
  }
  window.is_maximized = *is_maximized;
  window.docks = readText(element, "docks");
  for (const XmlElement& child : element.children) {
    if (isPlace(child)) {
      auto place = placeOf(child);
      if (!place) {
        return std::unexpected(place.error());
      }
      window.place = std::move(*place);
      window.source = unreadPart(element);
      return window;
    }
  }
  return std::unexpected(badElement(element, "it holds no view"));
}

void collectViews(const XmlElement& element, std::vector<const XmlElement*>& found) {
  if (element.name == kViewElement) {
    found.push_back(&element);
    return;
  }
  for (const XmlElement& child : element.children) {
    collectViews(child, found);
  }
}

/// Of a Place or a const Place.
template <typename PlaceType, typename Views>
void addViews(PlaceType& place, Views& views) {
  if (place.view) {
    views.push_back(&*place.view);
  }
  for (auto& child : place.children) {
    addViews(child, views);
  }
}

std::size_t depthOf(const XmlElement& element) {
  std::size_t deepest = 0;
  for (const XmlElement& child : element.children) {
    deepest = std::max(deepest, depthOf(child));
  }
  return deepest + 1;
}

/// Views of somebody else's layout, side by side.
std::expected<Layout, Status> foreignLayout(const XmlElement& root) {
  std::vector<const XmlElement*> found;
  collectViews(root, found);
  if (found.empty()) {
    return std::unexpected(Status{StatusLevel::Error, "NoView",
                                  "<" + root.name + "> holds no <" + std::string(kViewElement) + "> and no <" +
                                      std::string(kLayoutElement) + ">"});
  }
  if (found.size() > kMostViews) {
    return std::unexpected(badElement(root, "more than " + std::to_string(kMostViews) + " views"));
  }
  Place all;
  constexpr std::size_t kOurOwn = 3;  // elements round a view in a layout of ours
  for (const XmlElement* const element : found) {
    if (depthOf(*element) + kOurOwn > XmlLimits{}.depth) {
      return std::unexpected(badElement(*element, "what is in it is nested too deep to be saved again"));
    }
    auto place = placeOf(*element);
    if (!place) {
      return std::unexpected(place.error());
    }
    all.children.push_back(std::move(*place));
    all.sizes.push_back(1);
  }
  WindowLayout window;
  window.place = all.children.size() == 1 ? all.children.front() : all;
  Layout layout;
  layout.windows.push_back(std::move(window));
  return layout;
}

}  // namespace

XmlElement toXml(const Layout& layout) {
  XmlElement root{std::string(kLayoutElement)};
  root.set("version", std::to_string(kLayoutVersion));
  root.set("active_view", std::to_string(layout.active_view));
  for (const WindowLayout& window : layout.windows) {
    XmlElement& element = root.children.emplace_back(XmlElement{"Window"});
    if (window.corner) {
      element.set("x", std::to_string(window.corner->first));
      element.set("y", std::to_string(window.corner->second));
    }
    if (window.is_maximized) {
      element.set("maximized", settingText(true));
    }
    element.set("width", std::to_string(window.width));
    element.set("height", std::to_string(window.height));
    if (!window.docks.empty()) {
      element.set("docks", window.docks);
    }
    element.children.push_back(placeElement(window.place));
    keepUnknown(element, window.source, knownInWindows());
  }
  keepUnknown(root, layout.source, knownInWindows());
  return root;
}

std::expected<Layout, Status> layoutOf(const XmlElement& root) {
  if (root.name != kLayoutElement) {
    return foreignLayout(root);
  }
  if (const auto checked = checkVersion(root, kLayoutVersion); !checked) {
    return std::unexpected(checked.error());
  }
  Layout layout;
  const auto active = readInt(root, "active_view", layout.active_view, 1, static_cast<int>(kMostViews));
  if (!active) {
    return std::unexpected(active.error());
  }
  layout.active_view = *active;
  for (const XmlElement& child : root.children) {
    if (child.name == "Window") {
      auto window = windowOf(child);
      if (!window) {
        return std::unexpected(window.error());
      }
      layout.windows.push_back(std::move(*window));
    }
  }
  const std::size_t views = viewsOf(layout).size();
  if (views == 0 || views > kMostViews) {
    return std::unexpected(badElement(
        root, "it holds " + std::to_string(views) + " views; 1 to " + std::to_string(kMostViews) + " can be shown"));
  }
  layout.source = unreadPart(root);
  return layout;
}

std::expected<Layout, Status> parseLayout(std::string_view text) {
  const auto root = parseXml(text);
  return root ? layoutOf(*root) : std::unexpected(root.error());
}

std::expected<Layout, Status> readLayout(const std::filesystem::path& file) {
  const auto refused = [&](Status status) {
    status.message = file.string() + ": " + status.message;
    return std::unexpected(std::move(status));
  };
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);  // fails for what is no file
  if (error) {
    return refused({StatusLevel::Error, "CannotRead", "cannot be read: " + error.message()});
  }
  if (const XmlLimits limits; size > limits.bytes) {
    return refused({StatusLevel::Error, "LayoutTooLarge",
                    "it has " + std::to_string(size) + " bytes; a layout has at most " + std::to_string(limits.bytes)});
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) {
    return refused({StatusLevel::Error, "CannotRead", "cannot be read"});
  }
  auto layout = parseLayout(text);
  return layout ? std::move(layout) : refused(layout.error());
}

std::vector<const ViewLayout*> viewsOf(const Layout& layout) {
  std::vector<const ViewLayout*> views;
  for (const WindowLayout& window : layout.windows) {
    addViews(window.place, views);
  }
  return views;
}

std::vector<ViewLayout*> viewsOf(Layout& layout) {
  std::vector<ViewLayout*> views;
  for (WindowLayout& window : layout.windows) {
    addViews(window.place, views);
  }
  return views;
}

}  // namespace stillframe::scenegraph
