#include "scenegraph/export/picture_normals.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace stillframe::scenegraph {
namespace {

constexpr double kLargestBend = 0.02;  // of what goes on as a plane

/// What is affine over a plane's picture: 1 / distance in perspective, the distance itself in an orthographic view.
class AffineDepth {
 public:
  AffineDepth(const Picture& picture, bool is_orthographic) : picture_(picture), is_orthographic_(is_orthographic) {}

  [[nodiscard]] bool isDrawn(int x, int y) const {
    return x >= 0 && y >= 0 && x < picture_.width && y < picture_.height && std::isfinite(metres(x, y));
  }
  [[nodiscard]] double at(int x, int y) const { return is_orthographic_ ? metres(x, y) : 1.0 / metres(x, y); }
  /// Change from a pixel to the next along (dx, dy), on the side that goes on most like a plane.
  [[nodiscard]] double slope(int x, int y, int dx, int dy, double scale) const {
    double best = kLargestBend * scale;
    double found = 0.0;
    for (const int side : {-1, 1}) {
      const int sx = side * dx;
      const int sy = side * dy;
      if (!isDrawn(x + sx, y + sy) || !isDrawn(x + 2 * sx, y + 2 * sy)) {
        continue;
      }
      const double one = at(x + sx, y + sy);
      const double bend = std::abs(2.0 * one - at(x + 2 * sx, y + 2 * sy) - at(x, y));
      if (bend < best) {
        best = bend;
        found = side * (one - at(x, y));
      }
    }
    return found;
  }

 private:
  [[nodiscard]] double metres(int x, int y) const {
    return static_cast<double>(picture_.depth_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                                                static_cast<std::size_t>(x)]);
  }
  const Picture& picture_;
  bool is_orthographic_;
};

}  // namespace

std::vector<float> normalsOf(const Picture& picture, const CameraView& view) {
  const glm::dmat4 clip_from_eye = projection(view, static_cast<double>(picture.width) / picture.height);
  const glm::dvec2 texel(2.0 / (clip_from_eye[0][0] * picture.width), 2.0 / (clip_from_eye[1][1] * picture.height));
  const glm::dmat3 fixed_from_eye = glm::transpose(glm::dmat3(view.eye_from_fixed));
  const AffineDepth depth(picture, view.is_orthographic);
  std::vector<float> normals(picture.depth_m.size() * 3, 0.0F);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!depth.isDrawn(x, y)) {
        continue;
      }
      const double own = depth.at(x, y);
      const double scale = view.is_orthographic ? view.vertical_extent_m : own;
      // Rows of a picture run downwards.
      const glm::dvec2 slope(depth.slope(x, y, 1, 0, scale), -depth.slope(x, y, 0, 1, scale));
      glm::dvec3 in_eye(slope / texel, 1.0);
      if (!view.is_orthographic) {
        const glm::dvec2 gradient = slope / own / texel;
        const glm::dvec2 ray(texel.x * (x + 0.5 - picture.width / 2.0), texel.y * (picture.height / 2.0 - y - 0.5));
        in_eye = {-gradient, 1.0 - glm::dot(gradient, ray)};
      }
      const glm::dvec3 normal = fixed_from_eye * glm::normalize(in_eye);
      float* const out = &normals[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                       static_cast<std::size_t>(x))];
      for (int axis = 0; axis < 3; ++axis) {
        out[axis] = static_cast<float>(normal[axis]);
      }
    }
  }
  return normals;
}

}  // namespace stillframe::scenegraph
