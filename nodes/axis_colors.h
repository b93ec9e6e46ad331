#pragma once

#include <array>

#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// Red, green and blue for x, y and z, sRGB: the arms of every triad.
inline constexpr std::array<scenegraph::Color, 3> kAxisColors{
    {{.r = 235 / 255.0F, .g = 52 / 255.0F, .b = 52 / 255.0F, .a = 1.0F},
     {.r = 52 / 255.0F, .g = 200 / 255.0F, .b = 68 / 255.0F, .a = 1.0F},
     {.r = 64 / 255.0F, .g = 110 / 255.0F, .b = 255 / 255.0F, .a = 1.0F}}};

}  // namespace stillframe::nodes
