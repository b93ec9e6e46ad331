#pragma once

#include <cstddef>
#include <vector>

#include "scenegraph/objects/point_cloud.h"

namespace stillframe::sample {

/// The cloud as a sequential Draco stream by libdraco's encoder: x, y and z, which must be three FLOAT32 one after the
/// other, as positions of `position_bits`; every other field exact, under its name. Throws std::logic_error when the
/// cloud is none of that kind.
[[nodiscard]] std::vector<std::byte> writeDraco(const scenegraph::PointCloud& cloud, int position_bits);

}  // namespace stillframe::sample
