#pragma once

#include <string>

#include "scenegraph/layout/window_layout.h"

namespace stillframe::test {

/// Something picked in a frame, with numbers that only exact digits bring back.
[[nodiscard]] scenegraph::PickResult makePick(const std::string& frame, const glm::dvec3& point_in_frame);

/// A view in which nothing is as at first: frames, a turned camera that follows, saved views, effects, layers.
[[nodiscard]] scenegraph::ViewLayout makeViewLayout();
/// Three such views: one beside two that lie one above the other, and one more in a window of its own.
[[nodiscard]] scenegraph::Layout makeLayout();

/// Text of a view whose attributes and children are those.
[[nodiscard]] std::string viewText(const std::string& attributes, const std::string& children = {});

}  // namespace stillframe::test
