#pragma once

#include <string_view>

#include "scenegraph/frame_graph.h"
#include "scenegraph/status.h"
#include "tf/errors.h"

namespace stillframe::scenegraph {

/// Why data in `frame` is not drawn at the present tick, as every layer says it: the code is the lookup error's name,
/// the message names the frames, the edge and its time span, and the remedy where there is one.
///
/// Costs string work and, for an unknown fixed frame, a look over the frame names: make it when the failure is new.
[[nodiscard]] Status placementStatus(const FrameGraph& frames, std::string_view frame,
                                     const tf::LookupFailure& failure);

}  // namespace stillframe::scenegraph
