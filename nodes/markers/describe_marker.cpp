// What MarkerPicture says of an entity that is picked.
#include <algorithm>

#include "nodes/markers/marker_picture.h"
#include "nodes/points/record_fields.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Picked;

/// A marker of ROS has the id "<length of ns>:<ns>:<id>".
std::string shortId(const LiveEntity& entity) {
  const std::string prefix = std::to_string(entity.marker_namespace.size()) + ":" + entity.marker_namespace + ":";
  return entity.id.starts_with(prefix) ? entity.id.substr(prefix.size()) : entity.id;
}

const char* kindName(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::Box:
      return "cube";
    case ShapeKind::Sphere:
      return "sphere";
    case ShapeKind::Frustum:
      return "cylinder, arrow or axes";
    case ShapeKind::Square:
      break;
  }
  return "point";
}

Picked describeEntity(const LiveEntity& entity, const glm::dvec3& point_in_frame, const std::string& primitive) {
  Picked picked{.kind = "marker",
                .id = shortId(entity),
                .point_in_frame = point_in_frame,
                .stamp = entity.stamp,
                .fields = {},
                .radius_m = 1.0};
  if (!entity.marker_namespace.empty()) {
    picked.add("namespace", entity.marker_namespace);
  }
  picked.add("primitive", primitive);
  picked.add("primitives", entity.primitives);
  picked.add("log_time_ns", entity.log_time.ns);
  if (entity.expiry.ns != LiveEntity{}.expiry.ns) {
    picked.add("expires_ns", entity.expiry.ns);
  }
  picked.add("frame_locked", entity.is_frame_locked);
  for (const auto& [key, value] : entity.metadata) {
    picked.add(key, value);
  }
  return picked;
}

void addLook(Picked& picked, const Instance& copy, const glm::dvec3& centre_in_frame) {
  const auto rgb = static_cast<std::uint32_t>(copy.rgb);
  picked.add("color", colorText(static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
                                static_cast<std::uint8_t>(rgb)));
  picked.add("alpha", copy.alpha);
  picked.add("centre_x", centre_in_frame.x);
  picked.add("centre_y", centre_in_frame.y);
  picked.add("centre_z", centre_in_frame.z);
}

}  // namespace

std::optional<std::pair<ShapeBatchKey, const InstancedMesh*>> FrameParts::batchAt(
    const scenegraph::PickHit& hit) const {
  for (const auto& [key, batch] : batches_) {
    if (hit.isBeneath(batch.mesh->node()) && hit.instance < batch.mesh->size()) {
      return std::pair(key, static_cast<const InstancedMesh*>(batch.mesh.get()));
    }
  }
  return std::nullopt;
}

std::optional<Picked> MarkerPicture::describe(const scenegraph::PickHit& hit) const {
  const auto parts = parts_.find(hit.frame);
  if (shown_ == nullptr || parts == parts_.end() || !hit.isBeneath(parts->second->node())) {
    return std::nullopt;
  }
  const auto batch = parts->second->batchAt(hit);
  if (!batch) {
    const auto rest = parts->second->rest().entityAt(hit);
    const LiveEntity* const entity = rest ? shown_->at(rest->slot) : nullptr;
    return entity == nullptr ? std::nullopt
                             : std::optional(describeEntity(*entity, rest->point_in_frame, rest->primitive));
  }
  const auto& [key, mesh] = *batch;
  const auto holds = [&](const ShapeRun& run) {
    return run.key == key && run.first <= hit.instance && hit.instance - run.first < run.instances.size();
  };
  for (std::size_t slot = 0; slot < shown_->slotCount(); ++slot) {
    const LiveEntity* const entity = shown_->at(slot);
    if (entity != nullptr && entity->frame_id == hit.frame && std::ranges::any_of(entity->shapes.runs, holds)) {
      Picked picked = describeEntity(*entity, mesh->surfacePoint(hit), kindName(key.kind));
      const Instance& copy = mesh->at(hit.instance);
      const auto& m = copy.local_from_mesh;
      addLook(
          picked, copy,
          key.origin() + glm::dvec3(static_cast<double>(m[3]), static_cast<double>(m[7]), static_cast<double>(m[11])));
      return picked;
    }
  }
  return std::nullopt;
}

}  // namespace stillframe::nodes
