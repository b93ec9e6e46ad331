#include "nodes/points/codecs/decode_cloud.h"

#include <string>

#include "nodes/points/codecs/cloudini.h"
#include "nodes/points/codecs/draco.h"

namespace stillframe::nodes {
namespace {

std::expected<scenegraph::PointCloud, CodecError> decodeBlob(const scenegraph::CompressedPointCloud& cloud) {
  if (cloud.format == "draco") {
    return decodeDraco(cloud.data);
  }
  if (cloud.format == "cloudini") {
    return decodeCloudini(cloud.data);
  }
  if (cloud.format == "zstd") {
    return std::unexpected(CodecError{CodecErrorCode::UnknownFormat,
                                      "zstd clouds do not describe themselves: their fields are not in the message; "
                                      "'draco' and 'cloudini' are decoded"});
  }
  return std::unexpected(
      CodecError{CodecErrorCode::UnknownFormat,
                 "the format '" + cloud.format.substr(0, 40) + "' is not known; 'draco' and 'cloudini' are decoded"});
}

}  // namespace

std::expected<scenegraph::PointCloud, CodecError> decodeCloud(const scenegraph::CompressedPointCloud& cloud) {
  auto decoded = decodeBlob(cloud);
  if (decoded) {
    decoded->stamp = cloud.stamp;
    decoded->frame_id = cloud.frame_id;
    decoded->pose = cloud.pose;
  }
  return decoded;
}

}  // namespace stillframe::nodes
