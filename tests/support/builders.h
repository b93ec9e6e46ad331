#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <expected>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/store/dataset.h"
#include "tf/transform_buffer.h"

namespace stillframe::test {

using namespace tf::literals;

inline constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

/// A pure translation, target_from_source.
[[nodiscard]] inline tf::RigidTransform translate(double x, double y, double z) { return {.translation = {x, y, z}}; }
/// A rotation about Z, then a translation.
[[nodiscard]] tf::RigidTransform turn(double yaw_rad, double x = 0.0, double y = 0.0, double z = 0.0);

/// Seeded randomness: the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [low, high).
  [[nodiscard]] double number(double low, double high);
  /// Uniform in [0, count).
  [[nodiscard]] std::size_t index(std::size_t count);
  /// Uniform rotation, translation uniform in a cube of that half size.
  [[nodiscard]] tf::RigidTransform transform(double half_size);

 private:
  std::mt19937_64 engine_;
};

/// `TfBuilder().edge("map", "base").at(10_s, translate(1, 0, 0)).build()`; refused samples fail the test.
class TfBuilder {
 public:
  TfBuilder& edge(std::string parent, std::string child, bool is_static = false);
  TfBuilder& at(std::int64_t stamp_ns, const tf::RigidTransform& parent_from_child);
  [[nodiscard]] std::shared_ptr<tf::TransformBuffer> build() const { return buffer_; }

 private:
  std::shared_ptr<tf::TransformBuffer> buffer_ = std::make_shared<tf::TransformBuffer>();
  std::string parent_;
  std::string child_;
  bool is_static_ = false;
};

/// Decodes from memory: the locator of an entry is an index into what was add()ed. Counts what it decodes.
class FakeSource : public scenegraph::EntrySource {
 public:
  using Outcome = std::expected<scenegraph::AnyObject, scenegraph::DecodeError>;
  /// Index of the outcome. Not while others decode.
  std::uint64_t add(Outcome outcome);
  [[nodiscard]] Outcome decode(const scenegraph::TopicInfo& topic, const scenegraph::Entry& entry) const override;
  [[nodiscard]] std::size_t decodeCount() const { return decode_count_; }

 private:
  std::vector<Outcome> outcomes_;
  mutable std::atomic<std::size_t> decode_count_ = 0;
};

/// A dataset from objects in memory:
/// `DatasetBuilder().topic("/points", ObjectType::PointCloud).at(1_s, cloud).failsAt(2_s, "BadChunk").build()`.
class DatasetBuilder {
 public:
  DatasetBuilder& topic(const std::string& name, scenegraph::ObjectType type);
  /// Adds to the topic named last; appended to the store at once.
  template <typename T>
  DatasetBuilder& at(std::int64_t log_ns, T object) {
    return add(log_ns, scenegraph::AnyObject::make(std::move(object)));
  }
  DatasetBuilder& failsAt(std::int64_t log_ns, const std::string& code);
  /// One transform as a message of the topic named last; its header stamp is the log time unless given.
  DatasetBuilder& transform(std::int64_t log_ns, const std::string& parent, const std::string& child,
                            const tf::RigidTransform& parent_from_child, std::int64_t header_ns);
  DatasetBuilder& transform(std::int64_t log_ns, const std::string& parent, const std::string& child,
                            const tf::RigidTransform& parent_from_child = {}) {
    return transform(log_ns, parent, child, parent_from_child, log_ns);
  }
  /// The dataset with its transforms taken.
  [[nodiscard]] std::shared_ptr<scenegraph::Dataset> build();
  /// The same, with the transforms not yet taken.
  [[nodiscard]] const std::shared_ptr<scenegraph::Dataset>& raw() const { return dataset_; }
  [[nodiscard]] const FakeSource& source() const { return *source_; }

 private:
  DatasetBuilder& add(std::int64_t log_ns, FakeSource::Outcome outcome);

  std::shared_ptr<scenegraph::Dataset> dataset_ = std::make_shared<scenegraph::Dataset>("test");
  std::shared_ptr<FakeSource> source_ = std::make_shared<FakeSource>();
  scenegraph::TopicId topic_ = 0;
};

/// `CloudBuilder("lidar").field("x", FieldType::Float32)...point({1, 2, 3, 0.5}).build()`: values in field order,
/// packed.
class CloudBuilder {
 public:
  explicit CloudBuilder(std::string frame_id) { cloud_.frame_id = std::move(frame_id); }
  CloudBuilder& field(const std::string& name, scenegraph::FieldType type);
  /// x, y, z as float.
  CloudBuilder& xyz();
  CloudBuilder& point(const std::vector<double>& values);
  CloudBuilder& stamp(std::int64_t ns);
  [[nodiscard]] scenegraph::PointCloud build() const;

 private:
  scenegraph::PointCloud cloud_;
  std::vector<std::byte> bytes_;
};

}  // namespace stillframe::test
