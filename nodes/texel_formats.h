#pragma once

#include <osg/GL>

namespace stillframe::nodes {

/// Sized formats of texels that OSG's headers name only for some profiles.
inline constexpr GLint kR8 = 0x8229;
inline constexpr GLint kR32f = 0x822E;
inline constexpr GLint kRgba8 = 0x8058;
inline constexpr GLint kRgba32f = 0x8814;

}  // namespace stillframe::nodes
