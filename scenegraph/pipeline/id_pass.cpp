#include "scenegraph/pipeline/id_pass.h"

#include <algorithm>
#include <osg/BoundingBox>
#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Transform>
#include <osg/Viewport>
#include <osgText/Text>
#include <tuple>

#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/drawable_slices.h"
#include "scenegraph/pipeline/id_program.h"
#include "scenegraph/pipeline/id_rays.h"
#include "scenegraph/pipeline/triangle_boxes.h"

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kMostPrograms = 64;
constexpr double kWidestPointPx = 130.0;  // half of the widest, and some

/// The program that a drawable is drawn with, by OSG's rules of inheritance.
const osg::Program* programOf(const osg::NodePath& path) {
  const osg::StateAttribute* found = nullptr;
  bool is_overridden = false;
  for (const osg::Node* const node : path) {
    const osg::StateSet* const state = node->getStateSet();
    const auto* const pair = state == nullptr ? nullptr : state->getAttributePair(osg::StateAttribute::PROGRAM);
    if (pair != nullptr && (!is_overridden || (pair->second & osg::StateAttribute::PROTECTED) != 0)) {
      found = pair->first;
      is_overridden = (pair->second & osg::StateAttribute::OVERRIDE) != 0;
    }
  }
  return dynamic_cast<const osg::Program*>(found);
}

/// What is drawn over everything else comes last.
bool isOnTop(const osg::NodePath& path) {
  return std::ranges::any_of(path, [](const osg::Node* node) {
    const osg::StateSet* const state = node->getStateSet();
    const auto mode = state == nullptr ? osg::StateAttribute::GLModeValue{osg::StateAttribute::INHERIT}
                                       : state->getMode(GL_DEPTH_TEST);
    return mode != osg::StateAttribute::INHERIT && (mode & osg::StateAttribute::ON) == 0;
  });
}

bool hasMode(const osg::Drawable& drawable, std::initializer_list<GLenum> modes) {
  const osg::Geometry* const geometry = drawable.asGeometry();
  return geometry != nullptr && geometry->getNumPrimitiveSets() > 0 &&
         std::ranges::find(modes, geometry->getPrimitiveSet(0)->getMode()) != modes.end();
}

bool isLine(const osg::Drawable& drawable, const osg::Program* program) {
  return hasMode(drawable, {GL_LINES, GL_LINE_STRIP, GL_LINE_LOOP}) ||
         (program != nullptr && program->getName() == "polyline");
}

/// Whether nothing of a box can fall within `margin_px` of the window, by the planes that bound it.
bool isOutside(const osg::BoundingBox& box, const osg::Matrixd& clip_from_local, const IdPass::View& view,
               double margin_px) {
  if (!box.valid()) {
    return false;
  }
  const double reach = view.reach_px + 1.0 + margin_px;
  const double left = 2.0 * (view.x_px + 0.5 - reach) / view.width_px - 1.0;
  const double right = 2.0 * (view.x_px + 0.5 + reach) / view.width_px - 1.0;
  const double bottom = 2.0 * (view.y_px + 0.5 - reach) / view.height_px - 1.0;
  const double top = 2.0 * (view.y_px + 0.5 + reach) / view.height_px - 1.0;
  unsigned outside = 0x1fU;
  for (unsigned i = 0; i < 8 && outside != 0; ++i) {
    const osg::Vec4d at = osg::Vec4d(osg::Vec3d(box.corner(i)), 1.0) * clip_from_local;
    unsigned beyond = at.w() <= 0.0 ? 16U : 0U;
    beyond |= at.x() < left * at.w() ? 1U : 0U;
    beyond |= at.x() > right * at.w() ? 2U : 0U;
    beyond |= at.y() < bottom * at.w() ? 4U : 0U;
    beyond |= at.y() > top * at.w() ? 8U : 0U;
    outside &= beyond;
  }
  return outside != 0;
}

std::vector<std::uint32_t> runsWithin(std::span<const osg::BoundingBox> boxes, const osg::Matrixd& clip_from_local,
                                      const IdPass::View& view) {
  std::vector<std::uint32_t> runs;
  for (std::size_t run = 0; run < boxes.size(); ++run) {
    if (!isOutside(boxes[run], clip_from_local, view, 0.0)) {
      runs.push_back(static_cast<std::uint32_t>(run));
    }
  }
  return runs;
}

class DrawableCollector : public osg::NodeVisitor {
 public:
  DrawableCollector(const IdPass::View& view, bool with_points, std::vector<IdDrawable>& found)
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), view_(view), eye_from_here_(view.eye_from_fixed), found_(found) {
    setTraversalMask(with_points ? ~kReference : ~(kReference | kOpaquePoints));
  }

  void apply(osg::Transform& transform) override {
    const osg::Matrixd outside = eye_from_here_;
    transform.computeLocalToWorldMatrix(eye_from_here_, this);
    traverse(transform);
    eye_from_here_ = outside;
  }
  void apply(osg::Drawable& drawable) override {
    const osg::Program* const program = programOf(getNodePath());
    const bool is_point = hasMode(drawable, {GL_POINTS});
    const bool is_line = isLine(drawable, program);
    // The size of a wide line on the screen is the shader's affair.
    if (drawable.isCullingActive() && !is_line &&
        isOutside(drawable.getBoundingBox(), eye_from_here_ * view_.clip_from_eye, view_,
                  is_point ? kWidestPointPx : 0.0)) {
      return;
    }
    found_.push_back({getNodePath(), eye_from_here_, is_point || is_line});
  }

 private:
  const IdPass::View& view_;
  osg::Matrixd eye_from_here_;
  std::vector<IdDrawable>& found_;
};

}  // namespace

void IdPass::collect(osg::Group& root, const View& view, bool with_points) {
  drawables_.clear();
  DrawableCollector collector(view, with_points, drawables_);
  root.accept(collector);
  std::ranges::stable_partition(drawables_, [](const IdDrawable& one) { return !isOnTop(one.path); });
  std::ranges::stable_partition(drawables_,
                                [](const IdDrawable& one) { return rayTargetOf(*one.path.back()) == nullptr; });
}

std::size_t IdPass::drawnCount() const {
  const auto first =
      std::ranges::find_if(drawables_, [](const IdDrawable& one) { return rayTargetOf(*one.path.back()) != nullptr; });
  return static_cast<std::size_t>(first - drawables_.begin());
}

void IdPass::castRays(const View& view, std::size_t first, std::vector<gl::IdTarget::Id>& ids,
                      std::vector<float>& depths) const {
  const int side = 2 * view.reach_px + 1;
  for (std::size_t i = first; i < drawables_.size(); ++i) {
    const IdDrawable& one = drawables_[i];
    const IdRays rays(*rayTargetOf(*one.path.back()), one.eye_from_local, view.clip_from_eye, view.width_px,
                      view.height_px);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const auto place = static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
        if (ids[place][0] != 0 && isOnTop(drawables_[ids[place][0] - 1].path)) {
          continue;
        }
        const auto met = rays.at(view.x_px + x - view.reach_px, view.y_px + y - view.reach_px);
        if (met && met->depth > depths[place]) {
          ids[place] = {static_cast<std::uint32_t>(i + 1), met->instance, 0, 0};
          depths[place] = met->depth;
        }
      }
    }
  }
}

const IdPass::Derived& IdPass::derive(const osg::Program* program) {
  Derived& derived = derived_[program];
  if (derived.state == nullptr) {
    derived.of = program;
    derived.program = program == nullptr ? nullptr : makeIdProgram(*program);
    if (derived.program == nullptr) {
      derived.program = makePlainIdProgram();
    }
    derived.state = new osg::StateSet;
    derived.state->setAttributeAndModes(
        derived.program, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED);
  }
  return derived;
}

void IdPass::makeState(const View& view) {
  using osg::StateAttribute;
  constexpr auto kAlways = StateAttribute::OVERRIDE | StateAttribute::PROTECTED;
  if (base_ == nullptr) {
    base_ = new osg::StateSet;
    base_->setAttribute(new osg::ClipControl{osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE});
    base_->setAttribute(new osg::Depth{osg::Depth::GREATER, 0.0, 1.0, true}, kAlways);
    base_->setMode(GL_DEPTH_TEST, StateAttribute::ON);
    base_->setMode(GL_BLEND, StateAttribute::OFF | kAlways);
    drawable_ = new osg::Uniform(osg::Uniform::UNSIGNED_INT, "u_id_drawable");
    is_point_ = new osg::Uniform("u_id_is_point", false);
    base_->addUniform(drawable_);
    base_->addUniform(is_point_);
  }
  const auto width = static_cast<float>(view.width_px);
  const auto height = static_cast<float>(view.height_px);
  const auto reach = static_cast<float>(view.reach_px) + 1.0F;
  const float x = static_cast<float>(view.x_px) + 0.5F;
  const float y = static_cast<float>(view.y_px) + 0.5F;
  base_->setAttribute(
      new osg::Viewport(view.reach_px - view.x_px, view.reach_px - view.y_px, view.width_px, view.height_px), kAlways);
  base_->getOrCreateUniform("u_viewport_height_px", osg::Uniform::FLOAT)->set(height);
  base_->getOrCreateUniform("u_id_window", osg::Uniform::FLOAT_VEC4)
      ->set(osg::Vec4(2.0F * (x - reach) / width - 1.0F, 2.0F * (y - reach) / height - 1.0F,
                      2.0F * (x + reach) / width - 1.0F, 2.0F * (y + reach) / height - 1.0F));
  base_->getOrCreateUniform("u_id_pixel", osg::Uniform::FLOAT_VEC2)->set(osg::Vec2(2.0F / width, 2.0F / height));
}

void IdPass::drawGl(const View& view, osg::RenderInfo& info) {
  osg::State& state = *info.getState();
  if (derived_.size() > kMostPrograms) {
    derived_.clear();
  }
  state.applyProjectionMatrix(new osg::RefMatrix(view.clip_from_eye));
  std::uint32_t number = 0;
  runs_.clear();
  for (const IdDrawable& one : std::span(drawables_).first(drawnCount())) {
    drawOne(one, view, ++number, info);
  }
  state.popAllStateSets();
  state.apply();
}

void IdPass::drawOne(const IdDrawable& one, const View& view, std::uint32_t number, osg::RenderInfo& info) {
  osg::State& state = *info.getState();
  auto& drawable = const_cast<osg::Drawable&>(*one.path.back()->asDrawable());
  const Derived& derived = derive(programOf(one.path));
  drawable_->set(number);
  is_point_->set(hasMode(drawable, {GL_POINTS}));
  state.pushStateSet(base_);
  for (const osg::Node* const node : one.path) {
    if (node->getStateSet() != nullptr) {
      state.pushStateSet(node->getStateSet());
    }
  }
  state.pushStateSet(derived.state);
  state.applyModelViewMatrix(new osg::RefMatrix(one.eye_from_local));
  state.apply();
  // A text sets the depth mask itself, whatever the state says.
  auto* const text = dynamic_cast<osgText::Text*>(&drawable);
  if (text != nullptr && !text->getEnableDepthWrites()) {
    text->setEnableDepthWrites(true);
    drawable.draw(info);
    text->setEnableDepthWrites(false);
  } else if (const auto [triangles, boxes] = triangleBoxesOf(drawable); triangles != nullptr) {
    std::vector<std::uint32_t>& runs = runs_[number];
    runs = runsWithin(boxes, one.eye_from_local * view.clip_from_eye, view);
    if (!runs.empty()) {
      const SomeTriangles some(*drawable.asGeometry(), *triangles, runs);
      drawable.draw(info);
    }
  } else {
    drawable.draw(info);
  }
  state.popStateSetStackToSize(0);
}

bool IdPass::warm(osg::Group& root, const View& view, osg::RenderInfo& info, bool with_points) {
  View all = view;
  all.reach_px = std::max(view.width_px, view.height_px);
  collect(root, all, with_points);
  const auto drawn = std::span(drawables_).first(drawnCount());
  const auto cold =
      std::ranges::find_if(drawn, [this](const IdDrawable& one) { return !derived_.contains(programOf(one.path)); });
  if (cold == drawn.end() || derived_.size() >= kMostPrograms) {
    return false;
  }
  makeState(view);
  if (!target_.begin(2 * view.reach_px + 1)) {
    return false;
  }
  osg::State& state = *info.getState();
  state.applyProjectionMatrix(new osg::RefMatrix(view.clip_from_eye));
  {
    const DrawableSlice few(const_cast<osg::Drawable&>(*cold->path.back()->asDrawable()), 0);
    drawOne(*cold, all, 1, info);
  }
  state.popAllStateSets();
  state.apply();
  return true;
}

std::optional<std::vector<IdSample>> IdPass::draw(osg::Group& root, const View& view, osg::RenderInfo& info,
                                                  const std::optional<CpuPoints>& points) {
  collect(root, view, !points.has_value());
  const int side = 2 * view.reach_px + 1;
  const auto at = [side](int dx, int dy, int reach) {
    const int place = (dy + reach) * side + dx + reach;
    return static_cast<std::size_t>(place);
  };
  std::vector<gl::IdTarget::Id> ids(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  std::vector<float> depths(ids.size(), 0.0F);
  const std::size_t drawn = drawnCount();
  if (drawn > 0) {
    makeState(view);
    if (!target_.begin(side)) {
      return std::nullopt;
    }
    drawGl(view, info);
    target_.read(ids, depths);
    for (auto& [number, instance, primitive, vertex] : ids) {
      if (const auto drawn_runs = runs_.find(number); drawn_runs != runs_.end()) {
        constexpr std::uint32_t kRun = TriangleBoxes::kTriangles;
        primitive = drawn_runs->second[primitive / kRun] * kRun + primitive % kRun;
      }
    }
  }
  castRays(view, drawn, ids, depths);
  const std::size_t first_cloud = drawables_.size();
  std::vector<std::uint32_t> ends;  // of the clouds' points, in their numbers
  if (points) {
    for (std::size_t i = 0; i < points->points.batches.size(); ++i) {
      drawables_.push_back({points->points.paths[i], {}, true});
      ends.push_back((ends.empty() ? 0U : ends.back()) + static_cast<std::uint32_t>(points->points.batches[i].count()));
    }
  }
  std::vector<IdSample> samples;
  for (int dy = -view.reach_px; dy <= view.reach_px; ++dy) {
    for (int dx = -view.reach_px; dx <= view.reach_px; ++dx) {
      const int x = view.x_px + dx;
      const int y = view.y_px + dy;
      if (dx * dx + dy * dy > view.reach_px * view.reach_px || x < 0 || y < 0 || x >= view.width_px ||
          y >= view.height_px) {
        continue;
      }
      const std::size_t place = at(dx, dy, view.reach_px);
      const auto& [number, instance, primitive, vertex] = ids[place];
      const std::uint64_t key =
          points ? points->keys[static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width_px) +
                                static_cast<std::size_t>(x)]
                 : 0U;
      // Points are drawn first, and what is as near does not cover them.
      if (key != 0 && (number == 0 || PointKey::depth(key) >= depths[place])) {
        const std::uint32_t point = PointKey::point(key);
        const auto cloud = static_cast<std::size_t>(std::ranges::upper_bound(ends, point) - ends.begin());
        const std::uint32_t begin = cloud == 0 ? 0U : ends[cloud - 1];
        samples.push_back({dx, dy, static_cast<std::uint32_t>(first_cloud + cloud), 0, point - begin, point - begin,
                           PointKey::depth(key)});
      } else if (number != 0) {
        samples.push_back({dx, dy, number - 1, instance, primitive, vertex, depths[place]});
      }
    }
  }
  return samples;
}

void IdPass::release(osg::State& state) {
  target_.release();
  for (const auto& [of, derived] : derived_) {
    derived.program->releaseGLObjects(&state);
  }
  derived_.clear();
  drawables_.clear();
  base_ = nullptr;
}

std::vector<IdSample> inOrderOfMeaning(std::vector<IdSample> samples, std::span<const IdDrawable> drawables) {
  const auto own = std::ranges::find_if(samples, [](const IdSample& one) { return one.dx == 0 && one.dy == 0; });
  // How far behind the cursor's surface reaches, within the few pixels.
  const bool has_own = own != samples.end();
  float farthest = 0.0F;
  if (has_own) {
    farthest = own->depth;
    for (const IdSample& one : samples) {
      farthest = one.drawable == own->drawable ? std::min(farthest, one.depth) : farthest;
    }
  }
  const auto rank = [&](const IdSample& one) {
    const bool is_own = one.dx == 0 && one.dy == 0;
    const bool is_thin = drawables[one.drawable].is_thin;
    const bool is_meant = is_own || (is_thin && (!has_own || one.depth >= farthest));
    const bool is_aimed = is_thin && is_meant;
    const int kind = is_aimed ? 0 : is_own ? 1 : 2;
    // Without a surface under the cursor whatever is nearest is meant.
    return std::tuple(has_own ? kind : 0, one.dx * one.dx + one.dy * one.dy, is_thin ? 0 : 1, -one.depth, one.dy,
                      one.dx);
  };
  std::ranges::sort(samples, {}, rank);
  return samples;
}

}  // namespace stillframe::scenegraph
