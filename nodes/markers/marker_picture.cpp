#include "nodes/markers/marker_picture.h"

#include <algorithm>
#include <utility>

namespace stillframe::nodes {

MarkerPicture::MarkerPicture(scenegraph::FrameGraph& frames, std::string name)
    : frame_graph_(frames), name_(std::move(name)) {}

MarkerPicture::~MarkerPicture() { clear(); }

void MarkerPicture::clear() {
  for (const auto& [frame, parts] : parts_) {
    frame_graph_.unhang(frame, parts->node());
  }
  parts_.clear();
  shown_ = nullptr;
  namespaces_revision_ += namespaces_.empty() ? 0 : 1;
  namespaces_.clear();
  free_.clear();
  entities_ = primitives_ = hidden_ = 0;
}

FrameParts& MarkerPicture::partsOf(const std::string& frame) {
  auto& parts = parts_[frame];
  if (parts == nullptr) {
    parts = std::make_unique<FrameParts>(name_, texts_);
    parts->setLook(settings_.opacity, settings_.texts);
    parts->setBufferTexels(buffer_texels_);
    frame_graph_.hang(frame, parts->node());
  }
  return *parts;
}

bool MarkerPicture::isShown(const LiveEntity& entity) const {
  return settings_.hidden_namespaces.empty() || !settings_.hidden_namespaces.contains(entity.marker_namespace);
}

void MarkerPicture::count(const LiveEntity* entity, bool is_there) {
  if (entity == nullptr) {
    return;
  }
  const auto change = [is_there](std::uint64_t& sum, std::uint64_t by) { is_there ? sum += by : sum -= by; };
  std::uint64_t& in_namespace = namespaces_[entity->marker_namespace];
  namespaces_revision_ += in_namespace == 0 ? 1 : 0;
  change(in_namespace, 1);
  if (in_namespace == 0) {
    namespaces_.erase(entity->marker_namespace);
    ++namespaces_revision_;
  }
  if (isShown(*entity)) {
    change(entities_, 1);
    change(primitives_, entity->primitives);
    if (!entity->is_frame_locked) {
      auto& by_time = free_[entity->frame_id];
      std::uint64_t& at_time = by_time[entity->log_time.ns];
      change(at_time, 1);
      if (at_time == 0) {
        by_time.erase(entity->log_time.ns);
      }
    }
  } else {
    change(hidden_, 1);
  }
}

std::set<std::pair<std::string, ShapeBatchKey>> MarkerPicture::openBatches(const SceneState& state) {
  std::map<std::string_view, std::set<ShapeBatchKey>> wanted;
  for (const ShapeBatch& batch : state.batches) {
    wanted[batch.frame_id].insert(batch.key);
  }
  for (const auto& [frame, parts] : parts_) {
    const auto found = wanted.find(frame);
    parts->close([&](const ShapeBatchKey& key) { return found != wanted.end() && found->second.contains(key); });
  }
  std::set<std::pair<std::string, ShapeBatchKey>> made;
  for (const ShapeBatch& batch : state.batches) {
    if (partsOf(batch.frame_id).open(batch.key, batch.size)) {
      made.emplace(batch.frame_id, batch.key);
    }
  }
  return made;
}

void MarkerPicture::writeShapes(const LiveEntity& entity) const {
  const auto parts = parts_.find(entity.frame_id);
  for (const ShapeRun& run : entity.shapes.runs) {
    parts->second->batch(run.key)->set(run.first, run.instances);
  }
}

void MarkerPicture::show(std::shared_ptr<const SceneState> state, const MarkersSettings& settings,
                         std::uint64_t buffer_texels) {
  if (state == shown_ && settings == settings_ && buffer_texels == buffer_texels_) {
    return;
  }
  buffer_texels_ = buffer_texels;
  if (settings.hidden_namespaces != settings_.hidden_namespaces) {
    clear();
  }
  settings_ = settings;
  for (const auto& [frame, parts] : parts_) {
    parts->setLook(settings.opacity, settings.texts);
    parts->setBufferTexels(buffer_texels);
  }
  std::vector<Change> changes;
  forEachChange(shown_ != nullptr ? *shown_ : SceneState{}, *state,
                [&](std::size_t slot, const LiveEntity* before, const LiveEntity* after) {
                  changes.push_back({slot, before, after});
                });
  const auto made = openBatches(*state);
  // First all that goes, then all that comes: a place may pass from one entity to another.
  for (const Change& change : changes) {
    count(change.before, false);
    count(change.after, true);
    if (change.before == nullptr || !isShown(*change.before)) {
      continue;
    }
    const auto parts = parts_.find(change.before->frame_id);
    if (parts == parts_.end()) {
      continue;
    }
    for (const ShapeRun& run : change.before->shapes.runs) {
      if (InstancedMesh* const mesh = parts->second->batch(run.key)) {
        mesh->hide(run.first, run.instances.size());
      }
    }
    if (change.before->rest != nullptr) {
      parts->second->rest().set(change.slot, nullptr);
    }
  }
  for (const Change& change : changes) {
    if (change.after != nullptr && isShown(*change.after)) {
      writeShapes(*change.after);
      if (change.after->rest != nullptr) {
        partsOf(change.after->frame_id).rest().set(change.slot, change.after->rest);
      }
    }
  }
  const bool has_remade = shown_ != nullptr && !made.empty();
  for (std::size_t slot = 0; has_remade && slot < state->slotCount(); ++slot) {
    const LiveEntity* const entity = state->at(slot);
    if (entity != nullptr && isShown(*entity) && std::ranges::any_of(entity->shapes.runs, [&](const ShapeRun& run) {
          return made.contains({entity->frame_id, run.key});
        })) {
      writeShapes(*entity);
    }
  }
  for (const auto& [frame, parts] : parts_) {
    parts->commit();
  }
  shown_ = std::move(state);
  dropEmptyFrames();
}

void MarkerPicture::dropEmptyFrames() {
  std::erase_if(parts_, [&](const auto& entry) {
    const auto& [frame, parts] = entry;
    if (!parts->isEmpty()) {
      return false;
    }
    frame_graph_.unhang(frame, parts->node());
    return true;
  });
}

void MarkerPicture::collectNodes(std::vector<osg::Node*>& nodes) const {
  for (const auto& [frame, parts] : parts_) {
    nodes.push_back(&parts->node());
  }
}

MarkerPicture::Counts MarkerPicture::counts() const {
  Counts counts{.entities = entities_, .primitives = primitives_, .hidden = hidden_};
  for (const auto& [frame, parts] : parts_) {
    counts.draw_calls += parts->drawCalls();
    counts.left_out += parts->rest().leftOut();
    counts.failed_models += parts->rest().models().failed();
    counts.texels_too_many = std::max(counts.texels_too_many, parts->texelsTooMany());
  }
  return counts;
}

WantedModels MarkerPicture::wantedModels() const {
  WantedModels wanted;
  for (const auto& [frame, parts] : parts_) {
    parts->rest().collectModels(wanted);
  }
  return wanted;
}

void MarkerPicture::setModels(const std::shared_ptr<const ModelSet>& models) {
  for (const auto& [frame, parts] : parts_) {
    parts->rest().setModels(models);
    parts->commit();
  }
}

std::optional<scenegraph::Status> MarkerPicture::modelFailure() const {
  for (const auto& [frame, parts] : parts_) {
    if (const auto& failure = parts->rest().models().failure()) {
      return failure;
    }
  }
  return std::nullopt;
}

std::set<std::string> MarkerPicture::namespaces() const {
  std::set<std::string> names;
  for (const auto& [name, entities] : namespaces_) {
    names.insert(name);
  }
  return names;
}

std::vector<std::string> MarkerPicture::frames() const {
  std::vector<std::string> names;
  for (const auto& [frame, parts] : parts_) {
    names.push_back(frame);
  }
  return names;
}

std::optional<tf::TimePoint> MarkerPicture::oldestFree(const std::string& frame) const {
  const auto found = free_.find(frame);
  return found == free_.end() || found->second.empty() ? std::nullopt
                                                       : std::optional(tf::TimePoint{found->second.begin()->first});
}

osg::BoundingBoxd MarkerPicture::boxIn(const std::string& frame) const {
  const auto found = parts_.find(frame);
  return found == parts_.end() ? osg::BoundingBoxd() : found->second->box();
}

}  // namespace stillframe::nodes
