#include "nodes/lines/line_arrays.h"

#include <cmath>

#include "nodes/points/channel.h"

namespace stillframe::nodes {
namespace {

/// Flags of a point, as the shader knows them.
constexpr unsigned kDrawn = 1;  // the segment that ends here is drawn
constexpr unsigned kRound = 2;  // a joint: the line goes on around this point
constexpr unsigned kStyleStep = 4;
/// What a float tells apart, with the flags.
constexpr std::size_t kMostStyles = (std::size_t{1} << 24U) / kStyleStep;

}  // namespace

std::size_t LineArrays::byteSize() const {
  const std::size_t count = points.valid() ? points->size() : 0;
  return sizeof(*this) + count * (sizeof(osg::Vec4) + (colors.valid() ? 4U : 0U) + (values.valid() ? 4U : 0U)) +
         (styles.valid() ? styles->size() * sizeof(osg::Vec4) : 0U);
}

void LineArrays::releaseGlObjects() const {
  for (const osg::Array* const array : {static_cast<const osg::Array*>(points), static_cast<const osg::Array*>(colors),
                                        static_cast<const osg::Array*>(values)}) {
    if (array != nullptr) {
      array->releaseGLObjects();
    }
  }
}

LineBuilder::LineBuilder(const glm::dvec3& origin, Channel channel) : origin_(origin), channel_(channel) {
  (void)take();
}

void LineBuilder::reserve(std::size_t points) {
  arrays_.points->reserve(points);
  if (arrays_.colors.valid()) {
    arrays_.colors->reserve(points);
  }
  if (arrays_.values.valid()) {
    arrays_.values->reserve(points);
  }
}

void LineBuilder::begin(Kind kind, const LineStyle& style) {
  kind_ = kind;
  added_ = 0;
  is_connected_ = false;
  is_first_drawn_ = false;
  const auto [found, is_new] = styles_.try_emplace({style.width, style.in_metres}, arrays_.styles->size());
  if (is_new && found->second < kMostStyles) {
    arrays_.styles->push_back(styleTexel(style));
  } else if (is_new) {
    found->second = kMostStyles - 1;
  }
  style_ = found->second;
}

void LineBuilder::add(const glm::dvec3& point, const osg::Vec4ub& color, float value) {
  const glm::dvec3 local = point - origin_;
  const std::size_t place = added_++;
  const bool is_finite = std::isfinite(local.x) && std::isfinite(local.y) && std::isfinite(local.z);
  const bool is_near =
      is_finite && std::abs(local.x) <= kReach && std::abs(local.y) <= kReach && std::abs(local.z) <= kReach;
  arrays_.not_finite += is_finite ? 0U : 1U;
  arrays_.out_of_reach += is_finite && !is_near ? 1U : 0U;
  if (!is_near) {
    breakLine();
    return;
  }
  const Point here{osg::Vec3(osg::Vec3d(local.x, local.y, local.z)), color,
                   std::isfinite(value) && value > kMissingValue ? value : kMissingValue};
  if (kind_ == Kind::List) {
    if (place % 2 == 0) {
      pending_ = here;
      is_connected_ = true;
    } else if (is_connected_) {
      is_connected_ = false;
      if (here.place != pending_.place) {
        push(pending_, 0);
        push(here, kDrawn);
      }
    }
    return;
  }
  if (is_connected_) {
    const osg::Vec4& last = arrays_.points->back();
    if (osg::Vec3(last.x(), last.y(), last.z()) == here.place) {
      return;
    }
  }
  if (place == 0) {
    first_ = here;
    first_index_ = arrays_.points->size();
    is_first_drawn_ = true;
  }
  push(here, is_connected_ ? kDrawn | kRound : 0);
  is_connected_ = true;
}

/// The line ends at the last point, which is no joint any more.
void LineBuilder::breakLine() {
  if (is_connected_ && kind_ != Kind::List && !arrays_.points->empty()) {
    float& flags = arrays_.points->back().w();
    const auto all = static_cast<unsigned>(flags);
    flags = static_cast<float>(all & ~kRound);
  }
  is_connected_ = false;
}

void LineBuilder::end() {
  if (kind_ == Kind::List || !is_connected_) {
    breakLine();
    return;
  }
  const osg::Vec4 last = arrays_.points->back();
  const bool ends_at_first = is_first_drawn_ && osg::Vec3(last.x(), last.y(), last.z()) == first_.place &&
                             arrays_.points->size() - first_index_ > (kind_ == Kind::Loop ? 2U : 3U);
  const bool closes = kind_ == Kind::Loop && is_first_drawn_ && arrays_.points->size() - first_index_ > 1;
  if (closes && !ends_at_first) {
    push(first_, kDrawn | kRound);
  }
  if (closes || ends_at_first) {
    float& flags = (*arrays_.points)[first_index_].w();
    flags = static_cast<float>(static_cast<unsigned>(flags) | kRound);
    is_connected_ = false;
    return;
  }
  breakLine();
}

void LineBuilder::push(const Point& point, unsigned flags) {
  arrays_.points->push_back({point.place, static_cast<float>(kStyleStep * style_ + flags)});
  if (arrays_.colors.valid()) {
    arrays_.colors->push_back(point.color);
  }
  if (arrays_.values.valid()) {
    arrays_.values->push_back(point.value);
  }
  if ((flags & kDrawn) != 0) {
    ++arrays_.segments;
    const osg::Vec4& before = (*arrays_.points)[arrays_.points->size() - 2];
    arrays_.box.expandBy(osg::Vec3d(before.x(), before.y(), before.z()));
    arrays_.box.expandBy(osg::Vec3d(point.place));
  }
}

LineArrays LineBuilder::take() {
  LineArrays done = std::move(arrays_);
  arrays_ = {};
  arrays_.points = new osg::Vec4Array;
  arrays_.styles = new osg::Vec4Array;
  if (channel_ == Channel::Colors) {
    arrays_.colors = new osg::Vec4ubArray;
  } else if (channel_ == Channel::Values) {
    arrays_.values = new osg::FloatArray;
  }
  styles_.clear();
  return done;
}

}  // namespace stillframe::nodes
