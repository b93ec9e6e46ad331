#include "scenegraph/layout/pick_layout.h"

#include <array>
#include <utility>

#include "scenegraph/layout/read_values.h"

namespace stillframe::scenegraph {
namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
constexpr double kLargestRadiusM = 1e12;

void setPoint(XmlElement& element, const std::string& prefix, const glm::dvec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    element.set(prefix + kAxes.at(static_cast<std::size_t>(axis)), settingText(point[axis]));
  }
}

std::expected<glm::dvec3, Status> readPoint(const XmlElement& element, const std::string& prefix) {
  glm::dvec3 point(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = readDouble(element, prefix + kAxes.at(static_cast<std::size_t>(axis)), 0.0);
    if (!value) {
      return std::unexpected(value.error());
    }
    point[axis] = *value;
  }
  return point;
}

XmlElement pickElement(std::string_view name, const PickResult& pick) {
  XmlElement element{std::string(name)};
  element.set("topic", pick.topic);
  element.set("layer", pick.layer);
  element.set("kind", pick.picked.kind);
  element.set("id", pick.picked.id);
  element.set("frame", pick.frame);
  setPoint(element, "", pick.picked.point_in_frame);
  element.set("radius_m", settingText(pick.picked.radius_m));
  if (pick.picked.stamp) {
    element.set("stamp_ns", settingText(pick.picked.stamp->ns));
  }
  element.set("fixed_frame", pick.fixed_frame);
  setPoint(element, "fixed_", pick.point_in_fixed);
  element.set("time_ns", settingText(pick.time.ns));
  for (const auto& [key, value] : pick.picked.fields) {
    XmlElement& field = element.children.emplace_back(XmlElement{"Field"});
    field.set("name", key);
    field.set("value", pickText(value));
  }
  return element;
}

std::expected<PickResult, Status> pickOf(const XmlElement& element) {
  PickResult pick;
  pick.topic = readText(element, "topic");
  pick.layer = readText(element, "layer");
  pick.frame = readText(element, "frame");
  pick.fixed_frame = readText(element, "fixed_frame");
  pick.picked.kind = readText(element, "kind");
  pick.picked.id = readText(element, "id");
  if (pick.frame.empty()) {
    return std::unexpected(badElement(element, "it has no frame"));
  }
  const auto point = readPoint(element, "");
  const auto fixed = readPoint(element, "fixed_");
  const auto radius_m = readDouble(element, "radius_m", pick.picked.radius_m, 0.0, kLargestRadiusM);
  const auto time_ns = readInt64(element, "time_ns", 0);
  const auto stamp_ns = readInt64(element, "stamp_ns", 0);
  for (const Status* const error :
       {point ? nullptr : &point.error(), fixed ? nullptr : &fixed.error(), radius_m ? nullptr : &radius_m.error(),
        time_ns ? nullptr : &time_ns.error(), stamp_ns ? nullptr : &stamp_ns.error()}) {
    if (error != nullptr) {
      return std::unexpected(*error);
    }
  }
  pick.picked.point_in_frame = *point;
  pick.point_in_fixed = *fixed;
  pick.picked.radius_m = *radius_m;
  pick.time.ns = *time_ns;
  if (element.attribute("stamp_ns") != nullptr) {
    pick.picked.stamp = tf::TimePoint{*stamp_ns};
  }
  for (const XmlElement& child : element.children) {
    if (child.name == "Field") {
      pick.picked.fields.emplace_back(readText(child, "name"), readText(child, "value"));
    }
  }
  return pick;
}

}  // namespace

std::vector<std::string> pickAttributes() {
  std::vector<std::string> names;
  PickResult pick;
  pick.picked.stamp = tf::TimePoint{};
  for (const auto& [key, value] : pickElement(kPickedElement, pick).attributes) {
    names.push_back(key);
  }
  return names;
}

void addPicks(const PickMarks& picks, XmlElement& parent) {
  if (picks.selected) {
    parent.children.push_back(pickElement(kPickedElement, *picks.selected));
  }
  for (const auto& [from, to] : picks.measured) {
    XmlElement& element = parent.children.emplace_back(XmlElement{std::string(kMeasurementElement)});
    element.children.push_back(pickElement("From", from));
    element.children.push_back(pickElement("To", to));
  }
}

std::expected<void, Status> readPicks(const XmlElement& child, PickMarks& picks) {
  if (child.name == kPickedElement) {
    if (picks.selected) {
      return std::unexpected(badElement(child, "the view has two picked points"));
    }
    auto pick = pickOf(child);
    if (!pick) {
      return std::unexpected(pick.error());
    }
    picks.selected = std::move(*pick);
  } else if (child.name == kMeasurementElement) {
    const XmlElement* const from = child.child("From");
    const XmlElement* const to = child.child("To");
    if (from == nullptr || to == nullptr) {
      return std::unexpected(badElement(child, "it needs a <From> and a <To>"));
    }
    auto begin = pickOf(*from);
    auto end = pickOf(*to);
    if (!begin || !end) {
      return std::unexpected(begin ? end.error() : begin.error());
    }
    picks.measured.emplace_back(std::move(*begin), std::move(*end));
  }
  return {};
}

}  // namespace stillframe::scenegraph
