#include "scenegraph/pipeline/view_pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <osg/Camera>
#include <osg/GLObjects>
#include <osg/Texture>
#include <osgViewer/Renderer>
#include <utility>

#include "scenegraph/buffer_patches.h"
#include "scenegraph/geometry.h"
#include "scenegraph/osg_matrix.h"
#include "scenegraph/pipeline/compute_points.h"
#include "scenegraph/pipeline/gl_context_info.h"
#include "scenegraph/pipeline/texture_uploads.h"
#include "scenegraph/pipeline/view_pipeline_impl.h"
#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {
namespace {

/// OpenGL in software takes some 300 ns a point; the CPU, before it draws any, some 10 ns a pixel.
constexpr double kPointsAPixelThatPay = 1.0 / 30.0;
constexpr std::size_t kPointsThatPayOnAGpu = 1'000'000;  // fewer are drawn as primitives in a millisecond or two
constexpr double kMostPixels = 1 << 24;                  // at 20 bytes each

}  // namespace

void ViewPipeline::Impl::makeViewer() {
  const auto info = inspectCurrentContext();
  is_software = info && info->is_software;
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
}

/// OSG's compile step, which comes with each scene, draws text outright, with no target bound. What is drawn compiles
/// itself.
void ViewPipeline::Impl::setSceneData(osg::Node* scene) {
  viewer->setSceneData(scene);
  if (auto* const renderer = dynamic_cast<osgViewer::Renderer*>(viewer->getCamera()->getRenderer())) {
    renderer->setCompileOnNextDraw(false);
  }
}

std::expected<void, Status> ViewPipeline::Impl::makeStages() {
  const int max_samples = chain.msaa_samples > 1 ? gl::maxSamples() : 1;
  if (std::exchange(used_samples, chain.msaa_samples) != chain.msaa_samples) {
    first_uses->clear();
  }
  drawn_stages = 0;
  auto made = Stages::make(*content, chain,
                           {.width_px = width_px,
                            .height_px = height_px,
                            .max_samples = max_samples,
                            .context_id = contextId(),
                            .blend = blend,
                            .first_uses = first_uses,
                            .presents = presents});
  if (!made) {
    return std::unexpected(made.error());
  }
  stages = std::move(*made);
  setSceneData(&stages->group());
  return {};
}

void ViewPipeline::Impl::dropStages() {
  if (!stages) {
    return;
  }
  stages->release(*window->getState());
  stages.reset();
  setSceneData(nullptr);
  osg::flushAllDeletedGLObjects(contextId());
}

/// Whoever uses the context between frames (a widget, a painter) leaves state that OSG does not know of. Modes are read
/// back, for OSG 3.6's dirtyAllModes() only negates what it remembers: half of them are then wrong. The unit that is
/// active it only ever remembers: a texture would be bound to another unit than it should.
///
/// Arrays OSG knows by their address alone: one made where another lay that was drawn last, and is gone since, would
/// be drawn from the other's buffer, unless a pass without arrays came in between. dirtyAllVertexArrays() does nothing
/// in OSG 3.6, so they are all let go of.
void ViewPipeline::Impl::adoptGlState() {
  osg::State& state = *window->getState();
  for (const GLenum mode : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_PROGRAM_POINT_SIZE, GL_POINT_SPRITE,
                            GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_MULTISAMPLE}) {
    state.haveAppliedMode(mode, gl::isEnabled(mode) ? osg::StateAttribute::ON : osg::StateAttribute::OFF);
  }
  gl::selectTextureUnits(state.getActiveTextureUnit(), state.getClientActiveTextureUnit());
  state.dirtyAllAttributes();
  if (state.getCurrentVertexArrayState() != nullptr) {  // there from the first frame on
    state.lazyDisablingOfVertexAttributes();
    state.applyDisablingOfVertexAttributes();
  }
}

GLuint ViewPipeline::Impl::targetId(const std::string& target) const {
  return textureId(stages ? stages->target(target) : nullptr, contextId());
}

/// OSG only prints a line when a framebuffer is incomplete and draws elsewhere; this says so.
std::expected<void, Status> ViewPipeline::Impl::checkTargets() const {
  const std::uint32_t status = gl::incompleteStatus(targetId(stages->sceneTarget()), targetId(stages->depthTarget()));
  if (status == 0) {
    return {};
  }
  return std::unexpected(Status{StatusLevel::Error, "TargetIncomplete",
                                "the OpenGL driver cannot draw into a target of " + std::to_string(width_px) + "x" +
                                    std::to_string(height_px) + " pixels with 32-bit float depth (framebuffer status " +
                                    std::to_string(status) + ")"});
}

PointWay ViewPipeline::Impl::wayOf(const PointCollection& points) const {
  if (points.count == 0 || point_way != PointWay::Auto) {
    return points.count == 0 ? PointWay::OpenGl : point_way;
  }
  const double pixels = static_cast<double>(width_px) * height_px;
  if (pixels > kMostPixels) {
    return PointWay::OpenGl;
  }
  if (is_software) {
    return static_cast<double>(points.count) > pixels * kPointsAPixelThatPay ? PointWay::Cpu : PointWay::OpenGl;
  }
  return points.count >= kPointsThatPayOnAGpu && ComputePoints::suits(points) ? PointWay::Compute : PointWay::OpenGl;
}

/// Those of the present sub-frame that OpenGL does not draw, and the stage for them; of several sub-frames each is
/// drawn with all points, in as many goes as the budget wants.
std::optional<PointWork> ViewPipeline::Impl::findPoints(double sub_frame_budget_ms) {
  PointCollection points;
  const bool is_gl_alone = point_way == PointWay::OpenGl || (point_way == PointWay::Auto && stages->samples() > 1);
  if (!is_gl_alone) {
    points = collectPoints(*root, toOsg(view.eye_from_fixed), stages->clipFromEye(), height_px);
  }
  const PointWay way = wayOf(points);
  if (point_stage != nullptr && way != stage_way) {
    dropPoints();
  }
  stage_way = way;
  if (way == PointWay::OpenGl) {
    return std::nullopt;
  }
  if (point_stage == nullptr) {
    point_stage = way == PointWay::Cpu
                      ? std::make_unique<PointStage>()
                      : std::make_unique<PointStage>(std::make_unique<ComputePoints>(*window->getState()));
    content->addChild(&point_stage->picture());
  }
  PointLimits limits = point_limits;
  if (stages->subFrames() > 1) {
    limits.budget_ms = sub_frame_budget_ms;
  } else if (isPaced()) {
    constexpr double kLeast = 0.25;    // of the budget: the picture of the points must come to an end
    constexpr double kUnknown = 0.75;  // of it, in a first frame, which makes shaders and textures
    constexpr double kAim = 0.9;       // at less than all of it: a core may be busy when the frame is half drawn
    const double rest = rest_ms.value_or(kUnknown * limits.budget_ms);
    limits.budget_ms = std::max(kAim * limits.budget_ms - rest, kLeast * limits.budget_ms);
  }
  point_stage->setTargets(stages->pointTargets());
  return PointWork{std::move(points), limits};
}

void ViewPipeline::Impl::notePoints(std::optional<PointProgress> progress) {
  point_progress = std::move(progress);
  stages->setCullMask(point_progress ? ~kOpaquePoints : ~osg::Node::NodeMask{0});
}

void ViewPipeline::Impl::drawPoints(std::optional<PointWork> work) {
  notePoints(work ? std::optional(point_stage->draw(std::move(work->points), width_px, height_px, work->limits))
                  : std::nullopt);
}

/// In software the frame is drawn by the processor that the points are drawn by: what it took, they have less of.
void ViewPipeline::Impl::drawFrame() {
  const auto start = std::chrono::steady_clock::now();
  viewer->frame();
  if (point_progress && isPaced()) {
    gl::finish();
    noteRest(millisecondsSince(start));
  }
}

/// Of a frame beside its points, of the last sub-frame where there are several: that is what a frame takes when they
/// are switched off. The next is not to be late too.
void ViewPipeline::Impl::noteRest(double took_ms) {
  rest_ms = rest_ms && took_ms < *rest_ms ? (*rest_ms + took_ms) / 2.0 : took_ms;
}

void ViewPipeline::Impl::dropPoints() {
  if (point_stage != nullptr) {
    point_stage->wait();
    content->removeChild(&point_stage->picture());
    point_stage->picture().releaseGLObjects(window->getState());
    point_stage.reset();
  }
}

/// Stages of this size and kind. Returns whether they were made anew.
std::expected<bool, Status> ViewPipeline::Impl::makeReady(int width, int height, bool present) {
  const bool resized = width != width_px || height != height_px;
  width_px = width;
  height_px = height;
  if (viewer == nullptr) {
    makeViewer();
  }
  if (resized) {
    window->resized(0, 0, width, height);
    viewer->getEventQueue()->windowResize(0, 0, width, height);
    viewer->getCamera()->setViewport(0, 0, width, height);
  }
  const bool remade = !stages || is_chain_new || resized || presents != present;
  if (remade) {
    presents = present;
    is_chain_new = false;
    dropStages();
    if (auto made = makeStages(); !made) {
      passes.clear();
      return std::unexpected(made.error());
    }
  }
  return remade;
}

/// Of the picture's goes each: what others did to the context meanwhile is taken over.
void ViewPipeline::Impl::startPicture(std::uint32_t output_fbo) {
  window->setDefaultFboId(output_fbo);
  takeOver();
}

/// The context, and what has changed of the buffers.
void ViewPipeline::Impl::takeOver() {
  adoptGlState();
  if (BufferPatches* const patches = BufferPatches::find(*root)) {
    patches->upload(contextId());
  }
}

void ViewPipeline::Impl::namePasses() {
  passes = stages->passes();
  if (stages->transparency().isInUse()) {
    passes.insert(passes.begin() + 1, "transparency");
  }
}

std::expected<void, Status> ViewPipeline::Impl::draw(std::uint32_t output_fbo, int width, int height, bool present) {
  stepped.reset();
  if (width <= 0 || height <= 0) {
    passes.clear();
    return {};
  }
  const auto remade = makeReady(width, height, present);
  if (!remade) {
    return std::unexpected(remade.error());
  }
  const Precedence frame(Precedence::Of::Window);
  projection_matrix = projection(view, static_cast<double>(width) / height);
  stages->setView(toOsg(view.eye_from_fixed), projection_matrix, background);
  stages->showAll();
  startPicture(output_fbo);
  for (int i = 0; i < stages->subFrames(); ++i) {
    stages->startSubFrame(i);
    drawPoints(findPoints(std::numeric_limits<double>::infinity()));
    gl::bindFramebuffer(output_fbo);
    drawFrame();
  }
  gl::bindFramebuffer(output_fbo);
  namePasses();
  return *remade ? checkTargets() : std::expected<void, Status>{};
}

ViewPipeline::ViewPipeline(const osg::ref_ptr<osg::Group>& root) : impl_(std::make_unique<Impl>()) {
  impl_->root = root;
  impl_->content = new osg::Group;
  impl_->content->addChild(root);
}

ViewPipeline::~ViewPipeline() { releaseGl(); }

void ViewPipeline::setView(const CameraView& view) { impl_->view = view; }

void ViewPipeline::setBackground(const Color& background) { impl_->background = background; }

void ViewPipeline::setPostChain(PostChain chain) {
  if (isSameStructure(chain, impl_->chain)) {
    if (impl_->stages && !impl_->is_chain_new) {
      impl_->stages->takeParameters(chain);
    }
  } else {
    impl_->is_chain_new = true;
  }
  impl_->chain = std::move(chain);
}

void ViewPipeline::setBlendLimits(const BlendLimits& limits) {
  impl_->is_chain_new = impl_->is_chain_new || limits != impl_->blend;
  impl_->blend = limits;
}

void ViewPipeline::setPointWay(PointWay way) { impl_->point_way = way; }

void ViewPipeline::setPointLimits(const PointLimits& limits) { impl_->point_limits = limits; }

void ViewPipeline::setWake(std::function<void()> wake) { impl_->wake = std::move(wake); }

const std::optional<PointProgress>& ViewPipeline::pointProgress() const noexcept { return impl_->point_progress; }

std::expected<void, Status> ViewPipeline::render(std::uint32_t output_fbo, int width_px, int height_px) {
  return impl_->draw(output_fbo, width_px, height_px, true);
}

std::expected<void, Status> ViewPipeline::renderLinear(int width_px, int height_px) {
  return impl_->draw(0, width_px, height_px, false);
}

std::vector<float> ViewPipeline::readColor(int first_row, int rows) const {
  return impl_->read(&gl::readColor, impl_->stages ? impl_->stages->lastTarget() : "", first_row, rows);
}
std::vector<float> ViewPipeline::readDepth(int first_row, int rows) const {
  return impl_->read(&gl::readDepth, "depth", first_row, rows);
}

const std::vector<std::string>& ViewPipeline::passes() const noexcept { return impl_->passes; }
int ViewPipeline::samples() const noexcept { return impl_->stages ? impl_->stages->samples() : 1; }
int ViewPipeline::blendedBands() const noexcept { return impl_->stages ? impl_->stages->transparency().bands() : 0; }
const glm::dmat4& ViewPipeline::projectionMatrix() const noexcept { return impl_->projection_matrix; }

bool ViewPipeline::hasPickTarget() const noexcept { return impl_->id_pass != nullptr; }

void ViewPipeline::releaseGl() {
  if (impl_->viewer == nullptr) {
    return;
  }
  if (impl_->id_pass != nullptr) {
    impl_->id_pass->release(*impl_->window->getState());
    impl_->id_pass.reset();
  }
  impl_->dropPoints();
  impl_->stepped.reset();
  impl_->aside.reset();
  impl_->first_uses->clear();
  impl_->content->releaseGLObjects(impl_->window->getState());
  impl_->dropStages();
  osg::deleteAllGLObjects(impl_->contextId());
  osg::flushAllDeletedGLObjects(impl_->contextId());
  // The id is not handed back for reuse: what was out of the graph just now may still hold names of this context.
  impl_->window->setState(nullptr);
  impl_->window = nullptr;
  impl_->viewer = nullptr;
}

}  // namespace stillframe::scenegraph
