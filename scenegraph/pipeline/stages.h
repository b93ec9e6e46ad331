#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <map>
#include <memory>
#include <optional>
#include <osg/Camera>
#include <osg/Group>
#include <osg/Texture>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pipeline/first_uses.h"
#include "scenegraph/pipeline/point_picture.h"
#include "scenegraph/pipeline/post_chain.h"
#include "scenegraph/pipeline/scene_steps.h"
#include "scenegraph/pipeline/transparency.h"
#include "scenegraph/settings.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// What a pipeline draws in one frame, for one size and one chain: cameras, their named targets, the full-screen steps.
///
/// Made anew when the size or the structure of the chain changes; a target that nobody reads any more is written again
/// by a later pass, so that a long chain needs two colour targets. Names: "scene" and "depth" (with multisampling the
/// resolved ones), then each pass's own. Thread of the context only.
class Stages {
 public:
  struct Options {
    int width_px = 0;
    int height_px = 0;
    int max_samples = 1;  ///< of the driver; more are not asked for
    unsigned context_id = 0;
    BlendLimits blend = {};
    std::shared_ptr<FirstUses> first_uses = {};  ///< in this context, with as many samples
    bool presents = false;                       ///< ends with the sRGB picture in the viewer's framebuffer
  };
  /// Error "UnknownInput": a pass reads what no earlier one wrote. The context must be current.
  [[nodiscard]] static std::expected<Stages, Status> make(osg::Group& root, const PostChain& chain,
                                                          const Options& options);

  [[nodiscard]] osg::Group& group() noexcept { return *group_; }
  /// What the passes are told of the camera: rays, metres from depth.
  void setView(const osg::Matrixd& eye_from_fixed, const glm::dmat4& clip_from_eye, const Color& background);
  /// Takes the values of uniforms from a chain of the same structure.
  void takeParameters(const PostChain& chain);
  /// Where a picture of half floats may be put before the scene is drawn, in place of what it is cleared to; nullopt
  /// where it is drawn otherwise.
  [[nodiscard]] std::optional<PointTargets> pointTargets() const;
  /// The scene's projection, of the present sub-frame.
  [[nodiscard]] const osg::Matrixd& clipFromEye() const { return scene_camera_->getProjectionMatrix(); }
  /// Leaves out of the scene what has no bit in common with `mask`.
  void setCullMask(osg::Node::NodeMask mask) { scene_camera_->setCullMask(mask); }
  /// Frames that one picture takes; each begins with startSubFrame().
  [[nodiscard]] int subFrames() const noexcept { return sub_frames_; }
  void startSubFrame(int index);
  /// Cameras and steps one after the other: the scene first, then its passes, present last.
  [[nodiscard]] std::size_t count() const { return group_->getNumChildren(); }
  /// The next frame draws the one of them alone; `clears` the scene's targets, where it is the scene.
  void showOnly(std::size_t index, bool clears);
  void showAll();
  /// The next frames draw the scene in steps, from its beginning.
  void beginSteps();
  /// The last of the cameras that each sub-frame draws; those after it draw what is averaged.
  [[nodiscard]] std::size_t lastOfSubFrame() const;
  [[nodiscard]] SceneSteps& steps() noexcept { return *steps_; }
  /// The graph lets go of the scene and frees its own GL objects.
  void release(osg::State& state);

  [[nodiscard]] const std::vector<std::string>& passes() const noexcept { return passes_; }
  [[nodiscard]] int samples() const noexcept { return samples_; }
  [[nodiscard]] const Transparency& transparency() const noexcept { return *transparency_; }
  /// nullptr when there is none of that name.
  [[nodiscard]] osg::Texture* target(const std::string& name) const;
  [[nodiscard]] const std::string& lastTarget() const noexcept { return last_target_; }
  /// Name of the target that the scene itself is drawn into, and of its depth.
  [[nodiscard]] std::string sceneTarget() const { return samples_ > 1 ? "scene_samples" : "scene"; }
  [[nodiscard]] std::string depthTarget() const { return samples_ > 1 ? "depth_samples" : "depth"; }

 private:
  using Key = std::pair<TargetFormat, int>;  // format and divisor
  Stages() = default;
  void addScene(osg::Group& root, const PostChain& chain);
  void addResolve();
  void addPass(const PostPass& pass);
  void takeBack(const PostChain& chain, std::size_t next);
  osg::ref_ptr<osg::Texture> acquire(const Key& key);
  osg::ref_ptr<osg::Texture> makeSampled(GLint internal_format);
  [[nodiscard]] osg::ref_ptr<osg::StateSet> stepState(const PostPass& pass) const;

  Options options_;
  osg::ref_ptr<osg::Group> group_;
  osg::ref_ptr<osg::Camera> scene_camera_;
  osg::ref_ptr<Transparency> transparency_;
  osg::ref_ptr<SceneSteps> steps_;
  osg::ref_ptr<osg::Camera> averaging_;
  std::vector<osg::ref_ptr<osg::Node>> after_averaging_;
  std::vector<osg::ref_ptr<osg::StateSet>> pass_states_;
  std::map<std::string, std::pair<Key, osg::ref_ptr<osg::Texture>>> targets_;
  std::multimap<Key, osg::ref_ptr<osg::Texture>> free_;
  std::vector<std::uint32_t> sampled_textures_;  // names that we made ourselves
  std::vector<std::string> passes_;
  std::string last_target_;
  glm::dmat4 clip_from_eye_{1.0};
  int samples_ = 1;
  int sub_frames_ = 1;
  int order_ = 0;
};

}  // namespace stillframe::scenegraph
