#include <array>

#include "tools/ingest/converters/converter.h"
#include "tools/ingest/converters/converters.h"

namespace stillframe::ingest {

std::span<const ConverterType> converterTypes() {
  using scenegraph::ObjectType;
  static constexpr auto kTypes = std::to_array<ConverterType>({
      {"tf2_msgs/TFMessage", ObjectType::FrameTransforms, converters::rosTransforms},
      {"tf/tfMessage", ObjectType::FrameTransforms, converters::rosTransforms},
      {"geometry_msgs/TransformStamped", ObjectType::FrameTransforms, converters::rosTransform},
      {"sensor_msgs/PointCloud2", ObjectType::PointCloud, converters::rosPointCloud},
  });
  return kTypes;
}

}  // namespace stillframe::ingest
