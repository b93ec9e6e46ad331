#include "scenegraph/scene.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "scenegraph/near_names.h"

namespace stillframe::scenegraph {
namespace {

/// The root of `frame`, found with the roots of those on the way remembered in `root_of`.
tf::FrameId rootOf(tf::FrameId frame, const tf::TransformBuffer& buffer, std::vector<tf::FrameId>& root_of) {
  std::vector<tf::FrameId> way;
  tf::FrameId root = frame;
  while (root < root_of.size() && root_of[root] == tf::kNoFrame) {
    way.push_back(root);
    const tf::FrameId parent = buffer.parent(root);
    if (parent == tf::kNoFrame) {
      break;
    }
    root = parent;
  }
  root = root < root_of.size() && root_of[root] != tf::kNoFrame ? root_of[root] : root;
  for (const tf::FrameId on_way : way) {
    root_of[on_way] = root;
  }
  return root;
}

/// "TOPIC" of "TOPIC#2", "" when the id is none of a duplicate.
std::string_view topicOfDuplicate(std::string_view id) {
  const std::size_t mark = id.rfind('#');
  const std::string_view number = mark == std::string_view::npos ? "" : id.substr(mark + 1);
  const bool is_number = !number.empty() && number.size() < 10 && number.front() != '0' && number != "1" &&
                         number.find_first_not_of("0123456789") == std::string_view::npos;
  return is_number ? id.substr(0, mark) : std::string_view();
}

}  // namespace

std::string automaticFixedFrame(const tf::TransformBuffer& buffer) {
  constexpr std::array<std::string_view, 6> kUsual = {"map", "world", "earth", "odom", "base_link", "base_footprint"};
  for (const std::string_view name : kUsual) {
    if (buffer.findFrame(name)) {
      return std::string(name);
    }
  }
  const std::size_t count = buffer.frameCount();
  if (count == 0) {
    return {};
  }
  std::vector<tf::FrameId> root_of(count, tf::kNoFrame);
  std::vector<std::size_t> sizes(count, 0);
  for (tf::FrameId frame = 0; frame < count; ++frame) {
    if (const tf::FrameId root = rootOf(frame, buffer, root_of); root < count) {
      ++sizes[root];
    }
  }
  return buffer.frameName(static_cast<tf::FrameId>(std::ranges::max_element(sizes) - sizes.begin()));
}

Scene::Scene(std::shared_ptr<Dataset> dataset, std::span<const LayerType> types, Executor& executor,
             std::function<void()> request_update)
    : dataset_(std::move(dataset)),
      types_(types),
      frames_(dataset_->transforms()),
      has_new_work_(std::make_shared<std::atomic<bool>>(false)),
      context_{*dataset_, frames_, executor, [has_new_work = has_new_work_, request = std::move(request_update)] {
                 has_new_work->store(true);
                 if (request) {
                   request();
                 }
               }} {}

Scene::~Scene() {
  while (!layers_.empty()) {
    layers_.back()->layer->detach();
    layers_.pop_back();
  }
}

void Scene::setFixedFrame(std::optional<std::string> frame) {
  if (frame) {
    frame = std::string(tf::stripLeadingSlashes(*frame));
  }
  chosen_frame_ = frame && !frame->empty() ? std::move(frame) : std::nullopt;
}

void Scene::setPreferredFrame(std::optional<std::string> frame) {
  preferred_frame_ = std::move(frame);
  automatic_frame_revision_.reset();
}

const std::string& Scene::automaticFrame() const {
  const tf::TransformBuffer& buffer = *dataset_->transforms();
  if (const std::uint64_t revision = buffer.revision(); automatic_frame_revision_ != revision) {
    automatic_frame_ =
        preferred_frame_ && buffer.findFrame(*preferred_frame_) ? *preferred_frame_ : automaticFixedFrame(buffer);
    automatic_frame_revision_ = revision;
  }
  return automatic_frame_;
}

std::string Scene::fixedFrame() const {
  if (chosen_frame_) {
    return *chosen_frame_;
  }
  return automaticFrame().empty() ? firstSourceFrame() : automaticFrame();
}

std::string Scene::firstSourceFrame() const {
  for (const auto& slot : layers_) {
    // A built-in lies in whatever frame is fixed: it must not keep the frame of an earlier time.
    if (slot->type->consumes == ObjectType::None || !slot->layer->isVisible()) {
      continue;
    }
    if (const std::string frame = slot->layer->sourceFrame(); !frame.empty()) {
      return std::string(tf::stripLeadingSlashes(frame));
    }
  }
  return {};
}

const LayerType* Scene::findType(std::string_view topic) const {
  const ObjectStore& store = dataset_->store();
  for (const LayerType& type : types_) {
    if (type.consumes == ObjectType::None ? type.name == topic : store.findTopic(topic, type.consumes).has_value()) {
      return &type;
    }
  }
  const auto id = store.findTopic(topic);
  const auto taker = std::ranges::find_if(types_, [&](const LayerType& type) {
    return id && type.takes != nullptr && type.takes(store, store.topic(*id));
  });
  return taker != types_.end() ? &*taker : nullptr;
}

Status Scene::refusal(std::string_view topic) const {
  const ObjectStore& store = dataset_->store();
  const std::string name(topic);
  if (const auto id = store.findTopic(topic)) {
    const TopicInfo info = store.topic(*id);
    const std::string why =
        info.type == ObjectType::None ? info.unsupported_reason : "no layer draws " + std::string(toString(info.type));
    return {StatusLevel::Error, "UnsupportedTopic", "topic '" + name + "' (" + info.schema + ") is not drawn: " + why};
  }
  std::vector<std::string> known;
  for (const LayerType& type : types_) {
    if (type.consumes == ObjectType::None) {
      known.emplace_back(type.name);
    }
  }
  for (TopicId id = 0; id < store.topicCount(); ++id) {
    known.push_back(store.topic(id).name);
  }
  return {StatusLevel::Error, "UnknownTopic", noSuch("topic", topic, known)};
}

std::expected<LayerSlot*, Status> Scene::addLayer(std::string_view id) {
  if (LayerSlot* const slot = findLayer(id)) {
    return slot;
  }
  std::string_view topic = id;
  const LayerType* type = findType(topic);
  if (const std::string_view original = topicOfDuplicate(id); type == nullptr && !original.empty()) {
    topic = original;
    type = findType(topic);
  }
  if (type == nullptr) {
    return std::unexpected(refusal(topic));
  }
  layers_.push_back(
      std::make_unique<LayerSlot>(LayerSlot{std::string(id), std::string(topic), std::string(id), type,
                                            std::make_unique<WorkMeter>(context_.executor), type->create(topic)}));
  LayerSlot& added = *layers_.back();
  added.layer->attach({context_.dataset, context_.frames, *added.meter, context_.request_update});
  removed_topics_.erase(std::string(id));
  ++layers_revision_;
  return layers_.back().get();
}

std::vector<std::string> Scene::drawableTopics() const {
  std::vector<std::string> topics;
  for (const LayerType& type : types_) {
    if (type.consumes == ObjectType::None) {
      topics.emplace_back(type.name);
    }
  }
  const ObjectStore& store = dataset_->store();
  const std::size_t count = store.topicCount();
  for (TopicId id = 0; id < count; ++id) {
    TopicInfo info = store.topic(id);
    if (std::ranges::any_of(types_, [&](const LayerType& type) {
          return info.type != ObjectType::None &&
                 (type.consumes == info.type || (type.takes != nullptr && type.takes(store, info)));
        })) {
      topics.push_back(std::move(info.name));
    }
  }
  return topics;
}

void Scene::addDefaultLayers() {
  for (const std::string& topic : drawableTopics()) {
    if (!removed_topics_.contains(topic)) {
      (void)addLayer(topic);
    }
  }
}

LayerSlot& Scene::duplicateLayer(const LayerSlot& original) {
  LayerSlot& copy = **addLayer(freeId(original.topic));  // there is a type for it, since there is the original
  copy.layer->setVisible(original.layer->isVisible());
  (void)copy.layer->applySettings(original.layer->settings());  // taken from a layer of the same type
  const auto place = std::ranges::find(layers_, &original, &std::unique_ptr<LayerSlot>::get);
  std::rotate(std::next(place), std::prev(layers_.end()), layers_.end());
  return copy;
}

std::string Scene::freeId(const std::string& topic) const {
  const auto isTaken = [&](const std::string& id) {
    return findType(id) != nullptr ||
           std::ranges::any_of(layers_, [&](const std::unique_ptr<LayerSlot>& slot) { return slot->id == id; });
  };
  std::size_t number = 2;
  std::string id = topic + "#2";
  while (isTaken(id)) {
    id = topic + "#" + std::to_string(++number);
  }
  return id;
}

void Scene::removeLayer(std::string_view id) {
  const auto found =
      std::ranges::find_if(layers_, [&](const std::unique_ptr<LayerSlot>& slot) { return slot->id == id; });
  if (found != layers_.end()) {
    if ((*found)->id == (*found)->topic) {
      removed_topics_.insert((*found)->topic);
    }
    (*found)->layer->detach();
    layers_.erase(found);
    ++layers_revision_;
  }
}

void Scene::arrangeLayers(std::span<const std::string> ids) {
  const auto rank = [&](const std::unique_ptr<LayerSlot>& slot) {
    return std::ranges::find(ids, slot->id) - ids.begin();
  };
  if (!std::ranges::is_sorted(layers_, {}, rank)) {
    std::ranges::stable_sort(layers_, {}, rank);
    ++layers_revision_;
  }
}

LayerSlot* Scene::findLayer(std::string_view id) {
  const auto found =
      std::ranges::find_if(layers_, [&](const std::unique_ptr<LayerSlot>& slot) { return slot->id == id; });
  return found == layers_.end() ? nullptr : found->get();
}

bool Scene::update(tf::TimePoint time) {
  const bool had_pending = isPending();
  const bool had_new_work = has_new_work_->exchange(false);
  // Read before the tick: what arrives during it makes the next update differ.
  Inputs inputs{
      time,           fixedFrame(), dataset_->transforms()->revision(), dataset_->store().revision(), layers_revision_,
      layerSettings()};
  time_ = time;
  if (shown_ == inputs && !had_new_work && !had_pending) {
    return false;
  }
  ++ticks_;
  frames_.setTick(inputs.fixed_frame, time);
  updateLayers(time);
  if (const std::string settled = fixedFrame(); settled != inputs.fixed_frame) {
    // Without transforms the frame is that of the data, which the layers know only now.
    inputs.fixed_frame = settled;
    frames_.setTick(settled, time);
    updateLayers(time);
  }
  const bool has_new_settings = noteSettings();
  inputs.layer_settings = layerSettings();  // data may have brought settings of its own
  if (shown_) {
    shown_->layer_settings = inputs.layer_settings;  // the texts say whether they differ
  }
  const bool is_same = shown_ == inputs && !has_new_settings && !had_new_work && !had_pending;
  settings_revision_ += has_new_settings || !shown_ || shown_->layers_revision != layers_revision_ ? 1 : 0;
  shown_ = std::move(inputs);
  return !is_same;
}

bool Scene::setBufferTexels(std::uint64_t texels) {
  const bool is_new = texels != buffer_texels_;
  buffer_texels_ = texels;
  layers_revision_ += is_new ? 1 : 0;
  return is_new;
}

void Scene::updateLayers(tf::TimePoint time) {
  struct Count {
    std::uint32_t all = 0;
    std::uint32_t before = 0;  // of those updated so far
  };
  std::map<const LayerType*, Count> counts;
  for (const auto& slot : layers_) {
    ++counts[slot->type].all;
  }
  for (const auto& slot : layers_) {
    Count& count = counts[slot->type];
    slot->layer->update(Tick{time, count.before++, count.all, buffer_texels_});
  }
  arrangeNodes();
}

void Scene::arrangeNodes() {
  const std::pair revisions(frames_.hangRevision(), layers_revision_);
  if (arranged_ == revisions) {
    return;
  }
  arranged_ = revisions;
  // Of what has the same depth the first that is drawn is seen.
  std::vector<osg::Node*> nodes;
  for (const auto& slot : layers_) {
    slot->layer->collectNodes(nodes);
  }
  frames_.arrange(nodes);
}

bool Scene::noteSettings() {
  bool has_changed = shown_settings_.size() != layers_.size();
  shown_settings_.resize(layers_.size());
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = *layers_[i]->layer;
    ShownSettings& shown = shown_settings_[i];
    if (shown.layer == &layer && shown.revision == layer.settingsRevision()) {
      continue;
    }
    ShownSettings now{&layer, layer.settingsRevision(), layer.isVisible(), layer.settings()};
    has_changed = has_changed || now.is_visible != shown.is_visible || now.texts != shown.texts;
    shown = std::move(now);
  }
  return has_changed;
}

std::uint64_t Scene::layerSettings() const {
  std::uint64_t sum = 0;
  for (const auto& slot : layers_) {
    sum += slot->layer->settingsRevision();
  }
  return sum;
}

bool Scene::isPending() const {
  return std::ranges::any_of(layers_, [](const std::unique_ptr<LayerSlot>& slot) { return slot->layer->isPending(); });
}

void Scene::setView(const CameraView& view, const PictureSize& size) {
  if (osg::StateSet* const state = root().getStateSet(); size.pixel_ratio != 1.0 || state != nullptr) {
    root()
        .getOrCreateStateSet()
        ->getOrCreateUniform("u_pixel_ratio", osg::Uniform::FLOAT)
        ->set(static_cast<float>(size.pixel_ratio));
  }
  for (const auto& slot : layers_) {
    if (slot->layer->isVisible()) {
      slot->layer->setView(view, size);
    }
  }
}

osg::BoundingBoxd Scene::boundsInFixed() const {
  osg::BoundingBoxd all;
  for (const auto& slot : layers_) {
    if (slot->layer->isVisible()) {
      all.expandBy(slot->layer->boundsInFixed());
    }
  }
  return all;
}

Box Scene::bulkInFixed() const {
  std::vector<Box> boxes;
  for (const auto& slot : layers_) {
    if (slot->layer->isVisible()) {
      std::ranges::copy(slot->layer->bulkInFixed(), std::back_inserter(boxes));
    }
  }
  return bulkOf(boxes);
}

}  // namespace stillframe::scenegraph
