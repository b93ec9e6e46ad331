#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/pick/picked.h"

namespace stillframe::nodes {

/// Adds every field of a packed record (a point, a voxel, a cell of a grid map) that lies within `record`, with its own
/// type: of one with several values each as "name[i]", at most kMaxChannelValues. Any thread.
void addRecordFields(scenegraph::Picked& picked, const std::vector<scenegraph::PackedField>& fields,
                     std::span<const std::byte> record, bool is_bigendian);

/// "#rrggbb".
[[nodiscard]] std::string colorText(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// The bytes of a record that begins there, as far as the data goes.
[[nodiscard]] std::span<const std::byte> recordAt(std::span<const std::byte> data, std::size_t offset,
                                                  std::size_t size);

}  // namespace stillframe::nodes
