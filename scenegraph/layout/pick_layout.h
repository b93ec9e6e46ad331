#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/layout/xml.h"
#include "scenegraph/pick/pick_result.h"

namespace stillframe::scenegraph {

/// Names of the elements that keep what is picked: one point, and lengths from a point to another.
inline constexpr std::string_view kPickedElement = "Picked";
inline constexpr std::string_view kMeasurementElement = "Measurement";

/// Attributes of an element that is a picked point; it has `<Field name= value=>` children.
[[nodiscard]] std::vector<std::string> pickAttributes();

/// Appends what is picked and measured to `parent`.
void addPicks(const PickMarks& picks, XmlElement& parent);

/// Takes one child of a view into `picks`; other elements are left alone. Numbers come back exactly, fields as texts.
/// "BadLayout" for a point that is not finite, has no frame, or for a length without both ends; a second `<Picked>`.
[[nodiscard]] std::expected<void, Status> readPicks(const XmlElement& child, PickMarks& picks);

}  // namespace stillframe::scenegraph
