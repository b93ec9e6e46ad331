#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/objects/image.h"

namespace stillframe::nodes {

/// Why a CameraInfo does not fit an image or has no inverse.
struct CameraFault {
  std::string code;     ///< "CameraInfoMismatch", "BadCameraInfo", "UnknownDistortion"
  std::string message;  ///< one sentence with sizes and values
};

/// How the pixels of an image came to be.
enum class PixelGrid : std::uint8_t {
  Raw,        ///< as the lens drew them: K and D
  Undone,     ///< as Raw, but the distortion is not to be taken into account: K alone
  Rectified,  ///< by a driver, before publishing (image_rect): P, where there is one
};

/// Rays of pixel centres in the optical frame (z forward, x right, y down) from intrinsics and distortion.
///
/// Binning and ROI as in sensor_msgs: K and P are of the full image; the picture's pixel (u, v) is the full one's
/// (u * binning + roi offset). Computes in double. Any thread; immutable.
class CameraModel {
 public:
  /// For an image of width x height pixels. An info of size 0 x 0 fits every image.
  [[nodiscard]] static std::expected<CameraModel, CameraFault> make(const scenegraph::CameraInfo& info,
                                                                    std::uint32_t width, std::uint32_t height,
                                                                    PixelGrid grid);

  struct Point {
    double x = 0.0;
    double y = 0.0;
  };
  /// Where on the plane z = 1 the lens sends what it draws at that point of it; the forward model of the distortion.
  [[nodiscard]] Point distorted(const Point& ideal) const;

  struct Ray {
    Point at;                  ///< on the plane z = 1
    double residual_px = 0.0;  ///< how far the forward model of `at` is from the pixel
  };
  /// The ray of a pixel: Newton's method on the forward model. nullopt where there is none, or it is not found: beyond
  /// the fold of the distortion, or at 90 degrees and more from the axis.
  [[nodiscard]] std::optional<Ray> ray(double u, double v) const;

  [[nodiscard]] bool hasDistortion() const noexcept { return lens_ != Lens::None; }

 private:
  enum class Lens : std::uint8_t { None, Polynomial, Equidistant };
  struct Slope;

  [[nodiscard]] std::optional<CameraFault> setLens(const scenegraph::CameraInfo& info);
  [[nodiscard]] Slope slopeAt(const Point& ideal) const;
  [[nodiscard]] std::optional<Point> undistortPolynomial(const Point& seen) const;
  [[nodiscard]] std::optional<Point> undistortEquidistant(const Point& seen) const;
  [[nodiscard]] double equidistantAngle(double theta) const;

  Lens lens_ = Lens::None;
  double fx_ = 1.0;
  double fy_ = 1.0;
  double skew_ = 0.0;
  double cx_ = 0.0;
  double cy_ = 0.0;
  std::array<double, 12> d_{};  // k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4; equidistant: k1 k2 k3 k4
};

/// Rays of all pixels as floats, with what the inversion cost in accuracy.
struct RayTable {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> xyz;       ///< x, y, 1 row by row; 0, 0, 0 for a pixel without a ray
  std::size_t without_ray = 0;  ///< pixels
  double largest_residual_px = 0.0;
};
[[nodiscard]] RayTable makeRays(const CameraModel& model, std::uint32_t width, std::uint32_t height);

}  // namespace stillframe::nodes
