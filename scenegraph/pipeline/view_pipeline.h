#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <osg/Group>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pick/pick_hit.h"
#include "scenegraph/pipeline/blend_limits.h"
#include "scenegraph/pipeline/point_stage.h"
#include "scenegraph/pipeline/post_chain.h"
#include "scenegraph/settings.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {
namespace gl {
class Output;
}

/// Who draws opaque points.
enum class PointWay : std::uint8_t { Auto, OpenGl, Cpu, Compute };

/// What a step of a picture came to.
enum class PictureStep : std::uint8_t {
  Whole,  ///< all is drawn: present() shows it
  More,   ///< there is more to be drawn
  Waits,  ///< the same, once somebody else has done his part (ViewPipeline::setWake)
  Busy,   ///< the same, once OpenGL has done its part, which nobody tells: some milliseconds
};

/// Draws a scene graph into targets of its own and, when asked, on to a framebuffer of somebody else.
///
/// The window and the headless renderer use this one class: an osgViewer embedded in the context that is current,
/// single threaded, with a context id of its own. The scene is drawn scene-linear into RGBA16F with a 32-bit float
/// reverse-Z depth buffer, then by the passes of the chain that was set, then by "present" (sRGB encoding) to the
/// output. What no pass needs is not made. All that reverse-Z needs is state of this class's camera: the graph itself
/// is exported to viewers with ordinary depth. Every call with a context current goes to the same thread.
class ViewPipeline {
 public:
  explicit ViewPipeline(const osg::ref_ptr<osg::Group>& root);
  /// Calls releaseGl() when it was not: the context must be current then.
  ~ViewPipeline();
  ViewPipeline(const ViewPipeline&) = delete;
  ViewPipeline& operator=(const ViewPipeline&) = delete;

  void setView(const CameraView& view);
  /// What is behind everything; opaque, its alpha is ignored.
  void setBackground(const Color& background);
  /// What happens between scene and present. A chain that differs from the one before in the values of uniforms alone
  /// costs nothing; any other makes targets and shaders anew.
  void setPostChain(PostChain chain);

  /// How far what is blended is put in order.
  void setBlendLimits(const BlendLimits& limits);

  /// How opaque points are drawn: by OpenGL as primitives, on the CPU, or by compute shaders; the picture is the same.
  /// Auto takes the CPU where OpenGL is itself software, compute shaders on a GPU where all points are small, and
  /// either only when the points are so many that it pays and no multisampling is asked for.
  void setPointWay(PointWay way);
  /// How many points a frame draws, where OpenGL does not draw them as primitives. At first there is no limit.
  void setPointLimits(const PointLimits& limits);
  /// Of the last render; nullopt: OpenGL drew the points, all of them.
  [[nodiscard]] const std::optional<PointProgress>& pointProgress() const noexcept;

  /// From now on, step() waits for nobody. Points that are drawn on the CPU are drawn on a thread of their own: step()
  /// says Waits, and `wake` is called, from any thread, when it may go on. Where OpenGL is software its threads draw a
  /// pass, and step() says Busy while they do. nullptr, as at first: step() does it, and waits.
  void setWake(std::function<void()> wake);

  /// Draws one frame and presents it in `output_fbo`, over the whole of it. Sizes in device pixels; 0 draws nothing.
  /// Errors: "TargetIncomplete", the driver cannot make targets of this size; "UnknownInput", a pass reads what nobody
  /// writes.
  std::expected<void, Status> render(std::uint32_t output_fbo, int width_px, int height_px);
  /// The same picture in steps, each of about `budget_ms` (of a wait for OpenGL, where it is software) and at most one
  /// drawable or pass more. View, points and background are those of the first step; another size, chain or render()
  /// begin anew. The scene must stay as it is meanwhile.
  std::expected<PictureStep, Status> step(std::uint32_t output_fbo, int width_px, int height_px, double budget_ms);
  static constexpr double kStepMs = 12.0;  ///< the budget in a window: other events wait no longer
  /// Presents what step() has drawn, over the whole of `output_fbo`. Does nothing before that.
  void present(std::uint32_t output_fbo);
  /// The same in an output of its size, in exchange for the one that was drawn aside where step() waits for nobody:
  /// nothing is drawn, and who reads it waits for nobody either.
  void present(std::unique_ptr<gl::Output>& output);
  /// The same without present, for readColor(): what a picture file holds is not rounded to bytes on the way.
  std::expected<void, Status> renderLinear(int width_px, int height_px);
  /// Rows of the last render, counted from the bottom, bottom row first, as OpenGL has them; waits for the GPU.
  /// Scene-linear, 4 a pixel, of the last pass before present. Empty before the first render and outside of it.
  [[nodiscard]] std::vector<float> readColor(int first_row, int rows) const;
  /// The same of the scene pass's reverse-Z depth, one a pixel, 0 where nothing was drawn.
  [[nodiscard]] std::vector<float> readDepth(int first_row, int rows) const;

  /// Names of what the last render ran, in order: "scene", post passes, "present".
  [[nodiscard]] const std::vector<std::string>& passes() const noexcept;
  /// Samples a pixel of the last render: 1, or what the chain asked for as far as the driver has them.
  [[nodiscard]] int samples() const noexcept;
  /// Bands that what is blended was drawn in by the last render: 0 when nothing was, 1 unless there was very much.
  [[nodiscard]] int blendedBands() const noexcept;
  /// The projection of the last render, for picking and for metres from depth.
  [[nodiscard]] const glm::dmat4& projectionMatrix() const noexcept;

  /// What the picture of the last render shows at a pixel, counted from the top left corner, and within `reach_px` of
  /// it, the best guess at what is meant first (inOrderOfMeaning). Draws those few pixels of the graph as it is now
  /// once more, into a target of its own that is made with the first call; the picture stays. Empty where there is
  /// nothing, outside of the picture, and before the first render. Leaves another framebuffer bound.
  [[nodiscard]] std::vector<PickHit> pick(int x_px, int y_px, int reach_px = kPickReachPx);
  static constexpr int kPickReachPx = 8;
  /// Makes the shaders that pick() needs for one of the things in sight. Returns whether any were missing: call it
  /// until there are none, an event each, and no pick takes long for its shaders. Leaves another framebuffer bound.
  [[nodiscard]] bool warmPick();
  /// Whether pick() has made its target yet.
  [[nodiscard]] bool hasPickTarget() const noexcept;

  /// Frees every GL object of this context id, those of the scene graph too. Idempotent; the next render starts anew
  /// (so a widget calls it when its context goes, and draws on in the next).
  void releaseGl();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stillframe::scenegraph
