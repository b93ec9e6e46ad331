#include "scenegraph/pipeline/transparency.h"

#include <algorithm>
#include <bit>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Scissor>
#include <osg/Viewport>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/drawable_slices.h"
#include "scenegraph/pipeline/full_screen.h"
#include "scenegraph/pipeline/gl_target.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kTransparentBin = 10;  // of osg::StateSet::TRANSPARENT_BIN
constexpr unsigned kDepthUnit = 7;   // of listed.glsl
constexpr std::uint32_t kListWidth = 2048;
constexpr std::uint32_t kFewestFragments = 1U << 18U;
constexpr auto kWins = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
constexpr auto kOff = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

/// What is collected writes neither colours nor depth.
osg::ref_ptr<osg::StateSet> makeCollecting(const osg::ref_ptr<osg::Texture>& depths, bool is_sampled) {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  state->setDefine("SF_LISTED", osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  if (is_sampled) {
    state->setDefine("SF_SAMPLED", osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  }
  state->setTextureAttribute(kDepthUnit, depths, kWins);
  state->setAttribute(new osg::ColorMask{false, false, false, false}, kWins);
  state->setAttribute(new osg::Depth{osg::Depth::GREATER, 0.0, 1.0, false}, kWins);
  state->setMode(GL_BLEND, kOff);
  return state;
}

/// Over everything, whatever state the last of the scene left.
osg::ref_ptr<osg::StateSet> makeLayingOver(int most_sorted) {
  namespace glsl = shaders::stillframe_render;
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  state->setAttributeAndModes(makeProgram("transparency", glsl::k_full_screen_vert, glsl::k_transparency_frag), kWins);
  state->setAttributeAndModes(new osg::BlendFunc{GL_ONE, GL_ONE_MINUS_SRC_ALPHA}, kWins);
  state->setAttributeAndModes(new osg::Depth{osg::Depth::ALWAYS, 0.0, 1.0, true}, kWins);
  state->setMode(GL_CULL_FACE, kOff);
  state->addUniform(new osg::Uniform{"u_most_sorted", most_sorted}, kWins);
  return state;
}

}  // namespace

Transparency::Transparency(int width_px, int height_px, int samples, const osg::ref_ptr<osg::Texture>& depths,
                           const BlendLimits& limits)
    : width_px_(width_px),
      height_px_(height_px),
      samples_(samples),
      most_fragments_(std::bit_ceil(std::max(limits.most_fragments, kListWidth))),
      collecting_(makeCollecting(depths, samples > 1)),
      laying_over_(makeFullScreenTriangle(makeLayingOver(limits.most_sorted))) {}

void Transparency::adopt(osgUtil::CullVisitor& cull) {
  auto& bins = cull.getCurrentRenderBin()->getRenderBinList();
  const auto found = bins.find(kTransparentBin);
  is_in_use_ = found != bins.end();
  if (!is_in_use_) {
    bands_ = 0;
    return;
  }
  for (auto flat = bins.upper_bound(0); flat != found; ++flat) {
    for (osgUtil::StateGraph* const graph : flat->second->getStateGraphList()) {
      found->second->addStateGraph(graph);
    }
    flat->second->getStateGraphList().clear();
  }
  found->second->setDrawCallback(this);
}

void Transparency::drawImplementation(osgUtil::RenderBin* bin, osg::RenderInfo& render_info,
                                      osgUtil::RenderLeaf*& previous) {
  start();
  while (!to_do_.empty()) {
    clearLists();
    collect(*bin, render_info, previous);
    endRows(render_info);
  }
}

std::vector<Transparency::Piece> Transparency::piecesOf(const osgUtil::RenderBin& bin, bool slices) {
  if (!bin.getRenderBinList().empty()) {  // of its own: they are drawn with it
    return {{}};
  }
  std::vector<Piece> pieces;
  const auto add = [&](osgUtil::RenderLeaf* leaf) {
    const std::size_t count = slices ? sliceCount(*leaf->_drawable) : 1;
    for (std::size_t slice = 0; slice < count; ++slice) {
      pieces.push_back({leaf, count == 1 ? std::nullopt : std::optional(slice)});
    }
  };
  for (osgUtil::RenderLeaf* const leaf : bin.getRenderLeafList()) {
    add(leaf);
  }
  for (const osgUtil::StateGraph* const graph : bin.getStateGraphList()) {
    for (const auto& leaf : graph->_leaves) {
      add(leaf.get());
    }
  }
  return pieces;
}

void Transparency::drawPiece(osgUtil::RenderBin& bin, std::span<const Piece> pieces, osg::RenderInfo& render_info,
                             osgUtil::RenderLeaf*& previous) {
  if (!is_begun_) {
    start();
  }
  ++pieces_;
  if (collected_ == pieces.size()) {
    endRows(render_info);
    collected_ = 0;
    return;
  }
  if (collected_ == 0) {
    clearLists();
  }
  const Piece& piece = pieces[collected_++];
  if (piece.leaf == nullptr) {
    collect(bin, render_info, previous);
    return;
  }
  const osg::ref_ptr<osgUtil::RenderBin> alone = new osgUtil::RenderBin;
  alone->getRenderLeafList().push_back(piece.leaf);
  const DrawableSlice slice(*piece.leaf->_drawable, piece.slice);
  collect(*alone, render_info, previous);
}

void Transparency::linkPiece(std::span<const Piece> pieces, osg::RenderInfo& render_info,
                             osgUtil::RenderLeaf*& previous) {
  if (!is_begun_) {
    start();
  }
  osgUtil::RenderLeaf* const leaf = nextLeaf(pieces);
  const osg::ref_ptr<osgUtil::RenderBin> alone = new osgUtil::RenderBin;
  alone->getRenderLeafList().push_back(leaf);
  const DrawsNothing nothing(*leaf->_drawable);
  collect(*alone, render_info, previous);
}

void Transparency::start() {
  makeLists();
  bands_ = 0;
  to_do_ = {{0, height_px_}};
  is_begun_ = true;
}

/// What was collected goes into the picture; where there was no room for it, its rows are to be collected anew.
void Transparency::endRows(osg::RenderInfo& render_info) {
  const Rows rows = to_do_.back();
  to_do_.pop_back();
  const std::uint32_t fragments = gl::readNumber(count_);
  if (fragments == 0) {
    return;
  }
  if (fragments > capacity_) {
    if (grow(fragments)) {
      to_do_.push_back(rows);
      return;
    }
    if (rows.count > 1) {
      to_do_.push_back({rows.first + rows.count / 2, rows.count - rows.count / 2});
      to_do_.push_back({rows.first, rows.count / 2});
      return;
    }
  }
  layOver(render_info, rows);
  ++bands_;
}

void Transparency::makeLists() {
  if (heads_ == 0) {
    heads_ = gl::makeNumbers(width_px_, height_px_, samples_, 1);
    count_ = gl::makeNumbers(1, 1, 0, 1);
    grow(kFewestFragments);
  }
}

/// False when there is room for no more than there is.
bool Transparency::grow(std::uint32_t fragments) {
  const std::uint32_t wanted = std::min(std::bit_ceil(fragments), most_fragments_);
  if (wanted <= capacity_) {
    return false;
  }
  const std::uint32_t made = gl::makeNumbers(static_cast<int>(kListWidth), static_cast<int>(wanted / kListWidth), 0, 4);
  if (made == 0) {
    return false;
  }
  if (fragments_ != 0) {
    gl::deleteTexture(fragments_);
  }
  fragments_ = made;
  capacity_ = wanted;
  return true;
}

void Transparency::clearLists() {
  gl::clearNumbers(heads_);
  gl::clearNumbers(count_);
}

void Transparency::collect(osgUtil::RenderBin& bin, osg::RenderInfo& render_info, osgUtil::RenderLeaf*& previous) {
  const Rows& rows = to_do_.back();
  gl::bindNumbers(0, heads_, 1);
  gl::bindNumbers(1, count_, 1);
  gl::bindNumbers(2, fragments_, 4);
  gl::finishTargets();
  collecting_->setAttributeAndModes(new osg::Scissor{0, rows.first, width_px_, rows.count}, kWins);
  bin.setStateSet(collecting_);
  bin.drawImplementation(render_info, previous);
  gl::finishImages();
}

void Transparency::layOver(osg::RenderInfo& render_info, const Rows& rows) {
  osg::State& state = *render_info.getState();
  osg::StateSet& own = *laying_over_->getStateSet();
  own.setAttributeAndModes(new osg::Scissor{0, rows.first, width_px_, rows.count}, kWins);
  // Of a go that draws nothing else no camera's state is in force, and OSG's own viewport is 800 x 600.
  own.setAttributeAndModes(new osg::Viewport(0, 0, width_px_, height_px_), kWins);
  state.pushStateSet(&own);
  state.apply();
  laying_over_->draw(render_info);
  state.popStateSet();
  gl::finishImages();
}

void Transparency::release(osg::State& state) {
  laying_over_->releaseGLObjects(&state);
  for (std::uint32_t* const texture : {&heads_, &count_, &fragments_}) {
    if (*texture != 0) {
      gl::deleteTexture(*texture);
      *texture = 0;
    }
  }
  capacity_ = 0;
}

}  // namespace stillframe::scenegraph
