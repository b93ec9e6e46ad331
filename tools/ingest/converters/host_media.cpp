// The host's images, cameras and meshes (package PJ). Top-level fields go by number, which is what the host fixes.
#include <memory>
#include <utility>

#include "scenegraph/objects/image.h"
#include "scenegraph/objects/scene_entities.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/host_shapes.h"
#include "tools/ingest/converters/images.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

using scenegraph::CameraInfo;
using scenegraph::Image;

namespace {

/// Depth and intrinsics in one, without a frame.
struct HostDepthRow {
  ImageRow image;
  CameraRow camera;
};

RowDecoder<HostDepthRow>::Result depthImage(HostDepthRow& row, const MessageView& payloads) {
  Image& image = row.image.image;
  row.camera.info.stamp = image.stamp;
  row.camera.info.width = image.width;
  row.camera.info.height = image.height;
  const auto camera = cameraInfo(row.camera, payloads);
  if (!camera) {
    return std::unexpected(camera.error());
  }
  image.camera = camera->get<CameraInfo>();
  return rawImage(row.image, payloads);
}

/// A mesh under its id.
struct HostMeshRow {
  scenegraph::SceneEntity entity;
  scenegraph::ModelPrimitive model;
  std::span<const std::byte> data;
};

RowDecoder<HostMeshRow>::Result mesh(HostMeshRow& row, const MessageView& payloads) {
  if (!row.data.empty()) {
    row.model.data = payloadOf(row.data, payloads);
  }
  row.entity.frame_id = std::string(tf::stripLeadingSlashes(row.entity.frame_id));
  row.entity.models.push_back(std::move(row.model));
  scenegraph::SceneEntities scene;
  scene.payload_bytes = payloads.data.size();
  scene.steps.push_back({false, 0});
  scene.entities.push_back(std::move(row.entity));
  return scenegraph::AnyObject::make(std::move(scene));
}

}  // namespace

Created hostImage(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&ImageRow::image, &Image::stamp>("1")
      .field<&ImageRow::image, &Image::width>("2")
      .field<&ImageRow::image, &Image::height>("3")
      .field<&ImageRow::image, &Image::encoding>("4")
      .field<&ImageRow::image, &Image::row_step>("5")
      .field<&ImageRow::image, &Image::is_bigendian>("6")
      .field<&ImageRow::data>("7")
      .field<&ImageRow::image, &Image::frame_id>("10");
  return RowDecoder<ImageRow>::create(schema, message_encoding, shape, rawImage);
}

Created hostCameraInfo(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&CameraRow::info, &CameraInfo::stamp>("1")
      .field<&CameraRow::info, &CameraInfo::frame_id>("2")
      .field<&CameraRow::info, &CameraInfo::width>("3")
      .field<&CameraRow::info, &CameraInfo::height>("4")
      .field<&CameraRow::info, &CameraInfo::distortion_model>("5")
      .field<&CameraRow::info, &CameraInfo::distortion>("6")
      .field<&CameraRow::k>("7")
      .field<&CameraRow::r>("8")
      .field<&CameraRow::p>("9");
  return RowDecoder<CameraRow>::create(schema, message_encoding, shape, cameraInfo);
}

Created hostDepthImage(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&HostDepthRow::image, &ImageRow::image, &Image::stamp>("1")
      .field<&HostDepthRow::image, &ImageRow::image, &Image::width>("2")
      .field<&HostDepthRow::image, &ImageRow::image, &Image::height>("3")
      .field<&HostDepthRow::image, &ImageRow::image, &Image::encoding>("4")
      .field<&HostDepthRow::image, &ImageRow::data>("5")
      .field<&HostDepthRow::camera, &CameraRow::k>("6")
      .field<&HostDepthRow::camera, &CameraRow::info, &CameraInfo::distortion_model>("7")
      .field<&HostDepthRow::camera, &CameraRow::info, &CameraInfo::distortion>("8");
  return RowDecoder<HostDepthRow>::create(schema, message_encoding, shape, depthImage);
}

Created hostMesh(const SchemaRecord& schema, std::string_view message_encoding) {
  using scenegraph::ModelPrimitive;
  using scenegraph::SceneEntity;
  Shape shape;
  shape.field<&HostMeshRow::entity, &SceneEntity::stamp>("1")
      .field<&HostMeshRow::entity, &SceneEntity::frame_id>("2")
      .field<&HostMeshRow::entity, &SceneEntity::id>("3")
      .row<&HostMeshRow::model, &ModelPrimitive::pose>("4", hostPose())
      .row<&HostMeshRow::model, &ModelPrimitive::scale>("5", hostVector())
      .field<&HostMeshRow::model, &ModelPrimitive::media_type>("6")
      .field<&HostMeshRow::data>("7")
      .field<&HostMeshRow::model, &ModelPrimitive::url>("8")
      .row<&HostMeshRow::model, &ModelPrimitive::color>("9", hostColor())
      .field<&HostMeshRow::model, &ModelPrimitive::is_color_override>("10");
  return RowDecoder<HostMeshRow>::create(schema, message_encoding, shape, mesh);
}

}  // namespace stillframe::ingest::converters
