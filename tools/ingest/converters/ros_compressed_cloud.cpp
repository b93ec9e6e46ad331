// point_cloud_interfaces/CompressedPointCloud2.
#include "scenegraph/objects/compressed_point_cloud.h"
#include "tools/ingest/converters/compressed_clouds.h"
#include "tools/ingest/converters/converters.h"

namespace stillframe::ingest::converters {

Created rosCompressedCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  using scenegraph::CompressedPointCloud;
  Shape shape;
  shape.field<&CompressedCloudRow::cloud, &CompressedPointCloud::stamp>("header.stamp")
      .field<&CompressedCloudRow::cloud, &CompressedPointCloud::frame_id>("header.frame_id")
      .field<&CompressedCloudRow::cloud, &CompressedPointCloud::format>("format")
      .field<&CompressedCloudRow::data>("compressed_data");
  return RowDecoder<CompressedCloudRow>::create(schema, message_encoding, shape, compressedCloud);
}

}  // namespace stillframe::ingest::converters
