#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/objects/scene_entities.h"
#include "tf/rigid_transform.h"
#include "tf/transform_buffer.h"
#include "tools/ingest/message_decoder.h"
#include "tools/ingest/wire_shape.h"

/// Shapes and rows that several schemas share. ROS and Foxglove name these fields alike.
namespace stillframe::ingest::converters {

[[nodiscard]] Shape vectorShape();        ///< glm::dvec3: x, y, z
[[nodiscard]] Shape planarVectorShape();  ///< glm::dvec2: x, y
[[nodiscard]] Shape quaternionShape();    ///< glm::dquat: x, y, z, w
[[nodiscard]] Shape poseShape();          ///< tf::RigidTransform: position, orientation
[[nodiscard]] Shape colorShape();         ///< scenegraph::EntityColor: r, g, b, a

/// foxglove.PackedElementField.
struct PackedFieldRow {
  std::string_view name;
  std::uint32_t offset = 0;
  std::uint32_t type = 0;
};
[[nodiscard]] Shape packedFieldShape();
/// Foxglove's numbers of types turned into ours.
[[nodiscard]] std::vector<scenegraph::PackedField> packedFields(const std::vector<PackedFieldRow>& rows);

/// sensor_msgs/PointField's number, or Unknown.
[[nodiscard]] scenegraph::FieldType fieldType(std::uint32_t number) noexcept;

/// The object with its frame id as TF has it, ready to be handed out.
template <typename Object>
[[nodiscard]] scenegraph::AnyObject finished(Object object) {
  object.frame_id = std::string(tf::stripLeadingSlashes(object.frame_id));
  return scenegraph::AnyObject::make(std::move(object));
}

/// Count of whole strides in `bytes`; 0 for a stride of 0, and never beyond uint32.
[[nodiscard]] std::uint32_t countOf(std::size_t bytes, std::uint32_t stride) noexcept;

}  // namespace stillframe::ingest::converters
