#include "tools/sample/lidar.h"

namespace stillframe::sample {
namespace {

/// A spinning lidar of 32 rings at 10 Hz.
class LidarPoints final : public Topic {
 public:
  LidarPoints(const Stage& stage, std::uint32_t points) : stage_(stage), lidar_(points) {}
  std::string_view name() const override { return "/lidar/points"; }
  Ros2Type type() const override { return pointCloud2Type(); }
  std::int64_t periodNs() const override { return 100'000'000; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    std::vector<std::byte> data;
    return serializePointCloud2(lidar_.scan(stage_, elapsed_ns, data));
  }

 private:
  Stage stage_;
  Lidar lidar_;
};

}  // namespace

std::unique_ptr<Topic> makeLidar(const Stage& stage, std::uint32_t points) {
  return std::make_unique<LidarPoints>(stage, points);
}

}  // namespace stillframe::sample
