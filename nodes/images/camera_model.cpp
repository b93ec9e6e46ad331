#include "nodes/images/camera_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/images/raw_rows.h"

namespace stillframe::nodes {
namespace {

using scenegraph::CameraInfo;

constexpr int kSteps = 60;            // Newton needs 4 or 5; near a fold the steps are halved
constexpr double kConverged = 1e-12;  // on the plane z = 1: 1e-9 pixels of a focal length of 1000
constexpr double kAccepted = 1e-9;    // where rounding keeps it from getting there

std::unexpected<CameraFault> fault(const char* code, std::string message) {
  return std::unexpected(CameraFault{code, std::move(message)});
}

std::uint64_t orOne(std::uint32_t binning) { return std::max<std::uint32_t>(binning, 1); }

/// Size of the picture that such a camera publishes.
std::array<std::uint64_t, 2> pictureSize(const CameraInfo& info) {
  const std::uint64_t width = info.roi_width != 0 ? info.roi_width : info.width;
  const std::uint64_t height = info.roi_height != 0 ? info.roi_height : info.height;
  return {width / orOne(info.binning_x), height / orOne(info.binning_y)};
}

}  // namespace

/// The forward model at a point: its value and its derivatives.
struct CameraModel::Slope {
  Point value;
  double xx = 0.0;  // d value.x / d x
  double xy = 0.0;
  double yx = 0.0;
  double yy = 0.0;
  [[nodiscard]] double determinant() const { return xx * yy - xy * yx; }
};

std::expected<CameraModel, CameraFault> CameraModel::make(const CameraInfo& info, std::uint32_t width,
                                                          std::uint32_t height, PixelGrid grid) {
  if (info.width != 0 || info.height != 0) {
    const auto [expected_width, expected_height] = pictureSize(info);
    if (expected_width != width || expected_height != height) {
      return fault("CameraInfoMismatch", "the camera's pictures have " + sizeText(expected_width, expected_height) +
                                             " pixels (" + sizeText(info.width, info.height) +
                                             " less its region of interest and binning), the image has " +
                                             sizeText(width, height));
    }
  }
  const bool has_p = info.p[0] != 0.0 && info.p[5] != 0.0;
  const bool is_rectified = grid == PixelGrid::Rectified && has_p;
  const std::array<double, 5> matrix = is_rectified ? std::array{info.p[0], info.p[1], info.p[2], info.p[5], info.p[6]}
                                                    : std::array{info.k[0], info.k[1], info.k[2], info.k[4], info.k[5]};
  if (!std::ranges::all_of(matrix, [](double value) { return std::isfinite(value); }) || matrix[0] == 0.0 ||
      matrix[3] == 0.0) {
    return fault("BadCameraInfo", "the camera has the focal lengths " + std::to_string(matrix[0]) + " and " +
                                      std::to_string(matrix[3]) + " and the centre " + std::to_string(matrix[2]) +
                                      ", " + std::to_string(matrix[4]) +
                                      ": they must be finite, and the lengths not zero");
  }
  CameraModel model;
  const auto bin_x = static_cast<double>(orOne(info.binning_x));
  const auto bin_y = static_cast<double>(orOne(info.binning_y));
  model.fx_ = matrix[0] / bin_x;
  model.skew_ = matrix[1] / bin_x;
  model.cx_ = (matrix[2] - info.roi_x_offset) / bin_x;
  model.fy_ = matrix[3] / bin_y;
  model.cy_ = (matrix[4] - info.roi_y_offset) / bin_y;
  if (grid == PixelGrid::Raw) {
    if (auto problem = model.setLens(info)) {
      return std::unexpected(std::move(*problem));
    }
  }
  return model;
}

std::optional<CameraFault> CameraModel::setLens(const CameraInfo& info) {
  const std::vector<double>& d = info.distortion;
  if (std::ranges::all_of(d, [](double value) { return value == 0.0; })) {
    return std::nullopt;  // whatever its name
  }
  if (!std::ranges::all_of(d, [](double value) { return std::isfinite(value); })) {
    return CameraFault{"BadCameraInfo", "the camera has a distortion coefficient that is not finite"};
  }
  const std::string& model = info.distortion_model;
  const bool is_polynomial = model == "plumb_bob" || model == "rational_polynomial" || model.empty();
  const bool is_equidistant = model == "equidistant" || model == "fisheye" || model == "kannala_brandt4";
  if (!is_polynomial && !is_equidistant) {
    return CameraFault{"UnknownDistortion", "the distortion model '" + model +
                                                "' is not known: plumb_bob, rational_polynomial and equidistant are; "
                                                "with rectify=false it is left out of account"};
  }
  const std::size_t least = 4;
  const std::size_t most = is_equidistant ? 4 : d_.size();
  const auto has_more = [&] {
    return std::any_of(d.begin() + static_cast<std::ptrdiff_t>(most), d.end(), [](double v) { return v != 0.0; });
  };
  if (d.size() < least || (d.size() > most && has_more())) {
    return CameraFault{"UnknownDistortion", "the distortion model '" + model + "' with " + std::to_string(d.size()) +
                                                " coefficients is not known; with rectify=false it is left out of "
                                                "account"};
  }
  std::copy_n(d.begin(), std::min(d.size(), most), d_.begin());
  lens_ = is_equidistant ? Lens::Equidistant : Lens::Polynomial;
  return std::nullopt;
}

CameraModel::Slope CameraModel::slopeAt(const Point& ideal) const {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4] = d_;
  const double x = ideal.x;
  const double y = ideal.y;
  const double r2 = x * x + y * y;
  const double above = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double below = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double radial = above / below;
  // Derivative of the radial factor by r2.
  const double above_slope = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);
  const double below_slope = k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6);
  const double slope = (above_slope - radial * below_slope) / below;
  Slope at;
  at.value.x = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x) + r2 * (s1 + r2 * s2);
  at.value.y = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y + r2 * (s3 + r2 * s4);
  const double prism_x = s1 + 2.0 * r2 * s2;
  const double prism_y = s3 + 2.0 * r2 * s4;
  at.xx = radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x + 2.0 * x * prism_x;
  at.xy = 2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y + 2.0 * y * prism_x;
  at.yx = 2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y + 2.0 * x * prism_y;
  at.yy = radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x + 2.0 * y * prism_y;
  return at;
}

double CameraModel::equidistantAngle(double theta) const {
  const double t2 = theta * theta;
  return theta * (1.0 + t2 * (d_[0] + t2 * (d_[1] + t2 * (d_[2] + t2 * d_[3]))));
}

CameraModel::Point CameraModel::distorted(const Point& ideal) const {
  switch (lens_) {
    case Lens::None:
      return ideal;
    case Lens::Polynomial:
      return slopeAt(ideal).value;
    case Lens::Equidistant: {
      const double r = std::hypot(ideal.x, ideal.y);
      const double scale = r > 0.0 ? equidistantAngle(std::atan(r)) / r : 1.0;
      return {ideal.x * scale, ideal.y * scale};
    }
  }
  return ideal;
}

std::optional<CameraModel::Point> CameraModel::undistortPolynomial(const Point& seen) const {
  Point at = seen;
  Slope slope = slopeAt(at);
  const auto distance = [&](const Slope& of) { return std::hypot(of.value.x - seen.x, of.value.y - seen.y); };
  // From outside the fold Newton may run away: begin nearer to the axis, where the lens always maps one to one.
  while (!(slope.determinant() > 0.0) || !std::isfinite(slope.value.x) || !std::isfinite(slope.value.y)) {
    at = {at.x * 0.5, at.y * 0.5};
    if (std::hypot(at.x, at.y) < 1e-6) {
      return std::nullopt;
    }
    slope = slopeAt(at);
  }
  double error = distance(slope);
  for (int step = 0; step < kSteps && error > kConverged; ++step) {
    const double determinant = slope.determinant();
    const double ex = slope.value.x - seen.x;
    const double ey = slope.value.y - seen.y;
    Point move{(slope.yy * ex - slope.xy * ey) / determinant, (slope.xx * ey - slope.yx * ex) / determinant};
    // Halved until it gets nearer without crossing a fold, where the determinant changes its sign.
    bool is_nearer = false;
    for (int half = 0; half < 30 && !is_nearer; ++half) {
      const Point next{at.x - move.x, at.y - move.y};
      const Slope there = slopeAt(next);
      if (there.determinant() > 0.0 && distance(there) < error) {
        at = next;
        slope = there;
        error = distance(there);
        is_nearer = true;
      }
      move = {move.x * 0.5, move.y * 0.5};
    }
    if (!is_nearer) {
      break;
    }
  }
  return error <= kAccepted ? std::optional(at) : std::nullopt;
}

std::optional<CameraModel::Point> CameraModel::undistortEquidistant(const Point& seen) const {
  const double wanted = std::hypot(seen.x, seen.y);
  if (wanted == 0.0) {
    return seen;
  }
  // Bisection guards Newton: the angle lies between the axis and the first fold, or 90 degrees.
  constexpr int kLooks = 64;
  double low = 0.0;
  double high = 0.0;
  for (int i = 1; i <= kLooks && high == 0.0; ++i) {
    const double theta = 0.5 * std::numbers::pi * i / kLooks;
    const double angle = equidistantAngle(theta);
    if (angle >= wanted) {
      high = theta;
    } else if (angle < equidistantAngle(low)) {
      return std::nullopt;
    } else {
      low = theta;
    }
  }
  if (high == 0.0) {
    return std::nullopt;
  }
  double theta = 0.5 * (low + high);
  for (int step = 0; step < kSteps; ++step) {
    const double error = equidistantAngle(theta) - wanted;
    if (std::abs(error) <= kConverged * 1e-3) {
      break;
    }
    (error > 0.0 ? high : low) = theta;
    const double t2 = theta * theta;
    const double slope = 1.0 + t2 * (3.0 * d_[0] + t2 * (5.0 * d_[1] + t2 * (7.0 * d_[2] + t2 * 9.0 * d_[3])));
    const double newton = theta - error / slope;
    theta = slope > 0.0 && newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  const double radius = std::tan(theta);
  constexpr double kFarthest = 1e6;  // beyond it a pixel looks along the picture's plane
  if (!(std::abs(equidistantAngle(theta) - wanted) <= kAccepted) || !(radius < kFarthest) || radius < 0.0) {
    return std::nullopt;
  }
  return Point{seen.x / wanted * radius, seen.y / wanted * radius};
}

std::optional<CameraModel::Ray> CameraModel::ray(double u, double v) const {
  const double y = (v - cy_) / fy_;
  const Point seen{(u - cx_ - skew_ * y) / fx_, y};
  if (lens_ == Lens::None) {
    return Ray{.at = seen};
  }
  const auto ideal = lens_ == Lens::Polynomial ? undistortPolynomial(seen) : undistortEquidistant(seen);
  if (!ideal) {
    return std::nullopt;
  }
  const Point back = distorted(*ideal);
  return Ray{.at = *ideal, .residual_px = std::hypot((back.x - seen.x) * fx_, (back.y - seen.y) * fy_)};
}

RayTable makeRays(const CameraModel& model, std::uint32_t width, std::uint32_t height) {
  constexpr double kLargest = 1e30;  // of a ray that a float can hold and multiply
  RayTable rays{.width = width, .height = height, .xyz = {}};
  rays.xyz.resize(std::size_t{3} * width * height);
  float* out = rays.xyz.data();
  for (std::uint32_t v = 0; v < height; ++v) {
    for (std::uint32_t u = 0; u < width; ++u, out += 3) {
      const auto ray = model.ray(u, v);
      if (!ray || !(std::abs(ray->at.x) < kLargest) || !(std::abs(ray->at.y) < kLargest)) {
        ++rays.without_ray;
        continue;
      }
      out[0] = static_cast<float>(ray->at.x);
      out[1] = static_cast<float>(ray->at.y);
      out[2] = 1.0F;
      rays.largest_residual_px = std::max(rays.largest_residual_px, ray->residual_px);
    }
  }
  return rays;
}

}  // namespace stillframe::nodes
