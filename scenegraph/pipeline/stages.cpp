#include "scenegraph/pipeline/stages.h"

#include <algorithm>
#include <array>
#include <limits>
#include <osg/BlendFunc>
#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Texture2D>
#include <osg/Texture2DMultisample>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/geometry.h"
#include "scenegraph/osg_matrix.h"
#include "scenegraph/pipeline/full_screen.h"
#include "scenegraph/pipeline/gl_target.h"
#include "scenegraph/pipeline/sub_pixel.h"
#include "scenegraph/srgb.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;

constexpr GLbitfield kSceneTargets = GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT;

GLint internalFormat(TargetFormat format) {
  switch (format) {
    case TargetFormat::R16F:
      return GL_R16F;
    case TargetFormat::Rgba8:
      return GL_RGBA8;
    case TargetFormat::R11G11B10F:
      return GL_R11F_G11F_B10F;
    case TargetFormat::Rgba16F:
      return GL_RGBA16F;
    case TargetFormat::Rgba32F:
      return GL_RGBA32F;
  }
  return GL_RGBA16F;
}

osg::ref_ptr<osg::Texture> makeTarget(int width_px, int height_px, GLint internal_format, GLenum format) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
  texture->setTextureSize(width_px, height_px);
  texture->setInternalFormat(internal_format);
  texture->setSourceFormat(format);
  texture->setSourceType(GL_FLOAT);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  texture->setResizeNonPowerOfTwoHint(false);
  return texture;
}

/// A camera that renders to textures and takes nothing from the viewer's main camera.
osg::ref_ptr<osg::Camera> makeTargetCamera(int order, int width_px, int height_px) {
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
  camera->setRenderOrder(osg::Camera::PRE_RENDER, order);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setImplicitBufferAttachmentMask(0, 0);
  camera->setViewport(0, 0, width_px, height_px);
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera->setCullingMode(osg::CullSettings::NO_CULLING);
  camera->setAllowEventFocus(false);
  return camera;
}

/// Hands the blended things that were culled to `transparency`, and all to `steps`.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): OSG counts references
class AdoptCulled : public osg::NodeCallback {
 public:
  AdoptCulled(const osg::ref_ptr<Transparency>& transparency, const osg::ref_ptr<SceneSteps>& steps)
      : transparency_(transparency), steps_(steps) {}
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    traverse(node, visitor);
    if (osgUtil::CullVisitor* const cull = visitor->asCullVisitor()) {
      transparency_->adopt(*cull);
      steps_->adopt(*cull);
    }
  }

 protected:
  ~AdoptCulled() override = default;

 private:
  osg::ref_ptr<Transparency> transparency_;
  osg::ref_ptr<SceneSteps> steps_;
};

Status unknownInput(const PostPass& pass, const std::string& input) {
  return {StatusLevel::Error, "UnknownInput",
          "the pass '" + pass.name + "' reads '" + input + "', which nothing before it writes"};
}

}  // namespace

std::expected<Stages, Status> Stages::make(osg::Group& root, const PostChain& chain, const Options& options) {
  Stages stages;
  stages.options_ = options;
  stages.group_ = new osg::Group;
  stages.samples_ = std::clamp(chain.msaa_samples, 1, std::max(1, options.max_samples));
  stages.addScene(root, chain);
  for (std::size_t i = 0; i < chain.passes.size(); ++i) {
    for (const auto& [uniform, input] : chain.passes[i].inputs) {
      if (!stages.targets_.contains(input)) {
        return std::unexpected(unknownInput(chain.passes[i], input));
      }
    }
    stages.addPass(chain.passes[i]);
    stages.takeBack(chain, i + 1);
  }
  if (options.presents) {
    const auto present = makeFullScreenTriangle(stages.stepState(
        {.name = "present", .fragment_source = glsl::k_present_frag, .inputs = {{"u_image", stages.last_target_}}}));
    stages.group_->addChild(present);
    stages.passes_.emplace_back("present");
    if (stages.averaging_ != nullptr) {
      stages.after_averaging_.emplace_back(present);
    }
  }
  return stages;
}

osg::ref_ptr<osg::Texture> Stages::acquire(const Key& key) {
  if (const auto found = free_.find(key); found != free_.end()) {
    osg::ref_ptr<osg::Texture> texture = found->second;
    free_.erase(found);
    return texture;
  }
  const auto [format, divisor] = key;
  return makeTarget((options_.width_px + divisor - 1) / divisor, (options_.height_px + divisor - 1) / divisor,
                    internalFormat(format), format == TargetFormat::R16F ? GL_RED : GL_RGBA);
}

/// OSG 3.6.5 allocates multisampled textures by a name that is none yet: ours is made here, and only lent to OSG.
osg::ref_ptr<osg::Texture> Stages::makeSampled(GLint internal_format) {
  const std::uint32_t name = gl::makeSampledTexture(static_cast<std::uint32_t>(internal_format), samples_,
                                                    options_.width_px, options_.height_px);
  sampled_textures_.push_back(name);
  osg::ref_ptr<osg::Texture2DMultisample> texture = new osg::Texture2DMultisample{samples_, GL_TRUE};
  texture->setTextureSize(options_.width_px, options_.height_px);
  texture->setInternalFormat(internal_format);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);  // else OSG asks for mipmaps
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setTextureObject(options_.context_id,
                            new osg::Texture::TextureObject{texture, name, GL_TEXTURE_2D_MULTISAMPLE});
  return texture;
}

/// Frees the targets for reuse that neither the passes from `next` on nor the picture's reader need.
void Stages::takeBack(const PostChain& chain, std::size_t next) {
  for (auto it = targets_.begin(); it != targets_.end();) {
    const std::string& name = it->first;
    bool is_needed = name == "depth" || name == last_target_ || name.ends_with("_samples");
    for (std::size_t i = next; i < chain.passes.size(); ++i) {
      is_needed =
          is_needed || std::ranges::find(chain.passes[i].inputs, name, &std::pair<std::string, std::string>::second) !=
                           chain.passes[i].inputs.end();
    }
    if (!is_needed) {
      free_.emplace(it->second.first, it->second.second);
    }
    it = is_needed ? std::next(it) : targets_.erase(it);
  }
}

osg::ref_ptr<osg::StateSet> Stages::stepState(const PostPass& pass) const {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  if (pass.parameters != nullptr) {
    state->merge(*pass.parameters);
  }
  state->setAttributeAndModes(makeProgram(pass.name, glsl::k_full_screen_vert, pass.fragment_source));
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state->setMode(GL_BLEND, osg::StateAttribute::OFF);
  unsigned unit = 0;
  for (const auto& [uniform, input] : pass.inputs) {
    state->setTextureAttribute(unit, target(input));
    state->addUniform(new osg::Uniform{uniform.c_str(), static_cast<int>(unit)});
    ++unit;
  }
  return state;
}

void Stages::addScene(osg::Group& root, const PostChain& chain) {
  const int width = options_.width_px;
  const int height = options_.height_px;
  const Key key{chain.scene_format, 1};
  targets_["scene"] = {key, acquire(key)};
  targets_["depth"] = {key, makeTarget(width, height, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT)};
  if (samples_ > 1) {
    targets_["scene_samples"] = {key, makeSampled(internalFormat(chain.scene_format))};
    targets_["depth_samples"] = {key, makeSampled(GL_DEPTH_COMPONENT32F)};
  }
  last_target_ = "scene";
  passes_ = {"scene"};

  scene_camera_ = makeTargetCamera(order_, width, height);
  scene_camera_->setName("scene");
  scene_camera_->attach(osg::Camera::COLOR_BUFFER, target(sceneTarget()));
  scene_camera_->attach(osg::Camera::DEPTH_BUFFER, target(depthTarget()));
  scene_camera_->setClearMask(kSceneTargets);
  scene_camera_->setClearDepth(0.0);
  osg::StateSet& state = *scene_camera_->getOrCreateStateSet();
  state.setAttribute(new osg::ClipControl{osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE});
  // A node's own depth function is made for ordinary depth; here it would hide the node.
  state.setAttribute(new osg::Depth{osg::Depth::GREATER, 0.0, 1.0, true}, osg::StateAttribute::OVERRIDE);
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
  state.addUniform(new osg::Uniform{"u_linear_output", 1.0F});
  state.addUniform(new osg::Uniform{"u_viewport_height_px", static_cast<float>(height)});
  scene_camera_->addChild(&root);
  transparency_ = new Transparency{width, height, samples_, target(depthTarget()), options_.blend};
  steps_ = new SceneSteps(options_.first_uses);
  scene_camera_->setCullCallback(new AdoptCulled{transparency_, steps_});
  group_->addChild(scene_camera_);
  if (samples_ > 1) {
    state.setMode(GL_MULTISAMPLE, osg::StateAttribute::ON);
    addResolve();
  }
}

/// By a pass of ours: OSG's own resolve copies no 32-bit float depth, and goes on without a word.
void Stages::addResolve() {
  osg::ref_ptr<osg::StateSet> state =
      stepState({.name = "resolve",
                 .fragment_source = glsl::k_resolve_frag,
                 .inputs = {{"u_colors", "scene_samples"}, {"u_depths", "depth_samples"}}});
  state->addUniform(new osg::Uniform{"u_samples", samples_});
  // Depth is written where the test is on.
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
  state->setAttribute(new osg::Depth{osg::Depth::ALWAYS, 0.0, 1.0, true});
  state->setAttribute(new osg::ClipControl{osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE});
  osg::ref_ptr<osg::Camera> camera = makeTargetCamera(++order_, options_.width_px, options_.height_px);
  camera->setName("resolve");
  camera->setClearMask(0);
  camera->attach(osg::Camera::COLOR_BUFFER, target("scene"));
  camera->attach(osg::Camera::DEPTH_BUFFER, target("depth"));
  camera->addChild(makeFullScreenTriangle(state));
  group_->addChild(camera);
  passes_.emplace_back("resolve");
}

void Stages::addPass(const PostPass& pass) {
  const int divisor = std::max(1, pass.divisor);
  osg::ref_ptr<osg::Camera> camera = makeTargetCamera(++order_, (options_.width_px + divisor - 1) / divisor,
                                                      (options_.height_px + divisor - 1) / divisor);
  camera->setName(pass.name);
  camera->setClearMask(0);
  const osg::ref_ptr<osg::StateSet> state = stepState(pass);  // before its own target exists: a pass cannot read it
  camera->addChild(makeFullScreenTriangle(state));
  if (averaging_ != nullptr) {
    after_averaging_.emplace_back(camera);
  } else if (pass.sub_frames > 1) {
    averaging_ = camera;
    sub_frames_ = pass.sub_frames;
    camera->setClearColor({0.0F, 0.0F, 0.0F, 0.0F});
    state->addUniform(new osg::Uniform{"u_weight", 1.0F / static_cast<float>(sub_frames_)});
    state->setAttributeAndModes(new osg::BlendFunc{GL_ONE, GL_ONE});
  }
  const Key key{pass.format, divisor};
  targets_[pass.name] = {key, acquire(key)};
  camera->attach(osg::Camera::COLOR_BUFFER, target(pass.name));
  group_->addChild(camera);
  pass_states_.push_back(state);
  passes_.push_back(pass.name);
  last_target_ = pass.name;
}

std::optional<PointTargets> Stages::pointTargets() const {
  const auto scene = targets_.find("scene");
  if (samples_ > 1 || scene == targets_.end() || internalFormat(scene->second.first.first) != GL_RGBA16F) {
    return std::nullopt;
  }
  const osg::Vec4& clear = scene_camera_->getClearColor();
  return PointTargets{target("scene"), target("depth"), {clear.r(), clear.g(), clear.b(), clear.a()}};
}

void Stages::setView(const osg::Matrixd& eye_from_fixed, const glm::dmat4& clip_from_eye, const Color& background) {
  clip_from_eye_ = clip_from_eye;
  scene_camera_->setProjectionMatrix(toOsg(clip_from_eye));
  scene_camera_->setViewMatrix(eye_from_fixed);
  scene_camera_->setClearColor(
      {linearFromSrgb(background.r), linearFromSrgb(background.g), linearFromSrgb(background.b), 1.0F});
  if (pass_states_.empty()) {
    return;
  }
  const bool is_orthographic = clip_from_eye[3][3] != 0.0;
  // Perspective: distance = near / depth. Orthographic: distance = (zw - depth) / zz.
  const osg::Vec2 distance = is_orthographic ? osg::Vec2(static_cast<float>(clip_from_eye[3][2] / clip_from_eye[2][2]),
                                                         static_cast<float>(-1.0 / clip_from_eye[2][2]))
                                             : osg::Vec2(static_cast<float>(clip_from_eye[3][2]), 0.0F);
  osg::StateSet& state = *group_->getOrCreateStateSet();
  state.getOrCreateUniform("u_ray_scale", osg::Uniform::FLOAT_VEC2)
      ->set(osg::Vec2(static_cast<float>(1.0 / clip_from_eye[0][0]), static_cast<float>(1.0 / clip_from_eye[1][1])));
  state.getOrCreateUniform("u_distance", osg::Uniform::FLOAT_VEC2)->set(distance);
  state.getOrCreateUniform("u_is_orthographic", osg::Uniform::BOOL)->set(is_orthographic);
}

void Stages::takeParameters(const PostChain& chain) {
  for (std::size_t i = 0; i < pass_states_.size() && i < chain.passes.size(); ++i) {
    if (chain.passes[i].parameters == nullptr) {
      continue;
    }
    for (const auto& [name, uniform] : chain.passes[i].parameters->getUniformList()) {
      pass_states_[i]->addUniform(uniform.first);
    }
  }
}

void Stages::startSubFrame(int index) {
  if (averaging_ == nullptr) {
    return;
  }
  const bool is_last = index + 1 == sub_frames_;
  averaging_->setClearMask(index == 0 ? GL_COLOR_BUFFER_BIT : 0U);
  for (const auto& node : after_averaging_) {
    node->setNodeMask(is_last ? ~0U : 0U);
  }
  const glm::dvec2 shift = subPixelShift(index, sub_frames_);
  scene_camera_->setProjectionMatrix(
      toOsg(shiftedByPixels(clip_from_eye_, shift, options_.width_px, options_.height_px)));
}

void Stages::showOnly(std::size_t index, bool clears) {
  scene_camera_->setClearMask(clears ? kSceneTargets : 0U);
  for (unsigned i = 0; i < group_->getNumChildren(); ++i) {
    group_->getChild(i)->setNodeMask(i == index ? ~0U : 0U);
  }
}

void Stages::showAll() {
  scene_camera_->setClearMask(kSceneTargets);
  steps_->setBudget(std::numeric_limits<double>::infinity(), false);
  beginSteps();
  for (unsigned i = 0; i < group_->getNumChildren(); ++i) {
    group_->getChild(i)->setNodeMask(~0U);
  }
}

void Stages::beginSteps() {
  steps_->begin();
  transparency_->begin();
}

std::size_t Stages::lastOfSubFrame() const {
  return averaging_ == nullptr ? count() - 1 : group_->getChildIndex(averaging_);
}

void Stages::release(osg::State& state) {
  scene_camera_->removeChildren(0, scene_camera_->getNumChildren());  // the scene keeps its objects
  transparency_->release(state);
  steps_->release();
  group_->releaseGLObjects(&state);
  group_->removeChildren(0, group_->getNumChildren());
  for (const auto& [name, target] : targets_) {
    target.second->releaseGLObjects(&state);
  }
  for (const auto& [key, texture] : free_) {
    texture->releaseGLObjects(&state);
  }
  for (const std::uint32_t name : sampled_textures_) {
    gl::deleteTexture(name);
  }
  sampled_textures_.clear();
}

osg::Texture* Stages::target(const std::string& name) const {
  const auto found = targets_.find(name);
  return found == targets_.end() ? nullptr : found->second.second.get();
}

}  // namespace stillframe::scenegraph
