#include "tools/cli/scene_session.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <iterator>

#include "nodes/registry.h"
#include "scenegraph/camera/orbit_camera.h"
#include "scenegraph/near_names.h"

namespace stillframe::cli {

using scenegraph::LayerSlot;

Result<std::unique_ptr<SceneSession>> SceneSession::make(const ViewOptions& options) {
  std::unique_ptr<SceneSession> session(new SceneSession(options));
  auto recording = openRecording(options.recording);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  session->recording_ = std::move(*recording);
  session->executor_ = scenegraph::makeSynchronousExecutor();
  session->scene_ =
      std::make_unique<scenegraph::Scene>(session->recording_->dataset(), nodes::layerTypes(), *session->executor_);
  for (const auto step : {&SceneSession::chooseTime, &SceneSession::addLayers, &SceneSession::chooseFrame}) {
    if (const auto done = ((*session).*step)(); !done) {
      return std::unexpected(done.error());
    }
  }
  return session;
}

Result<void> SceneSession::chooseTime() {
  const std::string& file = options_.recording.file;
  const auto range = recording_->dataset()->timeRange();
  if (!range) {
    return failure(file + ": the recording holds no messages");
  }
  const auto time = resolveTime(options_.time, *range);
  if (!time) {
    return std::unexpected(time.error());
  }
  if (*time < range->first || *time > range->second) {
    return usageError(file + ": time " + std::to_string(time->ns) + " is outside the recording, which spans " +
                      std::to_string(range->first.ns) + " to " + std::to_string(range->second.ns));
  }
  time_ = *time;
  return {};
}

Result<void> SceneSession::addLayers() {
  if (!options_.only_named_layers) {
    scene_->addDefaultLayers();
  }
  for (const LayerArgument& named : options_.layers) {
    const auto slot = scene_->addLayer(named.topic);
    if (!slot) {
      return usageError(options_.recording.file + ": " + slot.error().message);
    }
  }
  return {};
}

Result<void> SceneSession::chooseFrame() {
  scene_->setFixedFrame(options_.fixed_frame);
  updateFully();
  // Settings come after the first update: which choices a colour field has is known once there is data.
  for (const LayerArgument& named : options_.layers) {
    if (const auto applied = applyLayerSettings(*scene_->findLayer(named.topic), named.settings); !applied) {
      return usageError(options_.recording.file + ": layer '" + named.topic + "': " + applied.error().message);
    }
  }
  // A frame may be known by the data in it alone, without any transform.
  std::vector<std::string> known = recording_->dataset()->transforms()->frames();
  std::vector<std::string> of_data;
  for (const auto& slot : scene_->layers()) {
    const bool is_of_topic = slot->type->consumes != scenegraph::ObjectType::None;  // the grid lies in any fixed frame
    if (const std::string frame = slot->layer->sourceFrame(); is_of_topic && !frame.empty()) {
      of_data.emplace_back(tf::stripLeadingSlashes(frame));
    }
  }
  if (options_.fixed_frame) {
    const std::string frame(tf::stripLeadingSlashes(*options_.fixed_frame));
    if (std::ranges::find(known, frame) == known.end() && std::ranges::find(of_data, frame) == of_data.end()) {
      const std::vector<std::string> of_transforms = known;
      std::ranges::copy_if(of_data, std::back_inserter(known), [&](const auto& name) {
        return std::ranges::find(of_transforms, name) == of_transforms.end();
      });
      return usageError(options_.recording.file + ": " + scenegraph::noSuch("frame", frame, known));
    }
  }
  updateFully();
  return {};
}

void SceneSession::showTime(tf::TimePoint time) {
  time_ = time;
  updateFully();
}

void SceneSession::updateFully() {
  // Each round may start work that the next one shows; a layer that never settles must not hang the program.
  constexpr int kMostRounds = 8;
  for (int round = 0; round < kMostRounds; ++round) {
    scene_->update(time_);
    executor_->drain();
    if (!scene_->isPending() && round > 0) {
      break;
    }
  }
  scene_->update(time_);
}

scenegraph::CameraView SceneSession::camera() const {
  const double aspect = static_cast<double>(options_.size.width_px) / options_.size.height_px;
  const double fov_rad = glm::radians(options_.vertical_fov_deg);
  const osg::BoundingBoxd box = scene_->boundsInFixed();
  scenegraph::OrbitCamera orbit;
  scenegraph::OrbitCamera::State state = orbit.state();
  state.vertical_fov_rad = fov_rad;
  orbit.setState(state);
  if (box.valid()) {
    orbit.frame(box, aspect);
  }
  state = orbit.state();
  if (options_.look_at && !options_.eye) {
    state.focal_point = *options_.look_at;
    orbit.setState(state);
  }
  if (!options_.eye) {
    return orbit.view();
  }
  // Not through the orbit, which keeps its own bounds of radius and pitch: the eye is exactly where it was asked for.
  scenegraph::CameraView view = orbit.view();
  view.eye_from_fixed = scenegraph::lookAt(*options_.eye, options_.look_at.value_or(state.focal_point), {0, 0, 1});
  return view;
}

scenegraph::ExportInfo SceneSession::exportInfo() const {
  scenegraph::ExportInfo info{.time = time_,
                              .fixed_frame = scene_->fixedFrame(),
                              .source = options_.recording.file,
                              .layers = {},
                              .viewport_height_px = options_.size.height_px};
  for (const auto& slot : scene_->layers()) {
    if (slot->layer->isVisible()) {
      info.layers.emplace_back(slot->topic, slot->layer->settings());
    }
  }
  return info;
}

Result<void> applyLayerSettings(LayerSlot& slot, scenegraph::SettingTexts settings) {
  if (const auto visible = settings.find("visible"); visible != settings.end()) {
    const scenegraph::SettingSpec spec{
        .key = "visible", .label = "Visible", .help = {}, .kind = scenegraph::SettingKind::Bool};
    const auto value = scenegraph::parseSetting(spec, visible->second);
    if (!value) {
      return usageError(value.error().message);
    }
    slot.layer->setVisible(std::get<bool>(*value));
    settings.erase(visible);
  }
  if (settings.empty()) {
    return {};
  }
  const auto applied = slot.layer->applySettings(settings);
  return applied ? Result<void>{} : usageError(applied.error().message);
}

}  // namespace stillframe::cli
