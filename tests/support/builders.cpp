#include "tests/support/builders.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stillframe::test {
namespace {

template <typename T>
void append(std::vector<std::byte>& bytes, double value) {
  const auto typed = static_cast<T>(value);
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &typed, sizeof(T));
}

}  // namespace

tf::RigidTransform turn(double yaw_rad, double x, double y, double z) {
  return {.rotation = {std::cos(yaw_rad / 2), 0.0, 0.0, std::sin(yaw_rad / 2)}, .translation = {x, y, z}};
}

// Not std::uniform_real_distribution: its numbers are the library's choice.
double Random::number(double low, double high) {
  return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
}

std::size_t Random::index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

tf::RigidTransform Random::transform(double half_size) {
  glm::dquat rotation;
  double norm = 0.0;
  do {
    rotation = {number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)};
    norm = glm::length(rotation);
  } while (norm < 0.1 || norm > 1.0);
  return {.rotation = rotation / norm,
          .translation = {number(-half_size, half_size), number(-half_size, half_size), number(-half_size, half_size)}};
}

TfBuilder& TfBuilder::edge(std::string parent, std::string child, bool is_static) {
  parent_ = std::move(parent);
  child_ = std::move(child);
  is_static_ = is_static;
  return *this;
}

TfBuilder& TfBuilder::at(std::int64_t stamp_ns, const tf::RigidTransform& parent_from_child) {
  const auto inserted = buffer_->insert({parent_, child_, tf::TimePoint{stamp_ns}, parent_from_child, is_static_});
  EXPECT_TRUE(inserted.has_value()) << parent_ << " -> " << child_ << ": " << tf::toString(inserted.error());
  return *this;
}

std::uint64_t FakeSource::add(Outcome outcome) {
  outcomes_.push_back(std::move(outcome));
  return outcomes_.size() - 1;
}

FakeSource::Outcome FakeSource::decode(const scenegraph::TopicInfo& /*topic*/, const scenegraph::Entry& entry) const {
  ++decode_count_;
  return outcomes_.at(entry.locator);
}

DatasetBuilder& DatasetBuilder::topic(const std::string& name, scenegraph::ObjectType type) {
  scenegraph::TopicInfo info;
  info.name = name;
  info.type = type;
  info.is_static = name.ends_with("tf_static");
  topic_ = dataset_->store().addTopic(info, source_);
  return *this;
}

DatasetBuilder& DatasetBuilder::add(std::int64_t log_ns, FakeSource::Outcome outcome) {
  scenegraph::Entry entry;
  entry.log_time = tf::TimePoint{log_ns};
  entry.payload_bytes = outcome ? outcome->byteSize() : 1;
  entry.locator = source_->add(std::move(outcome));
  dataset_->store().append(topic_, {&entry, 1});
  return *this;
}

DatasetBuilder& DatasetBuilder::failsAt(std::int64_t log_ns, const std::string& code) {
  return add(log_ns, std::unexpected(scenegraph::DecodeError{code, "made to fail"}));
}

DatasetBuilder& DatasetBuilder::transform(std::int64_t log_ns, const std::string& parent, const std::string& child,
                                          const tf::RigidTransform& parent_from_child, std::int64_t header_ns) {
  scenegraph::FrameTransforms message;
  message.transforms.push_back({tf::TimePoint{header_ns}, parent, child, parent_from_child});
  return at(log_ns, std::move(message));
}

std::shared_ptr<scenegraph::Dataset> DatasetBuilder::build() {
  dataset_->takeTransforms();
  return dataset_;
}

CloudBuilder& CloudBuilder::field(const std::string& name, scenegraph::FieldType type) {
  cloud_.fields.push_back({name, cloud_.point_step, type, 1});
  cloud_.point_step += scenegraph::byteSize(type);
  return *this;
}

CloudBuilder& CloudBuilder::xyz() {
  using scenegraph::FieldType;
  return field("x", FieldType::Float32).field("y", FieldType::Float32).field("z", FieldType::Float32);
}

CloudBuilder& CloudBuilder::point(const std::vector<double>& values) {
  using scenegraph::FieldType;
  EXPECT_EQ(values.size(), cloud_.fields.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    switch (cloud_.fields[i].type) {
      case FieldType::Int8:
        append<std::int8_t>(bytes_, values[i]);
        break;
      case FieldType::Uint8:
        append<std::uint8_t>(bytes_, values[i]);
        break;
      case FieldType::Int16:
        append<std::int16_t>(bytes_, values[i]);
        break;
      case FieldType::Uint16:
        append<std::uint16_t>(bytes_, values[i]);
        break;
      case FieldType::Int32:
        append<std::int32_t>(bytes_, values[i]);
        break;
      case FieldType::Uint32:
        append<std::uint32_t>(bytes_, values[i]);
        break;
      case FieldType::Float32:
        append<float>(bytes_, values[i]);
        break;
      case FieldType::Float64:
        append<double>(bytes_, values[i]);
        break;
      case FieldType::Unknown:
        break;
    }
  }
  ++cloud_.width;
  return *this;
}

CloudBuilder& CloudBuilder::stamp(std::int64_t ns) {
  cloud_.stamp = tf::TimePoint{ns};
  return *this;
}

scenegraph::PointCloud CloudBuilder::build() const {
  scenegraph::PointCloud cloud = cloud_;
  cloud.row_step = cloud.width * cloud.point_step;
  const auto bytes = std::make_shared<const std::vector<std::byte>>(bytes_);
  cloud.data = {*bytes, bytes};
  return cloud;
}

}  // namespace stillframe::test
