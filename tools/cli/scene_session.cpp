#include "tools/cli/scene_session.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>

#include "nodes/registry.h"
#include "scenegraph/layer_list.h"
#include "scenegraph/near_names.h"
#include "scenegraph/osg_box.h"
#include "scenegraph/passes/view_effects.h"
#include "scenegraph/pick/place_picks.h"

namespace stillframe::cli {

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
  session->takeLayout();
  for (const auto step :
       {&SceneSession::chooseTime, &SceneSession::addLayers, &SceneSession::chooseFrame, &SceneSession::placeCamera}) {
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
    return usageError(file + ": time " + outsideText(options_.time, *range));
  }
  time_ = *time;
  return {};
}

/// Options go before the layout; a frame of another recording is no frame of this one.
void SceneSession::takeLayout() {
  if (!options_.layout) {
    return;
  }
  const scenegraph::ViewLayout& layout = *options_.layout;
  const auto known = [this](const std::optional<std::string>& frame, const char* what) -> std::optional<std::string> {
    if (!frame || recording_->dataset()->transforms()->findFrame(*frame)) {
      return frame;
    }
    layout_notes_.push_back(std::string(what) + " " +
                            scenegraph::noSuch("frame", *frame, recording_->dataset()->transforms()->frames()));
    return std::nullopt;
  };
  scenegraph::ViewEffects effects;
  for (const scenegraph::SettingError& error : effects.fromTexts(layout.effects)) {
    layout_notes_.push_back("effects: " + error.message);
  }
  if (!options_.fixed_frame) {
    options_.fixed_frame = known(layout.fixed_frame, "fixed frame:");
  }
  if (!options_.is_camera_named) {
    options_.camera = layout.viewpoint.camera.kind;
    options_.follow_frame = known(layout.viewpoint.display_frame, "display frame:");
    options_.follow = options_.follow_frame ? layout.viewpoint.follow.mode : scenegraph::FollowMode::Off;
  }
}

Result<void> SceneSession::addLayers() {
  if (!options_.only_named_layers) {
    scene_->addDefaultLayers();
  }
  for (const LayerArgument& named : options_.layers) {
    const auto slot = scene_->addLayer(named.id);
    if (!slot) {
      return usageError(options_.recording.file + ": " + layerRefusal(named.id, slot.error()));
    }
  }
  return {};
}

/// Why a layer cannot be had. What follows a topic that there is was meant as its settings.
std::string SceneSession::layerRefusal(const std::string& id, const scenegraph::Status& status) const {
  const auto names = scene_->drawableTopics();
  for (std::size_t colon = id.find(':'); colon != std::string::npos; colon = id.find(':', colon + 1)) {
    if (std::ranges::find(names, id.substr(0, colon)) != names.end()) {
      return "layer '" + id.substr(0, colon) + "': '" + id.substr(colon + 1) +
             "' is no list of settings, key=value,...";
    }
  }
  return status.message;
}

/// After the first update: which choices a colour field has is known once there is data.
Result<void> SceneSession::applyLayers() {
  if (options_.layout) {
    scenegraph::LayerList saved = options_.layout->layers;
    std::erase_if(saved.layers, [this](const scenegraph::LayerState& layer) {
      return options_.only_named_layers && scene_->findLayer(layer.id) == nullptr;
    });
    const scenegraph::AppliedLayers applied = scenegraph::applyLayerList(saved, *scene_);
    for (const auto* const statuses : {&applied.absent, &applied.refused}) {
      std::ranges::transform(*statuses, std::back_inserter(layout_notes_), &scenegraph::Status::message);
    }
  }
  for (const LayerArgument& named : options_.layers) {
    const auto applied = scenegraph::applyLayerSettings(named.settings, *scene_->findLayer(named.id));
    if (!applied) {
      return usageError(options_.recording.file + ": layer '" + named.id + "': " + applied.error().message);
    }
  }
  return {};
}

Result<void> SceneSession::chooseFrame() {
  scene_->setFixedFrame(options_.fixed_frame);
  updateFully();
  if (const auto applied = applyLayers(); !applied) {
    return applied;
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
  notePicks();
  return {};
}

/// What the layout keeps as picked, and this recording has no place for.
void SceneSession::notePicks() {
  for (const std::string& frame :
       options_.layout ? scenegraph::framesOf(options_.layout->picks) : std::vector<std::string>()) {
    if (!scene_->frames().fixedFromFrame(frame)) {
      layout_notes_.push_back("what is picked in frame '" + frame + "' has no place in '" + scene_->fixedFrame() + "'");
    }
  }
}

void SceneSession::showTime(tf::TimePoint time) {
  time_ = time;
  updateFully();
  follow_.track(followedPose(), rig_);
}

void SceneSession::setContext(const scenegraph::GlContextInfo& info) {
  if (scene_->setBufferTexels(info.max_buffer_texels)) {
    updateFully();
  }
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

scenegraph::Follow::Pose SceneSession::followedPose() const {
  const auto pose = options_.follow_frame ? scene_->frames().fixedFromFrame(*options_.follow_frame)
                                          : std::expected<tf::RigidTransform, tf::LookupFailure>{};
  return pose && options_.follow_frame ? scenegraph::Follow::Pose(*pose) : std::nullopt;
}

Result<void> SceneSession::placeCamera() {
  // A camera that nobody moved sees all there is, in the recording that it was saved for as it was saved.
  if (options_.layout && !options_.is_camera_named &&
      (options_.layout->is_camera_touched || options_.layout->dataset == recording_->dataset()->name())) {
    rig_.setState(options_.layout->viewpoint.camera);
    follow_.setState(options_.layout->viewpoint.follow);
    follow_.track(followedPose(), rig_);
    return {};
  }
  if (options_.follow_frame) {
    const std::string& frame = *options_.follow_frame;
    const tf::TransformBuffer& transforms = *recording_->dataset()->transforms();
    if (!transforms.findFrame(frame)) {
      return usageError(options_.recording.file + ": " + scenegraph::noSuch("frame", frame, transforms.frames()));
    }
    if (const auto pose = scene_->frames().fixedFromFrame(frame); !pose) {
      return failure(options_.recording.file + ": '" + frame +
                     "' cannot be followed: " + transforms.describe(pose.error()));
    }
  }
  follow_.setMode(options_.follow, followedPose(), rig_);
  follow_.reset(followedPose());
  const double aspect = static_cast<double>(options_.size.width_px) / options_.size.height_px;
  scenegraph::Sight sight;
  sight.vertical_fov_rad = glm::radians(options_.vertical_fov_deg);
  rig_.setState({});
  rig_.look(sight);
  rig_.setKind(options_.camera);
  if (options_.camera == scenegraph::CameraKind::TopDownOrtho) {
    rig_.reset();
  }
  rig_.change().frame(scenegraph::transformBox(tf::inverse(follow_.fixedFromCamera()), scene_->bulkInFixed()), aspect);
  sight = rig_.model().sight();
  if (options_.eye) {
    rig_.look(scenegraph::lookingFrom(*options_.eye, options_.look_at.value_or(sight.focal_point), sight));
  } else if (options_.look_at) {
    sight.focal_point = *options_.look_at;
    rig_.look(sight);
  }
  if (options_.camera == scenegraph::CameraKind::TopDownOrtho) {
    scenegraph::CameraState state = rig_.state();
    if (options_.eye) {  // its height says nothing about the width of a picture without perspective
      state.top_down.vertical_extent_m = sight.radius_m * 2.0 * std::tan(sight.vertical_fov_rad / 2.0);
    }
    state.top_down.vertical_extent_m = options_.ortho_height_m.value_or(state.top_down.vertical_extent_m);
    rig_.setState(state);
  }
  return {};
}

scenegraph::CameraView SceneSession::camera(double turn_rad) const {
  scenegraph::CameraView view = rig_.view();
  if (options_.eye && options_.camera != scenegraph::CameraKind::TopDownOrtho) {
    // Not through the camera, which keeps its own bounds of radius and pitch: the eye is exactly where it was asked
    // for.
    view.eye_from_fixed =
        scenegraph::lookAt(*options_.eye, options_.look_at.value_or(rig_.model().sight().focal_point), {0, 0, 1});
  }
  if (turn_rad != 0.0) {
    const glm::dvec3 middle = options_.look_at.value_or(rig_.model().sight().focal_point);
    view.eye_from_fixed = view.eye_from_fixed * glm::translate(glm::dmat4(1.0), middle) *
                          glm::rotate(glm::dmat4(1.0), -turn_rad, glm::dvec3(0.0, 0.0, 1.0)) *
                          glm::translate(glm::dmat4(1.0), -middle);
  }
  return follow_.view(view);
}

scenegraph::ExportInfo SceneSession::exportInfo() const {
  scenegraph::ExportInfo info{.time = time_,
                              .fixed_frame = scene_->fixedFrame(),
                              .source = options_.recording.file,
                              .layers = {},
                              .viewport_height_px = options_.size.height_px};
  for (const auto& slot : scene_->layers()) {
    if (slot->layer->isVisible()) {
      info.layers.emplace_back(slot->id, slot->layer->settings());
    }
  }
  return info;
}

}  // namespace stillframe::cli
