#pragma once

#include <draco/compression/attributes/kd_tree_attributes_decoder.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/compression/point_cloud/point_cloud_kd_tree_decoder.h>
#include <draco/compression/point_cloud/point_cloud_sequential_decoder.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace stillframe::nodes {

/// What a Draco stream claims before anything of it has been decoded.
struct DracoClaim {
  std::uint64_t points = 0;
  std::uint64_t faces = 0;
  std::uint64_t orientations = 0;  ///< bits that steer the prediction of texture coordinates
};

/// Whether libdraco may make room for something, and what was refused.
///
/// libdraco allocates what a stream claims, and a stream of a few bytes may claim 2^32 points of 255 values each.
class DracoBudget {
 public:
  explicit DracoBudget(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}
  /// Counts at the head of the stream; nullopt stands for counts that are cut off.
  [[nodiscard]] bool allows(const std::optional<DracoClaim>& claim);
  /// All attributes of a cloud whose number of points is known by now.
  [[nodiscard]] bool allowsValues(const draco::PointCloud& cloud);
  /// The bits of a prediction that come next: at most one for each corner of a face.
  [[nodiscard]] bool allowsOrientations(draco::PredictionSchemeMethod method, draco::DecoderBuffer buffer,
                                        std::uint64_t faces);
  /// The number of points that a k-d tree of a bitstream before 2.3 says once more: at most that of the cloud.
  [[nodiscard]] bool allowsTree(draco::DecoderBuffer buffer, std::uint64_t points);
  /// The claim that was too large.
  [[nodiscard]] const std::optional<DracoClaim>& refused() const noexcept { return refused_; }

 private:
  std::uint64_t max_bytes_;
  std::optional<DracoClaim> refused_;
};

/// Puts decoders that ask the budget in the place of those that libdraco made for the attributes of a mesh, before any
/// of them has read a value.
void boundPredictions(draco::MeshDecoder& decoder, DracoBudget& budget);

/// Reads the counts that come next in a copy of the stream's buffer.
[[nodiscard]] std::optional<DracoClaim> peekPointCloud(draco::DecoderBuffer buffer);
[[nodiscard]] std::optional<DracoClaim> peekSequentialMesh(draco::DecoderBuffer buffer);
[[nodiscard]] std::optional<DracoClaim> peekEdgebreakerMesh(draco::DecoderBuffer buffer);

/// A point cloud decoder of libdraco that keeps to a budget.
template <typename Base>
class BoundedCloudDecoder : public Base {
 public:
  explicit BoundedCloudDecoder(DracoBudget& budget) : budget_(budget) {}

 protected:
  bool DecodeGeometryData() override {
    return budget_.allows(peekPointCloud(*this->buffer())) && Base::DecodeGeometryData();
  }
  bool DecodeAllAttributes() override {
    return budget_.allowsValues(*this->point_cloud()) && Base::DecodeAllAttributes();
  }
  [[nodiscard]] DracoBudget& budget() const noexcept { return budget_; }

 private:
  DracoBudget& budget_;
};

/// The same for a mesh decoder.
template <typename Base, std::optional<DracoClaim> (*kPeek)(draco::DecoderBuffer)>
class BoundedMeshDecoder final : public Base {
 public:
  explicit BoundedMeshDecoder(DracoBudget& budget) : budget_(budget) {}

 protected:
  bool DecodeConnectivity() override { return budget_.allows(kPeek(*this->buffer())) && Base::DecodeConnectivity(); }
  bool DecodeAllAttributes() override {
    boundPredictions(*this, budget_);
    return budget_.allowsValues(*this->point_cloud()) && Base::DecodeAllAttributes();
  }

 private:
  DracoBudget& budget_;
};

using BoundedSequentialCloud = BoundedCloudDecoder<draco::PointCloudSequentialDecoder>;

/// The attributes of a k-d tree within a budget.
class BoundedKdTreeAttributes final : public draco::KdTreeAttributesDecoder {
 public:
  explicit BoundedKdTreeAttributes(DracoBudget& budget) : budget_(budget) {}

 protected:
  bool DecodeDataNeededByPortableTransforms(draco::DecoderBuffer* buffer) override {
    return budget_.allowsTree(*buffer, GetDecoder()->point_cloud()->num_points()) &&
           KdTreeAttributesDecoder::DecodeDataNeededByPortableTransforms(buffer);
  }

 private:
  DracoBudget& budget_;
};

/// A k-d tree decoder of libdraco that keeps to a budget in its attributes too.
class BoundedKdTreeCloud final : public BoundedCloudDecoder<draco::PointCloudKdTreeDecoder> {
 public:
  using BoundedCloudDecoder::BoundedCloudDecoder;

 protected:
  bool CreateAttributesDecoder(std::int32_t id) override {
    return SetAttributesDecoder(id, std::make_unique<BoundedKdTreeAttributes>(budget()));
  }
};

using BoundedSequentialMesh = BoundedMeshDecoder<draco::MeshSequentialDecoder, &peekSequentialMesh>;
using BoundedEdgebreakerMesh = BoundedMeshDecoder<draco::MeshEdgebreakerDecoder, &peekEdgebreakerMesh>;

}  // namespace stillframe::nodes
