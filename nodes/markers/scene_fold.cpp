#include "nodes/markers/scene_fold.h"

#include <algorithm>
#include <limits>

namespace stillframe::nodes {
namespace {

using scenegraph::SceneEntities;
using scenegraph::SceneEntity;
using scenegraph::SceneEntityDeletion;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

template <typename T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// Memory of what is kept of an entity as it came.
std::size_t bytesOfRest(const SceneEntity& entity) {
  std::size_t bytes = sizeof(SceneEntity);
  for (const auto& line : entity.lines) {
    bytes += sizeof(line) + bytesOf(line.points) + bytesOf(line.colors) + bytesOf(line.indices);
  }
  for (const auto& triangles : entity.triangles) {
    bytes += sizeof(triangles) + bytesOf(triangles.points) + bytesOf(triangles.colors) + bytesOf(triangles.indices) +
             bytesOf(triangles.uvs) + triangles.texture.bytes.size();
  }
  for (const auto& text : entity.texts) {
    bytes += sizeof(text) + text.text.size();
  }
  for (const auto& model : entity.models) {
    bytes += sizeof(model) + model.data.bytes.size();
  }
  return bytes;
}

bool hasRest(const SceneEntity& entity) {
  return !entity.lines.empty() || !entity.triangles.empty() || !entity.texts.empty() || !entity.models.empty() ||
         std::ranges::any_of(entity.axes, &scenegraph::AxesPrimitive::is_scale_invariant);
}

}  // namespace

void SceneTotals::add(const LiveEntity& entity, bool is_there) {
  const auto count = [is_there](std::uint64_t& sum, std::uint64_t value) { is_there ? sum += value : sum -= value; };
  count(entities, 1);
  count(primitives, entity.primitives);
  count(unsound, entity.shapes.unsound);
  count(flat, entity.shapes.flat);
  count(invisible, entity.shapes.invisible);
  count(free_in_fixed, entity.is_frame_locked ? 0 : 1);
  count(bytes, entity.byte_size);
}

SceneHistory::Fold::Fold(const SceneState& state, std::size_t at_place, std::uint64_t sequence, std::size_t max_bytes)
    : place(at_place), last_sequence(sequence), max_bytes_(max_bytes), rest_(state) {
  rest_.blocks.clear();
  rest_.batches.clear();
  std::map<BatchId, std::vector<std::pair<std::uint32_t, std::uint32_t>>> taken;
  for (std::size_t slot = 0; slot < state.slotCount(); ++slot) {
    if (slot % SceneState::kBlock == 0) {
      blocks_.push_back(std::make_shared<SceneState::Block>(*state.blocks[slot / SceneState::kBlock]));
      blocks_.back()->epoch = epoch_;
    }
    const LiveEntity* const entity = state.at(slot);
    if (entity == nullptr) {
      free_slots_.push(slot);
      continue;
    }
    slots_.insert(entity->id, slot);
    if (entity->expiry.ns != kNever) {
      expiries_.emplace(entity->expiry.ns, slot);
    }
    for (const ShapeRun& run : entity->shapes.runs) {
      taken[{entity->frame_id, run.key}].emplace_back(run.first, static_cast<std::uint32_t>(run.instances.size()));
    }
  }
  for (auto& [id, runs] : taken) {
    std::ranges::sort(runs);
    for (const auto& [first, count] : runs) {
      batches_[id].restore(first, count);
    }
  }
}

SceneState SceneHistory::Fold::snapshot() {
  SceneState state = rest_;
  state.blocks.assign(blocks_.begin(), blocks_.end());
  for (const auto& [id, places] : batches_) {
    state.batches.push_back({id.first, id.second, places.size()});
  }
  state.next_expiry = {expiries_.empty() ? kNever : expiries_.begin()->first};
  ++epoch_;
  return state;
}

SceneState SceneHistory::Fold::snapshotAt(tf::TimePoint time) {
  SceneState state = snapshot();
  std::set<std::size_t> own;  // blocks copied here
  auto expiry = expiries_.begin();
  std::vector<std::shared_ptr<SceneState::Block>> copies(
      expiry != expiries_.end() && expiry->first <= time.ns ? blocks_.size() : 0);
  for (; expiry != expiries_.end() && expiry->first <= time.ns; ++expiry) {
    const std::size_t block = expiry->second / SceneState::kBlock;
    if (copies[block] == nullptr) {
      copies[block] = std::make_shared<SceneState::Block>(*blocks_[block]);
      state.blocks[block] = copies[block];
    }
    auto& slot = copies[block]->slots[expiry->second % SceneState::kBlock];
    state.totals.add(*slot, false);
    slot = nullptr;
    state.last_expiry = {expiry->first};
  }
  state.next_expiry = {expiry == expiries_.end() ? kNever : expiry->first};
  return state;
}

void SceneHistory::Fold::apply(const SceneMessage& message) {
  endLifetimes(message.log_time);
  ++place;
  last_sequence = message.sequence;
  rest_.faults.clear();
  rest_.failure.reset();
  if (!message.scene || *message.scene == nullptr) {
    ++rest_.undecodable;
    rest_.failure = message.scene ? scenegraph::DecodeError{"WrongObject",
                                                            "the decoder made another object than the topic announces"}
                                  : message.scene.error();
    return;
  }
  const SceneEntities& scene = **message.scene;
  slots_.reserve(scene.entities.size());
  rest_.faults = scene.faults;
  for (const SceneEntities::Step& step : scene.steps) {
    if (step.is_deletion) {
      remove(scene.deletions[step.index]);
    } else {
      add(scene.entities[step.index], *message.scene, message.log_time);
    }
  }
  closeGaps();
}

void SceneHistory::Fold::put(std::size_t slot, std::shared_ptr<const LiveEntity> entity) {
  auto& block = blocks_[slot / SceneState::kBlock];
  if (block->epoch != epoch_) {
    block = std::make_shared<SceneState::Block>(*block);
    block->epoch = epoch_;
  }
  auto& held = block->slots[slot % SceneState::kBlock];
  if (held != nullptr) {
    rest_.totals.add(*held, false);
  }
  if (entity != nullptr) {
    rest_.totals.add(*entity, true);
    new_bytes += entity->byte_size;
  }
  held = std::move(entity);
}

void SceneHistory::Fold::add(const SceneEntity& entity, const std::shared_ptr<const SceneEntities>& owner,
                             tf::TimePoint log_time) {
  auto made = std::make_shared<LiveEntity>();
  made->id = entity.id;
  made->frame_id = entity.frame_id;
  made->marker_namespace = entity.marker_namespace;
  made->stamp = entity.stamp;
  made->log_time = log_time;
  made->is_frame_locked = entity.is_frame_locked;
  made->metadata = entity.metadata;
  if (entity.lifetime_ns > 0 && log_time.ns < kNever - entity.lifetime_ns) {
    made->expiry = {log_time.ns + entity.lifetime_ns};
  }
  made->shapes = shapesOf(entity, batches_.size() < kMostCells);
  made->byte_size = sizeof(LiveEntity) + made->shapes.sources.byteSize() + made->shapes.runs.byteSize() +
                    3 * entity.id.size() + entity.frame_id.size() + 64;
  for (const auto& [key, value] : entity.metadata) {
    made->byte_size += 64 + key.size() + value.size();
  }
  std::size_t points = 0;
  for (const auto& list : entity.points) {
    points += list.points.size();
  }
  for (const ShapeRun& run : made->shapes.runs) {
    made->byte_size += run.instances.byteSize();
  }
  made->primitives =
      static_cast<std::uint32_t>(entity.arrows.size() + entity.cubes.size() + entity.spheres.size() +
                                 entity.cylinders.size() + entity.lines.size() + entity.triangles.size() + points +
                                 entity.texts.size() + entity.models.size() + entity.axes.size());
  if (hasRest(entity)) {
    if (owner->entities.size() == 1) {
      made->rest = std::shared_ptr<const SceneEntity>(owner, &entity);
    } else {  // one of many must not keep the others
      auto rest = std::make_shared<SceneEntity>();
      rest->id = entity.id;
      rest->marker_namespace = entity.marker_namespace;
      rest->lines = entity.lines;
      rest->triangles = entity.triangles;
      rest->texts = entity.texts;
      rest->models = entity.models;
      rest->axes = entity.axes;
      made->rest = std::move(rest);
    }
    made->byte_size += bytesOfRest(entity);
  }
  const auto known = slotOf(entity.id);
  const LiveEntity* const replaced = known ? entityAt(*known) : nullptr;
  const std::size_t freed = replaced != nullptr ? replaced->byte_size : 0;
  if (rest_.totals.bytes - freed + made->byte_size > max_bytes_ || !placeRuns(*made, replaced)) {
    ++rest_.refused;
    if (replaced != nullptr) {
      erase(*known);  // what it was is no more, all the same
    }
    return;
  }
  std::size_t slot = 0;
  if (replaced != nullptr) {
    slot = *known;
    expiries_.erase({replaced->expiry.ns, slot});
  } else {
    if (free_slots_.empty()) {
      for (std::size_t i = 0; i < SceneState::kBlock; ++i) {
        free_slots_.push(blocks_.size() * SceneState::kBlock + i);
      }
      blocks_.push_back(std::make_shared<SceneState::Block>());
      blocks_.back()->epoch = epoch_;
    }
    slot = free_slots_.top();
    free_slots_.pop();
    slots_.insert(entity.id, slot);
  }
  if (made->expiry.ns != kNever) {
    expiries_.emplace(made->expiry.ns, slot);
  }
  put(slot, std::move(made));
}

bool SceneHistory::Fold::placeRuns(LiveEntity& entity, const LiveEntity* replaced) {
  const auto same = [&](const ShapeRun& run) -> const ShapeRun* {
    if (replaced == nullptr || replaced->frame_id != entity.frame_id) {
      return nullptr;
    }
    const auto found = std::ranges::find_if(replaced->shapes.runs, [&](const ShapeRun& old) {
      return old.key == run.key && old.instances.size() == run.instances.size();
    });
    return found == replaced->shapes.runs.end() ? nullptr : &*found;
  };
  std::size_t opened = 0;
  for (const ShapeRun& run : entity.shapes.runs) {
    opened += batches_.contains({entity.frame_id, run.key}) ? 0 : 1;
  }
  if (opened > 0 && batches_.size() + opened > kMostBatches) {
    return false;
  }
  std::vector<const ShapeRun*> kept;
  for (ShapeRun& run : entity.shapes.runs) {
    if (const ShapeRun* const old = same(run)) {
      run.first = old->first;
      kept.push_back(old);
    }
  }
  if (replaced != nullptr && kept.size() < replaced->shapes.runs.size()) {
    LiveEntity gone;
    gone.frame_id = replaced->frame_id;
    for (const ShapeRun& old : replaced->shapes.runs) {
      if (std::ranges::find(kept, &old) == kept.end()) {
        gone.shapes.runs.push_back(old);
      }
    }
    freeRuns(gone);
  }
  for (ShapeRun& run : entity.shapes.runs) {
    if (same(run) == nullptr) {
      run.first = batches_[{entity.frame_id, run.key}].take(static_cast<std::uint32_t>(run.instances.size()));
    }
  }
  return true;
}

void SceneHistory::Fold::freeRuns(const LiveEntity& entity) {
  for (const ShapeRun& run : entity.shapes.runs) {
    const auto batch = batches_.find({entity.frame_id, run.key});
    batch->second.free(run.first, static_cast<std::uint32_t>(run.instances.size()));
    if (batch->second.taken() == 0) {
      batches_.erase(batch);
    }
  }
}

std::optional<std::size_t> SceneHistory::Fold::slotOf(std::string_view id) const {
  return slots_.find(id, [this](std::size_t slot) -> std::string_view { return entityAt(slot)->id; });
}

void SceneHistory::Fold::erase(std::size_t slot) {
  const LiveEntity& entity = *entityAt(slot);
  freeRuns(entity);
  expiries_.erase({entity.expiry.ns, slot});
  slots_.erase(entity.id, slot);
  free_slots_.push(slot);
  put(slot, nullptr);
  if (slots_.empty()) {
    blocks_.clear();
    free_slots_ = {};
  }
}

void SceneHistory::Fold::remove(const SceneEntityDeletion& deletion) {
  if (deletion.type == SceneEntityDeletion::Type::MatchingId) {
    const auto slot = slotOf(deletion.id);
    if (slot && entityAt(*slot)->stamp <= deletion.stamp) {
      erase(*slot);
    }
    return;
  }
  for (std::size_t slot = 0; slot < blocks_.size() * SceneState::kBlock; ++slot) {
    const LiveEntity* const entity = entityAt(slot);
    if (entity != nullptr && entity->stamp <= deletion.stamp &&
        (deletion.marker_namespace.empty() || entity->marker_namespace == deletion.marker_namespace)) {
      erase(slot);
    }
  }
}

void SceneHistory::Fold::endLifetimes(tf::TimePoint time) {
  while (!expiries_.empty() && expiries_.begin()->first <= time.ns) {
    erase(expiries_.begin()->second);
  }
}

void SceneHistory::Fold::closeGaps() {
  for (auto& [id, places] : batches_) {
    if (!places.isSparse()) {
      continue;
    }
    places = {};
    for (std::size_t slot = 0; slot < blocks_.size() * SceneState::kBlock; ++slot) {
      const auto& held = blocks_[slot / SceneState::kBlock]->slots[slot % SceneState::kBlock];
      if (held == nullptr || held->frame_id != id.first ||
          std::ranges::find(held->shapes.runs, id.second, &ShapeRun::key) == held->shapes.runs.end()) {
        continue;
      }
      auto moved = std::make_shared<LiveEntity>(*held);
      const auto run = std::ranges::find(moved->shapes.runs, id.second, &ShapeRun::key);
      run->first = places.take(static_cast<std::uint32_t>(run->instances.size()));
      put(slot, std::move(moved));
    }
  }
}

}  // namespace stillframe::nodes
