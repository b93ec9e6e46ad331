#include "nodes/point_cloud/describe_point.h"

#include <array>
#include <cstdint>

#include "nodes/points/cloud_layout.h"
#include "nodes/points/point_colors.h"
#include "nodes/points/read_value.h"
#include "nodes/points/record_fields.h"

namespace stillframe::nodes {
namespace {

/// Where a drawn point lies in the data.
std::optional<std::size_t> offsetOf(const ConvertedCloud& converted, std::size_t index) {
  for (const PointRun& run : converted.runs) {
    if (index < run.count) {
      return run.offset + index * converted.point_step;
    }
    index -= run.count;
  }
  return std::nullopt;
}

}  // namespace

std::optional<scenegraph::Picked> describePoint(const CloudPoints& cloud, std::size_t index) {
  const auto message = cloud.holdMessage();
  if (message == nullptr) {
    return std::nullopt;
  }
  const scenegraph::PointCloud& source = *message;
  const auto offset = offsetOf(cloud.converted(), index);
  const auto layout = checkLayout(source);
  if (!offset || !layout) {
    return std::nullopt;
  }
  const std::span<const std::byte> record = recordAt(source.data.bytes, *offset, layout->point_step);
  glm::dvec3 point(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const scenegraph::PackedField& field = *layout->xyz[static_cast<std::size_t>(axis)];
    point[axis] = valueReader(field.type, source.is_bigendian)(record.data() + field.offset);
  }
  const std::size_t row = layout->row_step == 0 ? 0 : *offset / layout->row_step;
  const std::size_t in_row = (*offset - row * layout->row_step) / layout->point_step;
  const std::size_t number = row * layout->points_per_row + in_row;
  scenegraph::Picked picked{.kind = "point",
                            .id = std::to_string(number),
                            .point_in_frame = tf::transformPoint(source.pose, point),
                            .stamp = source.stamp,
                            .fields = {},
                            .radius_m = 0.5};
  if (source.height > 1 && source.width > 0) {
    picked.add("row", number / source.width);
    picked.add("column", number % source.width);
  }
  addRecordFields(picked, source.fields, record, source.is_bigendian);
  if (const auto colors = findColors(source)) {
    ConvertedCloud one;
    one.points = 1;
    one.runs = {{*offset, 1}};
    one.point_step = cloud.converted().point_step;
    std::array<std::uint8_t, 4> rgba{};
    convertColors(source, one, *colors, rgba);
    picked.add("color", colorText(rgba[0], rgba[1], rgba[2]));
  }
  return picked;
}

}  // namespace stillframe::nodes
