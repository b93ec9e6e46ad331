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

/// A primitive's own pose and size, with all the digits of the message; of points the pose is that of the list.
void addSource(Picked& picked, const PrimitiveSource& source) {
  picked.addPose("pose", source.pose);
  const auto names = sizeNames(source.kind);
  for (std::size_t i = 0; i < names.size(); ++i) {
    picked.add(names[i], source.sizes.at(i));
  }
}

/// The same of what is drawn from the message itself, where the entity has one of it: an entity of several does not
/// tell which.
void addRest(Picked& picked, const scenegraph::SceneEntity& entity, const std::string& primitive) {
  if (primitive == "line" && entity.lines.size() == 1) {
    const auto& line = entity.lines.front();
    picked.addPose("pose", line.pose);
    picked.add(line.is_scale_invariant ? "thickness_px" : "thickness", line.thickness);
    picked.add("points", line.points.size());
  } else if (primitive == "triangles" && entity.triangles.size() == 1) {
    picked.addPose("pose", entity.triangles.front().pose);
    picked.add("points", entity.triangles.front().points.size());
  } else if (primitive == "model" && entity.models.size() == 1) {
    const auto& model = entity.models.front();
    picked.addPose("pose", model.pose);
    picked.add("scale_x", model.scale.x);
    picked.add("scale_y", model.scale.y);
    picked.add("scale_z", model.scale.z);
    picked.add("url", model.url);
  } else if (primitive == "text" && entity.texts.size() == 1) {
    const auto& text = entity.texts.front();
    picked.addPose("pose", text.pose);
    picked.add(text.is_scale_invariant ? "font_size_px" : "font_size", text.font_size);
    picked.add("text", text.text);
  }
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
    if (entity == nullptr) {
      return std::nullopt;
    }
    Picked picked = describeEntity(*entity, rest->point_in_frame, rest->primitive);
    if (entity->rest != nullptr) {
      addRest(picked, *entity->rest, rest->primitive);
    }
    return picked;
  }
  const auto& [key, mesh] = *batch;
  const auto holds = [&](const ShapeRun& run) {
    return run.key == key && run.first <= hit.instance && hit.instance - run.first < run.instances.size();
  };
  for (std::size_t slot = 0; slot < shown_->slotCount(); ++slot) {
    const LiveEntity* const entity = shown_->at(slot);
    if (entity == nullptr || entity->frame_id != hit.frame) {
      continue;
    }
    if (const auto run = std::ranges::find_if(entity->shapes.runs, holds); run != entity->shapes.runs.end()) {
      const Instance& copy = run->instances[hit.instance - run->first];
      const PrimitiveSource& source = entity->shapes.sources.at(static_cast<std::size_t>(copy.id));
      Picked picked = describeEntity(*entity, mesh->surfacePoint(hit), toString(source.kind));
      addSource(picked, source);
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
