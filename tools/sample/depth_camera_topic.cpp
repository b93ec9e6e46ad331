#include <array>
#include <cstring>
#include <limits>

#include "tools/sample/depth_camera.h"

namespace stillframe::sample {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 120;
constexpr std::uint32_t kPixelStep = 32;  // x, y, z, padding, rgb, padding: PCL's PointXYZRGB
constexpr double kFocal_px = 130.0;       // about 63 degrees across
constexpr std::uint64_t kSalt = 0xE7037ED1A0B428DBULL;

std::vector<glm::dvec3> pinholeRays() {
  std::vector<glm::dvec3> rays;
  for (std::uint32_t v = 0; v < kHeight; ++v) {
    for (std::uint32_t u = 0; u < kWidth; ++u) {
      rays.emplace_back((u + 0.5 - 0.5 * kWidth) / kFocal_px, (v + 0.5 - 0.5 * kHeight) / kFocal_px, 1.0);
    }
  }
  return rays;
}

/// A depth camera's coloured cloud at 5 Hz, organised in rows; NaN where nothing is within its reach.
class CameraPoints final : public Topic {
 public:
  explicit CameraPoints(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/camera/points"; }
  Ros2Type type() const override { return pointCloud2Type(); }
  std::int64_t periodNs() const override { return 200'000'000; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    using scenegraph::FieldType;
    const std::vector<CameraPixel> pixels = camera_.look(stage_, elapsed_ns);
    std::vector<std::byte> data(pixels.size() * kPixelStep);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      std::array<float, 3> position;
      position.fill(std::numeric_limits<float>::quiet_NaN());
      if (pixels[i].depth_m > 0.0) {
        const glm::dvec3 place = camera_.rays()[i] * pixels[i].depth_m;
        position = {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)};
      }
      std::memcpy(data.data() + i * kPixelStep, position.data(), sizeof position);
      std::memcpy(data.data() + i * kPixelStep + 16, &pixels[i].rgb, sizeof pixels[i].rgb);
    }
    scenegraph::PointCloud cloud;
    cloud.stamp = {stage_.start_ns + elapsed_ns};
    cloud.frame_id = "camera_optical_frame";
    cloud.width = kWidth;
    cloud.height = kHeight;
    cloud.point_step = kPixelStep;
    cloud.row_step = kWidth * kPixelStep;
    cloud.is_dense = false;
    cloud.fields = {{"x", 0, FieldType::Float32},
                    {"y", 4, FieldType::Float32},
                    {"z", 8, FieldType::Float32},
                    {"rgb", 16, FieldType::Float32}};
    cloud.data.bytes = data;
    return serializePointCloud2(cloud);
  }

 private:
  Stage stage_;
  DepthCamera camera_{baseFromCamera() * cameraFromOptical(), pinholeRays(), kSalt};
};

}  // namespace

std::unique_ptr<Topic> makeDepthCamera(const Stage& stage) { return std::make_unique<CameraPoints>(stage); }

}  // namespace stillframe::sample
