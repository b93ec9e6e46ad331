#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Vec4>
#include <osg/ref_ptr>
#include <utility>

namespace stillframe::nodes {

/// Thickness of a line.
struct LineStyle {
  double width = 2.0;
  bool in_metres = false;  ///< else in pixels; never drawn thinner than one pixel

  friend bool operator==(const LineStyle&, const LineStyle&) = default;
};

/// As it is uploaded: width, 1 when in metres, 0, 0.
[[nodiscard]] inline osg::Vec4 styleTexel(const LineStyle& style) {
  return {static_cast<float>(style.width), style.in_metres ? 1.0F : 0.0F, 0.0F, 0.0F};
}

/// Lines as they are uploaded: any number of strips, loops and lists of segments, drawn in one call by LineDrawable.
struct LineArrays {
  osg::ref_ptr<osg::Vec4Array> points;    ///< x, y, z less the origin; w = 4 * style + flags (line_arrays.cpp)
  osg::ref_ptr<osg::Vec4ubArray> colors;  ///< sRGB bytes and alpha of each point; null: one colour for all
  osg::ref_ptr<osg::FloatArray> values;   ///< of each point, for colouring by value; null: none
  osg::ref_ptr<osg::Vec4Array> styles;    ///< styleTexel() of each, in order of first use
  osg::BoundingBoxd box;                  ///< of what is drawn, less the origin
  std::size_t segments = 0;
  std::size_t not_finite = 0;    ///< points with a NaN or infinite coordinate: the line is broken there
  std::size_t out_of_reach = 0;  ///< points farther than LineBuilder::kReach from the origin: the same

  [[nodiscard]] std::size_t byteSize() const;
  /// Frees what is on the GPU, in every context. GUI thread.
  void releaseGlObjects() const;
};

/// Collects lines on any thread, one strip after the other.
///
/// ```cpp
/// LineBuilder lines(origin, LineBuilder::Channel::None);
/// lines.begin(LineBuilder::Kind::Strip, {.width = 3.0});
/// for (const auto& point : points) { lines.add(point); }
/// lines.end();
/// drawable.set(lines.take());
/// ```
/// Points are taken relative to `origin` in double, which goes to the matrix above: lines on the far side of the earth
/// keep their millimetres. A point that follows an equal one is left out; 16 bytes a point, 4 more with a channel.
class LineBuilder {
 public:
  /// What each point carries besides its place.
  enum class Channel : std::uint8_t { None, Colors, Values };
  enum class Kind : std::uint8_t {
    Strip,  ///< through all points
    Loop,   ///< and back to the first
    List,   ///< from the first to the second, from the third to the fourth...
  };
  /// Coordinates beyond this (m) would overflow the float arithmetic of bounds and culling.
  static constexpr double kReach = 1e15;

  explicit LineBuilder(const glm::dvec3& origin = glm::dvec3(0.0), Channel channel = Channel::None);

  void reserve(std::size_t points);
  void begin(Kind kind, const LineStyle& style = {});
  /// `color` counts with Channel::Colors, `value` with Channel::Values; a NaN value is drawn as missing.
  void add(const glm::dvec3& point, const osg::Vec4ub& color = {255, 255, 255, 255}, float value = 0.0F);
  void end();

  /// Points so far.
  [[nodiscard]] std::size_t size() const { return arrays_.points->size(); }
  /// Empty afterwards.
  [[nodiscard]] LineArrays take();

 private:
  struct Point {
    osg::Vec3 place;
    osg::Vec4ub color;
    float value = 0.0F;
  };
  void push(const Point& point, unsigned flags);
  void breakLine();

  glm::dvec3 origin_;
  Channel channel_;
  LineArrays arrays_;
  std::map<std::pair<double, bool>, std::size_t> styles_;
  Kind kind_ = Kind::Strip;
  std::size_t style_ = 0;
  std::size_t added_ = 0;      // to the line under way, drawable or not
  bool is_connected_ = false;  // the last point of the arrays is the one before, and drawable
  bool is_first_drawn_ = false;
  std::size_t first_index_ = 0;  // of the line under way's first point, meaningful with is_first_drawn_
  Point first_;
  Point pending_;  // List: first of a pair
};

}  // namespace stillframe::nodes
