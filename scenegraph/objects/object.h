#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

namespace stillframe::scenegraph {

/// What a topic carries; the numbers are those of the host SDK's BuiltinObjectType (SCHEMAS.md).
enum class ObjectType : std::uint8_t {
  None = 0,
  Image = 1,
  PointCloud = 3,
  DepthImage = 4,
  FrameTransforms = 6,
  OccupancyGrid = 7,
  CompressedPointCloud = 8,
  Mesh3D = 9,
  SceneEntities = 11,
  RobotDescription = 13,
  CameraInfo = 14,
  OccupancyGridUpdate = 15,
  PosesInFrame = 17,
  VoxelGrid = 18,
  // Stillframe's own, beyond the SDK's snapshot.
  GridMap = 64,
  JointStates = 65,
  LaserScan = 66,
};

/// Enumerator name ("PointCloud"), as statuses and JSON print it; "" for None.
[[nodiscard]] std::string_view toString(ObjectType type) noexcept;

/// A decoded message of any canonical type, immutable and shared between threads and views.
///
/// A canonical type T is a plain struct with `static constexpr ObjectType kType` and `std::size_t byteSize() const`
/// (what it keeps alive, payload included, for the cache's bound).
class AnyObject {
 public:
  AnyObject() = default;

  template <typename T>
  [[nodiscard]] static AnyObject make(T object) {
    AnyObject any;
    any.type_ = T::kType;
    any.byte_size_ = object.byteSize();
    any.data_ = std::make_shared<const T>(std::move(object));
    return any;
  }
  /// The object when it is a T, else nullptr. Keeps it alive on its own.
  template <typename T>
  [[nodiscard]] std::shared_ptr<const T> get() const {
    return type_ == T::kType ? std::static_pointer_cast<const T>(data_) : nullptr;
  }
  [[nodiscard]] ObjectType type() const noexcept { return type_; }
  [[nodiscard]] std::size_t byteSize() const noexcept { return byte_size_; }
  [[nodiscard]] explicit operator bool() const noexcept { return data_ != nullptr; }

 private:
  ObjectType type_ = ObjectType::None;
  std::size_t byte_size_ = 0;
  std::shared_ptr<const void> data_;
};

}  // namespace stillframe::scenegraph
