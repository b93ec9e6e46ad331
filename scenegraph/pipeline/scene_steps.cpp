#include "scenegraph/pipeline/scene_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenegraph/pipeline/drawable_slices.h"
#include "scenegraph/pipeline/gl_target.h"
#include "scenegraph/stopwatch.h"

namespace stillframe::scenegraph {

namespace {

void linkOnly(osgUtil::RenderLeaf& leaf, osg::RenderInfo& render_info, osgUtil::RenderLeaf*& previous) {
  const DrawsNothing nothing(*leaf._drawable);
  leaf.render(render_info, previous);
  previous = &leaf;
}

}  // namespace

void SceneSteps::setBudget(double budget_ms, bool waits) {
  start_ = std::chrono::steady_clock::now();
  budget_ms_ = budget_ms;
  waits_ = waits;
  is_used_up_ = false;
  is_first_use_ = false;
  met_new_program_ = false;
  has_uploaded_ = false;
  seen_ = 0;
  begun_ = drawn_;
  drawn_ms_ = 0.0;
}

void SceneSteps::adopt(osgUtil::CullVisitor& cull) {
  others_.clear();
  if (!std::isfinite(budget_ms_)) {
    buffers_.drop();
    return;
  }
  // What is in no bin is drawn by the stage itself, which has no callback for it: it goes into the first one.
  osgUtil::RenderBin& stage = *cull.getCurrentRenderBin();
  osgUtil::RenderBin& first = *stage.find_or_insert(0, "RenderBin");
  first.getStateGraphList().insert(first.getStateGraphList().begin(), stage.getStateGraphList().begin(),
                                   stage.getStateGraphList().end());
  stage.getStateGraphList().clear();
  for (const auto& [number, bin] : stage.getRenderBinList()) {
    others_[bin] = bin->getDrawCallback();
    bin->setDrawCallback(this);
  }
}

double& SceneSteps::costOf(std::size_t drawable) {
  costs_ms_.resize(std::max(costs_ms_.size(), drawable + 1));
  return costs_ms_[drawable];
}

bool SceneSteps::isNext() {
  const std::size_t index = seen_++;
  if (index < drawn_ || is_used_up_) {
    return false;
  }
  is_used_up_ = drawn_ > begun_ && millisecondsSince(start_) + costOf(index) > budget_ms_;
  return !is_used_up_;
}

/// False when the go ends before all are there: the next goes on with them.
bool SceneSteps::hasData(const osgUtil::RenderLeaf& leaf, bool has_indices, osg::RenderInfo& render_info) {
  if (std::isfinite(budget_ms_)) {
    const auto is_time_up = [this] {
      has_uploaded_ = true;
      return millisecondsSince(start_) > budget_ms_;
    };
    osg::State& state = *render_info.getState();
    is_used_up_ = !uploads_.bring(*leaf._parent, state, is_time_up) ||
                  (waits_ && !buffers_.bring(leaf, has_indices, state, is_time_up));
  }
  return !is_used_up_;
}

/// False when the go ends: before code for mipmaps is made, unless that is the first thing of it, and then after it.
bool SceneSteps::hasMipmapCode(const osgUtil::RenderLeaf& leaf) {
  const osg::Texture2D* const texture =
      std::isfinite(budget_ms_) && waits_ ? first_uses_->mipmaps().missingFor(leaf) : nullptr;
  if (texture == nullptr) {
    return true;
  }
  is_used_up_ = met_new_program_ = true;
  if (drawn_ == begun_ && !has_uploaded_) {
    first_uses_->mipmaps().make(*texture);
  }
  return false;
}

/// False when the go ends: before `program` is linked, unless that is the first thing of it, and then after it.
template <typename Link>
bool SceneSteps::isLinked(FirstUses::Is& program, const Link& link) {
  using enum FirstUses::Is;
  if (!std::isfinite(budget_ms_) || !waits_ || program == Used) {
    return true;
  }
  met_new_program_ = true;
  if (program == Linked) {
    program = Used;
    is_first_use_ = true;
    return true;
  }
  is_used_up_ = true;
  if (drawn_ == begun_ && !has_uploaded_) {
    link();
    program = Linked;
  }
  return false;
}

void SceneSteps::countDrawn() {
  if (waits_) {
    gl::finish();
  }
  const double now_ms = millisecondsSince(start_);
  costOf(drawn_++) = now_ms - std::exchange(drawn_ms_, now_ms);
  is_used_up_ = now_ms > budget_ms_ || std::exchange(is_first_use_, false);
}

/// How many there are turns out with the last one.
void SceneSteps::drawPieces(Transparency& blended, osgUtil::RenderBin& bin, osg::RenderInfo& render_info,
                            osgUtil::RenderLeaf*& previous) {
  seen_ += blended.pieces();
  const auto pieces = Transparency::piecesOf(bin, waits_);
  while (!blended.isDone() && isNext()) {
    const osgUtil::RenderLeaf* const leaf = blended.nextLeaf(pieces);
    const bool lays_over = leaf == nullptr && !pieces.empty() && pieces.front().leaf != nullptr;
    if (leaf != nullptr && (!hasMipmapCode(*leaf) || !hasData(*leaf, sliceCount(*leaf->_drawable) == 1, render_info))) {
      return;
    }
    if (leaf != nullptr &&
        !isLinked(first_uses_->of(*leaf, true), [&] { blended.linkPiece(pieces, render_info, previous); })) {
      return;
    }
    if (lays_over && !isLinked(first_uses_->ofLayingOver(), [] {})) {
      return;
    }
    blended.drawPiece(bin, pieces, render_info, previous);
    countDrawn();
  }
}

void SceneSteps::drawImplementation(osgUtil::RenderBin* bin, osg::RenderInfo& render_info,
                                    osgUtil::RenderLeaf*& previous) {
  const auto other = others_.find(bin);
  const bool is_taken = other != others_.end() && other->second != nullptr;
  if (is_taken || bin->getStateSet() != nullptr || !bin->getRenderBinList().empty()) {
    if (auto* const blended = is_taken ? dynamic_cast<Transparency*>(other->second.get()) : nullptr) {
      drawPieces(*blended, *bin, render_info, previous);
      return;
    }
    if (!isNext()) {
      return;
    }
    if (is_taken) {
      other->second->drawImplementation(bin, render_info, previous);
    } else {
      bin->drawImplementation(render_info, previous);
    }
    countDrawn();
    return;
  }
  const auto draw = [&](osgUtil::RenderLeaf* leaf) {
    const std::size_t slices = waits_ ? sliceCount(*leaf->_drawable) : 1;
    for (std::size_t slice = 0; slice < slices; ++slice) {
      if (!isNext() || !hasMipmapCode(*leaf) || !hasData(*leaf, slices == 1, render_info) ||
          !isLinked(first_uses_->of(*leaf, false), [&] { linkOnly(*leaf, render_info, previous); })) {
        continue;
      }
      const DrawableSlice alone(*leaf->_drawable, slices == 1 ? std::nullopt : std::optional(slice));
      leaf->render(render_info, previous);
      previous = leaf;
      countDrawn();
    }
  };
  for (osgUtil::RenderLeaf* const leaf : bin->getRenderLeafList()) {
    draw(leaf);
  }
  for (osgUtil::StateGraph* const graph : bin->getStateGraphList()) {
    for (const auto& leaf : graph->_leaves) {
      draw(leaf.get());
    }
  }
}

}  // namespace stillframe::scenegraph
