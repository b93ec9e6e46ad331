#pragma once

#include "scenegraph/passes/effect.h"

namespace stillframe::scenegraph {

/// Rounds to the 256 steps of an 8-bit sRGB picture with a pattern instead of at once, so that slow gradients have no
/// bands. A colour that is one of the steps stays exactly that: the pattern is a little less than half a step high.
struct DitherSettings {};

[[nodiscard]] EffectType ditherEffect();
void appendDither(const DitherSettings& settings, PostChain& chain);

}  // namespace stillframe::scenegraph
