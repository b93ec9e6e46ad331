#include "scenegraph/pipeline/view_pipeline.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <osg/Camera>
#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/GLObjects>
#include <osg/Texture2D>
#include <osgViewer/GraphicsWindow>
#include <osgViewer/Renderer>
#include <osgViewer/Viewer>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/gl_target.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;

osg::Matrixd toOsg(const glm::dmat4& matrix) { return osg::Matrixd(glm::value_ptr(matrix)); }

float linearFromSrgb(float srgb) { return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F); }

osg::ref_ptr<osg::Texture2D> makeTarget(int width_px, int height_px, GLint internal_format, GLenum format) {
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

osg::ref_ptr<osg::Geometry> makeFullScreenTriangle() {
  osg::ref_ptr<osg::Geometry> triangle = makeGeometry();
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back({-1.0F, -1.0F, 0.0F});
  vertices->push_back({3.0F, -1.0F, 0.0F});
  vertices->push_back({-1.0F, 3.0F, 0.0F});
  triangle->setVertexArray(vertices);
  triangle->addPrimitiveSet(new osg::DrawArrays{GL_TRIANGLES, 0, 3});
  triangle->setCullingActive(false);
  return triangle;
}

}  // namespace

struct ViewPipeline::Impl {
  osg::ref_ptr<osg::Group> root;
  CameraView view;
  Color background;
  std::vector<PostPass> post_passes;
  glm::dmat4 projection_matrix{1.0};
  std::vector<std::string> passes;

  // All below is remade when the size, the passes or the kind of output change.
  osg::ref_ptr<osgViewer::Viewer> viewer;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window;
  osg::ref_ptr<osg::Group> stages;
  osg::ref_ptr<osg::Camera> scene_camera;
  std::map<std::string, osg::ref_ptr<osg::Texture2D>> targets;
  std::string last_target;
  int width_px = 0;
  int height_px = 0;
  bool presents = false;
  bool stale = true;

  [[nodiscard]] unsigned contextId() const { return window->getState()->getContextID(); }
  void makeViewer();
  void makeStages();
  void dropStages();
  void adoptGlState();
  osg::ref_ptr<osg::Geometry> makeStep(const PostPass& pass) const;
  [[nodiscard]] GLuint textureId(const std::string& target) const;
  std::expected<void, Status> checkTargets() const;
  std::expected<void, Status> draw(std::uint32_t output_fbo, int width, int height, bool present);
};

void ViewPipeline::Impl::makeViewer() {
  viewer = new osgViewer::Viewer;
  viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer->setUseConfigureAffinity(false);  // OSG 3.6 would pin this thread, and all it starts, to the first core
  viewer->setKeyEventSetsDone(0);
  viewer->setQuitEventSetsDone(false);
  viewer->setReleaseContextAtEndOfFrameHint(false);
  viewer->setLightingMode(osg::View::NO_LIGHT);
  window = viewer->setUpViewerAsEmbeddedInWindow(0, 0, width_px, height_px);
  osg::Camera& main = *viewer->getCamera();
  main.setClearMask(0);
  main.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  main.setCullingMode(osg::CullSettings::NO_CULLING);
  main.setProjectionMatrix(osg::Matrixd::identity());
  main.setProjectionResizePolicy(osg::Camera::FIXED);
  stages = new osg::Group;
  viewer->setSceneData(stages);
  // OSG's compile step draws text outright, with no target bound. What is drawn compiles itself.
  if (auto* const renderer = dynamic_cast<osgViewer::Renderer*>(main.getRenderer())) {
    renderer->setCompileOnNextDraw(false);
  }
}

osg::ref_ptr<osg::Geometry> ViewPipeline::Impl::makeStep(const PostPass& pass) const {
  osg::ref_ptr<osg::Geometry> triangle = makeFullScreenTriangle();
  osg::StateSet& state = *triangle->getOrCreateStateSet();
  if (pass.parameters != nullptr) {
    state.merge(*pass.parameters);
  }
  state.setAttributeAndModes(makeProgram(pass.name, glsl::k_full_screen_vert, pass.fragment_source));
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state.setMode(GL_BLEND, osg::StateAttribute::OFF);
  unsigned unit = 0;
  for (const auto& [uniform, target] : pass.inputs) {
    const auto found = targets.find(target);
    if (found != targets.end()) {
      state.setTextureAttribute(unit, found->second);
      state.addUniform(new osg::Uniform{uniform.c_str(), static_cast<int>(unit)});
      ++unit;
    }
  }
  return triangle;
}

void ViewPipeline::Impl::makeStages() {
  targets["scene"] = makeTarget(width_px, height_px, GL_RGBA16F, GL_RGBA);
  targets["depth"] = makeTarget(width_px, height_px, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
  last_target = "scene";
  passes = {"scene"};

  scene_camera = makeTargetCamera(0, width_px, height_px);
  scene_camera->setName("scene");
  scene_camera->attach(osg::Camera::COLOR_BUFFER, targets["scene"]);
  scene_camera->attach(osg::Camera::DEPTH_BUFFER, targets["depth"]);
  scene_camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  scene_camera->setClearDepth(0.0);
  osg::StateSet& state = *scene_camera->getOrCreateStateSet();
  state.setAttribute(new osg::ClipControl{osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE});
  // A node's own depth function is made for ordinary depth; here it would hide the node.
  state.setAttribute(new osg::Depth{osg::Depth::GREATER, 0.0, 1.0, true}, osg::StateAttribute::OVERRIDE);
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
  state.addUniform(new osg::Uniform{"u_linear_output", 1.0F});
  state.addUniform(new osg::Uniform{"u_viewport_height_px", static_cast<float>(height_px)});
  scene_camera->addChild(root);
  stages->addChild(scene_camera);

  int order = 0;
  for (const PostPass& pass : post_passes) {
    osg::ref_ptr<osg::Camera> camera = makeTargetCamera(++order, width_px, height_px);
    camera->setName(pass.name);
    camera->setClearMask(0);
    camera->addChild(makeStep(pass));  // before its own target exists: a pass cannot read what it writes
    targets[pass.name] = makeTarget(width_px, height_px, GL_RGBA16F, GL_RGBA);
    camera->attach(osg::Camera::COLOR_BUFFER, targets[pass.name]);
    stages->addChild(camera);
    last_target = pass.name;
    passes.push_back(pass.name);
  }
  if (presents) {
    stages->addChild(makeStep({"present", glsl::k_present_frag, {{"u_image", last_target}}, nullptr}));
    passes.emplace_back("present");
  }
}

void ViewPipeline::Impl::dropStages() {
  if (scene_camera == nullptr) {
    return;
  }
  scene_camera->removeChildren(0, scene_camera->getNumChildren());  // the scene keeps its objects
  osg::State& state = *window->getState();
  stages->releaseGLObjects(&state);
  stages->removeChildren(0, stages->getNumChildren());
  for (const auto& [name, texture] : targets) {
    texture->releaseGLObjects(&state);
  }
  targets.clear();
  scene_camera = nullptr;
  osg::flushAllDeletedGLObjects(contextId());
}

/// Whoever uses the context between frames (a widget, a painter) leaves state that OSG does not know of. Modes are read
/// back, for OSG 3.6's dirtyAllModes() only negates what it remembers: half of them are then wrong. The unit that is
/// active it only ever remembers: a texture would be bound to another unit than it should.
void ViewPipeline::Impl::adoptGlState() {
  osg::State& state = *window->getState();
  for (const GLenum mode : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_PROGRAM_POINT_SIZE, GL_POINT_SPRITE,
                            GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_MULTISAMPLE}) {
    state.haveAppliedMode(mode, gl::isEnabled(mode) ? osg::StateAttribute::ON : osg::StateAttribute::OFF);
  }
  gl::selectTextureUnits(state.getActiveTextureUnit(), state.getClientActiveTextureUnit());
  state.dirtyAllAttributes();
  state.dirtyAllVertexArrays();
}

GLuint ViewPipeline::Impl::textureId(const std::string& target) const {
  const auto found = targets.find(target);
  const osg::Texture::TextureObject* object =
      found == targets.end() ? nullptr : found->second->getTextureObject(contextId());
  return object == nullptr ? 0U : object->id();
}

/// OSG only prints a line when a framebuffer is incomplete and draws elsewhere; this says so.
std::expected<void, Status> ViewPipeline::Impl::checkTargets() const {
  const std::uint32_t status = gl::incompleteStatus(textureId("scene"), textureId("depth"));
  if (status == 0) {
    return {};
  }
  return std::unexpected(Status{StatusLevel::Error, "TargetIncomplete",
                                "the OpenGL driver cannot draw into a half-float target of " +
                                    std::to_string(width_px) + "x" + std::to_string(height_px) +
                                    " pixels with 32-bit float depth (framebuffer status " + std::to_string(status) +
                                    ")"});
}

std::expected<void, Status> ViewPipeline::Impl::draw(std::uint32_t output_fbo, int width, int height, bool present) {
  if (width <= 0 || height <= 0) {
    passes.clear();
    return {};
  }
  const bool resized = width != width_px || height != height_px;
  width_px = width;
  height_px = height;
  if (viewer == nullptr) {
    makeViewer();
    stale = true;
  }
  if (resized) {
    window->resized(0, 0, width, height);
    viewer->getEventQueue()->windowResize(0, 0, width, height);
    viewer->getCamera()->setViewport(0, 0, width, height);
  }
  const bool remade = stale || resized || presents != present;
  if (remade) {
    presents = present;
    dropStages();
    makeStages();
    stale = false;
  }
  projection_matrix = projection(view, static_cast<double>(width) / height);
  scene_camera->setProjectionMatrix(toOsg(projection_matrix));
  scene_camera->setViewMatrix(toOsg(view.eye_from_fixed));
  scene_camera->setClearColor(
      {linearFromSrgb(background.r), linearFromSrgb(background.g), linearFromSrgb(background.b), 1.0F});
  window->setDefaultFboId(output_fbo);
  adoptGlState();
  gl::bindFramebuffer(output_fbo);
  viewer->frame();
  gl::bindFramebuffer(output_fbo);
  return remade ? checkTargets() : std::expected<void, Status>{};
}

ViewPipeline::ViewPipeline(const osg::ref_ptr<osg::Group>& root) : impl_(std::make_unique<Impl>()) {
  impl_->root = root;
}

ViewPipeline::~ViewPipeline() { releaseGl(); }

void ViewPipeline::setView(const CameraView& view) { impl_->view = view; }

void ViewPipeline::setBackground(const Color& background) { impl_->background = background; }

void ViewPipeline::setPostPasses(std::vector<PostPass> passes) {
  impl_->post_passes = std::move(passes);
  impl_->stale = true;
}

std::expected<void, Status> ViewPipeline::render(std::uint32_t output_fbo, int width_px, int height_px) {
  return impl_->draw(output_fbo, width_px, height_px, true);
}

std::expected<void, Status> ViewPipeline::renderLinear(int width_px, int height_px) {
  return impl_->draw(0, width_px, height_px, false);
}

LinearFrame ViewPipeline::readLinear() const {
  if (impl_->viewer == nullptr || impl_->targets.empty()) {
    return {};
  }
  return {.rgba = gl::readColor(impl_->textureId(impl_->last_target), impl_->width_px, impl_->height_px),
          .depth = gl::readDepth(impl_->textureId("depth"), impl_->width_px, impl_->height_px)};
}

const std::vector<std::string>& ViewPipeline::passes() const noexcept { return impl_->passes; }

const glm::dmat4& ViewPipeline::projectionMatrix() const noexcept { return impl_->projection_matrix; }

void ViewPipeline::releaseGl() {
  if (impl_->viewer == nullptr) {
    return;
  }
  impl_->root->releaseGLObjects(impl_->window->getState());
  impl_->dropStages();
  osg::deleteAllGLObjects(impl_->contextId());
  osg::flushAllDeletedGLObjects(impl_->contextId());
  // The id is not handed back for reuse: what was out of the graph just now may still hold names of this context.
  impl_->window->setState(nullptr);
  impl_->stages = nullptr;
  impl_->window = nullptr;
  impl_->viewer = nullptr;
}

}  // namespace stillframe::scenegraph
