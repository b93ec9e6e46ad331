#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <osg/ref_ptr>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderBin>
#include <utility>
#include <vector>

#include "scenegraph/pipeline/buffer_uploads.h"
#include "scenegraph/pipeline/first_uses.h"
#include "scenegraph/pipeline/texture_uploads.h"
#include "scenegraph/pipeline/transparency.h"

namespace stillframe::scenegraph {

/// Draws the scene pass in several goes, each as long as a budget, what was drawn before being left out.
///
/// A go ends with the drawable that uses its budget up, and before one that would, by what it took in the last picture:
/// it lasts as long as the budget, or as the one drawable that takes longer; where OpenGL is waited for, a large one
/// counts as several (DrawableSlice), and so does one with a large texture or array that is new to OpenGL
/// (TextureUploads, BufferUploads), or with a program that is (FirstUses): the go ends before that is linked, when it
/// is, and when it was drawn with. The scene is culled in each; as long as nothing changes in it meanwhile, all goes
/// together draw what one would have drawn, in the same order. What is blended is drawn in pieces of its own
/// (Transparency). Thread of the context only.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): OSG counts references
class SceneSteps : public osgUtil::RenderBin::DrawCallback {
 public:
  explicit SceneSteps(std::shared_ptr<FirstUses> first_uses) : first_uses_(std::move(first_uses)) {}

  /// A picture begins: nothing of it is drawn yet.
  void begin() { drawn_ = 0; }
  /// Of the next go, from now on. `waits`: OpenGL is waited for, as where it is software; else what was asked of it
  /// counts alone.
  void setBudget(double budget_ms, bool waits);
  /// Whether the last go came to the scene's end.
  [[nodiscard]] bool isDone() const noexcept { return !is_used_up_; }
  /// Whether it used a program for the first time, or ended before that: the step ends with it.
  [[nodiscard]] bool metNewProgram() const noexcept { return met_new_program_; }
  /// To be called when `cull` has been through the scene, and all else that takes over a bin has.
  void adopt(osgUtil::CullVisitor& cull);
  void drawImplementation(osgUtil::RenderBin* bin, osg::RenderInfo& render_info,
                          osgUtil::RenderLeaf*& previous) override;
  /// Leaves what is being uploaded. The context must be current.
  void release() {
    uploads_.drop();
    buffers_.drop();
  }

 protected:
  ~SceneSteps() override = default;

 private:
  void drawPieces(Transparency& blended, osgUtil::RenderBin& bin, osg::RenderInfo& render_info,
                  osgUtil::RenderLeaf*& previous);
  [[nodiscard]] bool isNext();
  [[nodiscard]] bool hasData(const osgUtil::RenderLeaf& leaf, bool has_indices, osg::RenderInfo& render_info);
  [[nodiscard]] bool hasMipmapCode(const osgUtil::RenderLeaf& leaf);
  template <typename Link>
  [[nodiscard]] bool isLinked(FirstUses::Is& program, const Link& link);
  [[nodiscard]] double& costOf(std::size_t drawable);
  void countDrawn();

  std::map<const osgUtil::RenderBin*, osg::ref_ptr<osgUtil::RenderBin::DrawCallback>> others_;
  std::shared_ptr<FirstUses> first_uses_;
  TextureUploads uploads_;
  BufferUploads buffers_;
  std::chrono::steady_clock::time_point start_;
  double budget_ms_ = std::numeric_limits<double>::infinity();
  bool waits_ = false;
  bool is_used_up_ = false;
  bool is_first_use_ = false;  // of a program, what is drawn next: the go ends with it
  bool met_new_program_ = false;
  bool has_uploaded_ = false;     // in this go
  double drawn_ms_ = 0.0;         // into the go, when the last drawable was done
  std::size_t drawn_ = 0;         // of the picture
  std::size_t seen_ = 0;          // in this go
  std::size_t begun_ = 0;         // of the picture, before this go
  std::vector<double> costs_ms_;  // of each drawable, when it was drawn last
};

}  // namespace stillframe::scenegraph
