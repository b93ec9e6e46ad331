#pragma once

#include <expected>
#include <memory>
#include <string>
#include <string_view>

#include "tools/ingest/message_decoder.h"

/// The makers that the table of converters names, one for each way a schema is laid out.
namespace stillframe::ingest::converters {

using Created = std::expected<std::unique_ptr<MessageDecoder>, std::string>;

Created rosTransforms(const SchemaRecord& schema, std::string_view message_encoding);
Created rosTransform(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPointCloud(const SchemaRecord& schema, std::string_view message_encoding);
Created rosCompressedCloud(const SchemaRecord& schema, std::string_view message_encoding);
Created rosLaserScan(const SchemaRecord& schema, std::string_view message_encoding);
Created rosOccupancyGrid(const SchemaRecord& schema, std::string_view message_encoding);
Created rosOccupancyGridUpdate(const SchemaRecord& schema, std::string_view message_encoding);
Created rosGridMap(const SchemaRecord& schema, std::string_view message_encoding);
Created rosBitVoxelGrid(const SchemaRecord& schema, std::string_view message_encoding);
Created rosImage(const SchemaRecord& schema, std::string_view message_encoding);
Created rosCompressedImage(const SchemaRecord& schema, std::string_view message_encoding);
Created rosCameraInfo(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPoseArray(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPath(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPose(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPoseWithCovariance(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPoint(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPolygon(const SchemaRecord& schema, std::string_view message_encoding);
Created rosMarker(const SchemaRecord& schema, std::string_view message_encoding);
Created rosMarkers(const SchemaRecord& schema, std::string_view message_encoding);
Created rosRobotDescription(const SchemaRecord& schema, std::string_view message_encoding);
Created rosJointState(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveTransforms(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveTransform(const SchemaRecord& schema, std::string_view message_encoding);
Created foxglovePointCloud(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveCompressedCloud(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveLaserScan(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveGrid(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveVoxelGrid(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveRawImage(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveCompressedImage(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveCameraCalibration(const SchemaRecord& schema, std::string_view message_encoding);
Created foxglovePoses(const SchemaRecord& schema, std::string_view message_encoding);
Created foxglovePose(const SchemaRecord& schema, std::string_view message_encoding);
Created foxglovePoint(const SchemaRecord& schema, std::string_view message_encoding);
Created foxgloveScene(const SchemaRecord& schema, std::string_view message_encoding);
Created hostTransforms(const SchemaRecord& schema, std::string_view message_encoding);
Created hostPointCloud(const SchemaRecord& schema, std::string_view message_encoding);
Created hostCompressedCloud(const SchemaRecord& schema, std::string_view message_encoding);
Created hostOccupancyGrid(const SchemaRecord& schema, std::string_view message_encoding);
Created hostOccupancyGridUpdate(const SchemaRecord& schema, std::string_view message_encoding);
Created hostVoxelGrid(const SchemaRecord& schema, std::string_view message_encoding);
Created hostGridMap(const SchemaRecord& schema, std::string_view message_encoding);
Created hostImage(const SchemaRecord& schema, std::string_view message_encoding);
Created hostDepthImage(const SchemaRecord& schema, std::string_view message_encoding);
Created hostMesh(const SchemaRecord& schema, std::string_view message_encoding);
Created hostCameraInfo(const SchemaRecord& schema, std::string_view message_encoding);
Created hostPoses(const SchemaRecord& schema, std::string_view message_encoding);
Created hostRobotDescription(const SchemaRecord& schema, std::string_view message_encoding);
Created hostScene(const SchemaRecord& schema, std::string_view message_encoding);

}  // namespace stillframe::ingest::converters
