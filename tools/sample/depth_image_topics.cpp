#include <array>
#include <cmath>
#include <span>

#include "tools/sample/depth_camera.h"
#include "tools/sample/image_messages.h"

namespace stillframe::sample {
namespace {

constexpr std::uint32_t kRearWidth = 160;
constexpr std::uint32_t kRearHeight = 120;
constexpr double kRearFocal_px = 110.0;
constexpr double kCentreU_px = 80.5;
constexpr double kCentreV_px = 58.0;
constexpr std::array<double, 5> kDistortion{-0.21, 0.05, 0.0012, -0.0009, -0.004};  // plumb_bob: k1 k2 p1 p2 k3
constexpr std::uint64_t kRearSalt = 0x8EBC6AF09C88C6E3ULL;
constexpr std::int64_t kPeriod_ns = 400'000'000;
constexpr const char* kFrame = "rear_camera_optical_frame";

/// The ray that the lens bends to a pixel: its model turned round by fixed-point steps, which this weak lens permits.
glm::dvec3 rayOf(double u_px, double v_px) {
  const auto [k1, k2, p1, p2, k3] = kDistortion;
  const double bent_x = (u_px - kCentreU_px) / kRearFocal_px;
  const double bent_y = (v_px - kCentreV_px) / kRearFocal_px;
  double x = bent_x;
  double y = bent_y;
  for (int step = 0; step < 60; ++step) {
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double next_x = (bent_x - 2.0 * p1 * x * y - p2 * (r2 + 2.0 * x * x)) / radial;
    const double next_y = (bent_y - p1 * (r2 + 2.0 * y * y) - 2.0 * p2 * x * y) / radial;
    x = next_x;
    y = next_y;
  }
  return {x, y, 1.0};
}

std::vector<glm::dvec3> lensRays() {
  std::vector<glm::dvec3> rays;
  for (std::uint32_t v = 0; v < kRearHeight; ++v) {
    for (std::uint32_t u = 0; u < kRearWidth; ++u) {
      rays.push_back(rayOf(u, v));
    }
  }
  return rays;
}

/// Depth in millimetres of the camera that looks backwards, as its lens sees it: not rectified.
class DepthImages final : public Topic {
 public:
  explicit DepthImages(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/rear_camera/depth/image_raw"; }
  Ros2Type type() const override { return imageType(); }
  std::int64_t periodNs() const override { return kPeriod_ns; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    std::vector<std::uint16_t> depths_mm;
    for (const CameraPixel& pixel : camera_.look(stage_, elapsed_ns)) {
      depths_mm.push_back(static_cast<std::uint16_t>(std::lround(1e3 * pixel.depth_m)));
    }
    scenegraph::Image image;
    image.stamp = {stage_.start_ns + elapsed_ns};
    image.frame_id = kFrame;
    image.width = kRearWidth;
    image.height = kRearHeight;
    image.encoding = "16UC1";
    image.row_step = 2 * kRearWidth;
    image.data.bytes = std::as_bytes(std::span(depths_mm));
    return serializeImage(image);
  }

 private:
  Stage stage_;
  DepthCamera camera_{baseFromRearCamera() * cameraFromOptical(), lensRays(), kRearSalt};
};

/// The lens of that camera, with each image.
class DepthCameraInfo final : public Topic {
 public:
  explicit DepthCameraInfo(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/rear_camera/depth/camera_info"; }
  Ros2Type type() const override { return cameraInfoType(); }
  std::int64_t periodNs() const override { return kPeriod_ns; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    scenegraph::CameraInfo info;
    info.stamp = {stage_.start_ns + elapsed_ns};
    info.frame_id = kFrame;
    info.width = kRearWidth;
    info.height = kRearHeight;
    info.distortion_model = "plumb_bob";
    info.distortion.assign(kDistortion.begin(), kDistortion.end());
    info.k = {kRearFocal_px, 0.0, kCentreU_px, 0.0, kRearFocal_px, kCentreV_px, 0.0, 0.0, 1.0};
    info.r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    info.p = {kRearFocal_px, 0.0, kCentreU_px, 0.0, 0.0, kRearFocal_px, kCentreV_px, 0.0, 0.0, 0.0, 1.0, 0.0};
    return serializeCameraInfo(info);
  }

 private:
  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeDepthImages(const Stage& stage) { return std::make_unique<DepthImages>(stage); }
std::unique_ptr<Topic> makeDepthCameraInfo(const Stage& stage) { return std::make_unique<DepthCameraInfo>(stage); }

}  // namespace stillframe::sample
