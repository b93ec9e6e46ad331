#pragma once

#include "scenegraph/store/object_store.h"
#include "viewer/time/time_text.h"

namespace stillframe::viewer {

/// Where a recording opens when nobody says where: the first moment at which there is something to see.
///
/// Topics do not begin together, and at the very start most layers have no message yet. Taken is the moment when all
/// topics have begun that begin within a tenth of the recording, two seconds at most; where nothing but transforms
/// does, the first message of what begins first. O(topics).
[[nodiscard]] tf::TimePoint openingTime(const scenegraph::ObjectStore& store, const TimeRange& range);

}  // namespace stillframe::viewer
