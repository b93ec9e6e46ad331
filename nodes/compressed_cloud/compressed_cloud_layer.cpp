#include "nodes/compressed_cloud/compressed_cloud_layer.h"

#include <string>
#include <utility>

#include "nodes/point_cloud/point_cloud_layer.h"
#include "nodes/points/codecs/decode_cloud.h"

namespace stillframe::nodes {
namespace {

CloudFeed::Cloud cloudOf(const scenegraph::AnyObject& object) {
  auto cloud = decodeCloud(*object.get<scenegraph::CompressedPointCloud>());
  if (!cloud) {
    return std::unexpected(scenegraph::Status{scenegraph::StatusLevel::Error, std::string(toString(cloud.error().code)),
                                              cloud.error().message});
  }
  return std::make_shared<const scenegraph::PointCloud>(std::move(*cloud));
}

}  // namespace

std::unique_ptr<scenegraph::Layer> createCompressedCloudLayer(std::string_view topic) {
  return std::make_unique<PointCloudLayer>(topic, feedOf(scenegraph::ObjectType::CompressedPointCloud, &cloudOf));
}

}  // namespace stillframe::nodes
