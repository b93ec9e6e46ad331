#include "scenegraph/layout/view_layout.h"

#include <set>
#include <utility>

#include "scenegraph/layout/pick_layout.h"
#include "scenegraph/layout/read_values.h"

namespace stillframe::scenegraph {
namespace {

const std::string kDisplayFrame = "display_frame";  // absent: the fixed frame
constexpr int kWidestPanel = 65'535;                // pixels

XmlElement textsElement(std::string name, const SettingTexts& texts) {
  XmlElement element{std::move(name)};
  for (const auto& [key, text] : texts) {
    element.set(key, text);
  }
  return element;
}

SettingTexts textsOf(const XmlElement& element) { return {element.attributes.begin(), element.attributes.end()}; }

std::vector<std::string> keysOf(const SettingTexts& texts, const std::vector<std::string>& more = {}) {
  std::vector<std::string> keys = more;
  for (const auto& [key, text] : texts) {
    keys.push_back(key);
  }
  return keys;
}

const std::vector<KnownElement>& knownInView() {
  static const std::vector<KnownElement> kKnown = {
      {kViewElement,
       {"version", "dataset", "fixed_frame", "camera_touched", "smooth_moves", "layer_panel", "effect_panel",
        "panel_width", "legend"},
       {"Camera", "Follow", "Effects", "SavedView", "Layer", "RemovedLayer", kPickedElement, kMeasurementElement}},
      {"Camera", keysOf(cameraTexts({}))},
      {"Follow", keysOf(followTexts({}), {kDisplayFrame})},
      {"Effects", {}},  // their texts hold what is unknown too
      {"SavedView", {"name"}, {"Camera", "Follow"}, "name"},
      {"Layer", {"id", "title", "visible"}, {"Setting"}, "id"},
      {"RemovedLayer", {"id"}, {}, "id"},
      {"Setting", {"key", "value"}, {}, "key"},
      {kPickedElement, pickAttributes(), {"Field"}},
  };
  return kKnown;
}

void addViewpoint(const ViewpointState& viewpoint, XmlElement& parent) {
  parent.children.push_back(textsElement("Camera", cameraTexts(viewpoint.camera)));
  SettingTexts follow = followTexts(viewpoint.follow);
  if (viewpoint.display_frame) {
    follow[kDisplayFrame] = *viewpoint.display_frame;
  }
  parent.children.push_back(textsElement("Follow", follow));
}

std::expected<ViewpointState, Status> viewpointOf(const XmlElement& parent) {
  ViewpointState viewpoint;
  if (const XmlElement* const camera = parent.child("Camera")) {
    if (const auto read = applyCameraTexts(textsOf(*camera), viewpoint.camera); !read) {
      return std::unexpected(badElement(*camera, read.error().message));
    }
  }
  if (const XmlElement* const follow = parent.child("Follow")) {
    if (const auto read = applyFollowTexts(textsOf(*follow), viewpoint.follow); !read) {
      return std::unexpected(badElement(*follow, read.error().message));
    }
    if (const std::string frame = readText(*follow, kDisplayFrame); !frame.empty()) {
      viewpoint.display_frame = frame;
    }
  }
  return viewpoint;
}

std::expected<LayerState, Status> layerOf(const XmlElement& element) {
  LayerState layer{.id = readText(element, "id"), .title = readText(element, "title"), .settings = {}};
  if (layer.id.empty()) {
    return std::unexpected(badElement(element, "it has no id"));
  }
  const auto is_visible = readBool(element, "visible", true);
  if (!is_visible) {
    return std::unexpected(is_visible.error());
  }
  layer.is_visible = *is_visible;
  for (const XmlElement& child : element.children) {
    if (child.name == "Setting") {
      layer.settings[readText(child, "key")] = readText(child, "value");
    }
  }
  layer.settings.erase("");
  return layer;
}

XmlElement layerElement(const LayerState& layer) {
  XmlElement element{"Layer"};
  element.set("id", layer.id);
  if (!layer.title.empty()) {
    element.set("title", layer.title);
  }
  element.set("visible", settingText(layer.is_visible));
  for (const auto& [key, text] : layer.settings) {
    XmlElement& setting = element.children.emplace_back(XmlElement{"Setting"});
    setting.set("key", key);
    setting.set("value", text);
  }
  return element;
}

std::expected<void, Status> readChild(const XmlElement& child, ViewLayout& layout, std::set<std::string>& ids) {
  if (child.name == "Effects") {
    layout.effects = textsOf(child);
  } else if (child.name == "SavedView") {
    auto viewpoint = viewpointOf(child);
    if (!viewpoint) {
      return std::unexpected(viewpoint.error());
    }
    layout.saved_views.push_back({readText(child, "name"), std::move(*viewpoint)});
  } else if (child.name == "Layer") {
    auto layer = layerOf(child);
    if (!layer) {
      return std::unexpected(layer.error());
    }
    if (!ids.insert(layer->id).second) {
      return std::unexpected(badElement(child, "the view has two layers of that id"));
    }
    layout.layers.layers.push_back(std::move(*layer));
  } else if (child.name == "RemovedLayer") {
    layout.layers.removed_topics.insert(readText(child, "id"));
  }
  return readPicks(child, layout.picks);
}

}  // namespace

XmlElement toXml(const ViewLayout& layout) {
  XmlElement view{std::string(kViewElement)};
  view.set("version", std::to_string(kViewLayoutVersion));
  if (!layout.dataset.empty()) {
    view.set("dataset", layout.dataset);
  }
  if (layout.fixed_frame) {
    view.set("fixed_frame", *layout.fixed_frame);
  }
  view.set("camera_touched", settingText(layout.is_camera_touched));
  view.set("smooth_moves", settingText(layout.has_smooth_moves));
  view.set("layer_panel", settingText(layout.shows_layers));
  view.set("effect_panel", settingText(layout.shows_effects));
  if (layout.panel_width) {
    view.set("panel_width", std::to_string(*layout.panel_width));
  }
  view.set("legend", settingText(layout.shows_legend));
  addViewpoint(layout.viewpoint, view);
  view.children.push_back(textsElement("Effects", layout.effects));
  for (const SavedView& saved : layout.saved_views) {
    XmlElement& element = view.children.emplace_back(XmlElement{"SavedView"});
    element.set("name", saved.name);
    addViewpoint(saved.viewpoint, element);
  }
  for (const LayerState& layer : layout.layers.layers) {
    view.children.push_back(layerElement(layer));
  }
  for (const std::string& topic : layout.layers.removed_topics) {
    view.children.emplace_back(XmlElement{"RemovedLayer"}).set("id", topic);
  }
  addPicks(layout.picks, view);
  keepUnknown(view, layout.source, knownInView());
  return view;
}

std::expected<ViewLayout, Status> viewLayoutOf(const XmlElement& element) {
  if (element.name != kViewElement) {
    return std::unexpected(badElement(element, "it is no <" + std::string(kViewElement) + ">"));
  }
  if (const auto checked = checkVersion(element, kViewLayoutVersion); !checked) {
    return std::unexpected(checked.error());
  }
  ViewLayout layout;
  layout.dataset = readText(element, "dataset");
  if (const std::string frame = readText(element, "fixed_frame"); !frame.empty()) {
    layout.fixed_frame = frame;
  }
  for (const auto& [key, member] :
       {std::pair("camera_touched", &ViewLayout::is_camera_touched),
        std::pair("smooth_moves", &ViewLayout::has_smooth_moves), std::pair("layer_panel", &ViewLayout::shows_layers),
        std::pair("effect_panel", &ViewLayout::shows_effects), std::pair("legend", &ViewLayout::shows_legend)}) {
    const auto value = readBool(element, key, layout.*member);
    if (!value) {
      return std::unexpected(value.error());
    }
    layout.*member = *value;
  }
  if (element.attribute("panel_width") != nullptr) {
    const auto width = readInt(element, "panel_width", 0, 1, kWidestPanel);
    if (!width) {
      return std::unexpected(width.error());
    }
    layout.panel_width = *width;
  }
  auto viewpoint = viewpointOf(element);
  if (!viewpoint) {
    return std::unexpected(viewpoint.error());
  }
  layout.viewpoint = std::move(*viewpoint);
  std::set<std::string> ids;
  for (const XmlElement& child : element.children) {
    if (const auto read = readChild(child, layout, ids); !read) {
      return std::unexpected(read.error());
    }
  }
  layout.source = element;
  return layout;
}

}  // namespace stillframe::scenegraph
