#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/lines/line_drawable.h"
#include "nodes/poses/covariance.h"
#include "nodes/poses/pose_set.h"
#include "nodes/poses/pose_trail.h"
#include "nodes/poses/poses_settings.h"
#include "nodes/primitives/instanced_mesh.h"
#include "nodes/text/text_maker.h"

namespace stillframe::nodes {

/// What came of the covariance of a pose.
struct CovarianceReport {
  std::optional<CovarianceError> position;  ///< why there is no ellipsoid
  std::optional<CovarianceError> rotation;  ///< why there is no cone
  int unbounded_axes = 0;                   ///< of the ellipsoid, left out: they say "unknown"
};

/// The nodes of one layer of poses: copies of arms, arrows and spheres, a line, a fill, an ellipsoid and a cone, a
/// name; each is there only when something is drawn with it. GUI thread.
class PoseShapes {
 public:
  /// Hangs its nodes beneath `parent`, which outlives it.
  explicit PoseShapes(osg::MatrixTransform& parent) : parent_(parent) {}
  ~PoseShapes();
  PoseShapes(const PoseShapes&) = delete;
  PoseShapes& operator=(const PoseShapes&) = delete;

  /// Shapes at the poses of `shown`, or of the trail where the settings want it. Costs 64 bytes a copy. What needs a
  /// buffer of more than `buffer_texels` is left out.
  void build(const PoseSet& shown, const PoseTrail* trail, const PosesSettings& settings, std::uint64_t buffer_texels);
  void clear();

  /// Which pose of those given to build() is hit, and where.
  struct PoseHit {
    bool is_of_trail = false;
    std::size_t index = 0;
    std::string part;  ///< "shape", "line", "fill", "covariance", "orientation"
  };
  [[nodiscard]] std::optional<PoseHit> poseAt(const scenegraph::PickHit& hit, const PoseSet& shown,
                                              const PoseTrail* trail, const PosesSettings& settings) const;

  /// In the poses' frame; invalid when nothing is drawn.
  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }
  /// Poses with a shape.
  [[nodiscard]] std::size_t shapes() const noexcept { return shapes_; }
  [[nodiscard]] std::size_t segments() const noexcept { return segments_; }
  /// Whether the shapes have directions.
  [[nodiscard]] bool showsRotations() const noexcept { return shows_rotations_; }
  /// Every how many poses there is a shape.
  [[nodiscard]] std::size_t stride() const noexcept { return stride_; }
  /// Whether a polygon should have been filled and could not be.
  [[nodiscard]] bool isFillRefused() const noexcept { return is_fill_refused_; }
  /// What was left out would need in one texture buffer; 0 when all is drawn.
  [[nodiscard]] std::uint64_t texelsTooMany() const noexcept { return texels_too_many_; }
  /// Of the line's colours; nullopt when there is no line, or one of one colour.
  [[nodiscard]] const std::optional<ValueRange>& lineRange() const noexcept { return line_range_; }
  [[nodiscard]] const CovarianceReport& covariance() const noexcept { return covariance_; }

 private:
  /// Copies of one mesh under way.
  struct Copies {
    std::vector<Instance> instances;
    bool is_blended = false;
  };
  void buildShapes(const PoseSet& poses, const PosesSettings& settings, scenegraph::PosesKind kind);
  void buildLine(const PoseSet& poses, const PosesSettings& settings);
  void buildFill(const PoseSet& polygon, const PosesSettings& settings);
  void buildCovariance(const PoseSet& poses, const PosesSettings& settings);
  void buildLabel(const PoseSet& poses, const PosesSettings& settings);
  /// Copies of `mesh`, which is always the same for a `shape` that is not "": those of the build before are used again.
  void hang(const TriangleMesh& mesh, const char* name, std::string_view shape, const glm::dvec3& origin,
            const Copies& copies);
  void forgetAllButMeshes();

  struct Hung {
    std::string shape;
    std::unique_ptr<InstancedMesh> mesh;
  };

  osg::MatrixTransform& parent_;
  std::vector<Hung> meshes_;
  std::vector<Hung> spare_;  // of the build before, during a build
  std::optional<LineDrawable> line_;
  std::optional<ValueRange> line_range_;
  osg::ref_ptr<osg::MatrixTransform> line_place_;
  TextMaker texts_;
  osg::ref_ptr<osg::MatrixTransform> label_;
  osg::BoundingBoxd box_;
  std::size_t shapes_ = 0;
  std::size_t segments_ = 0;
  std::size_t stride_ = 1;
  std::uint64_t buffer_texels_ = 0;
  std::uint64_t texels_too_many_ = 0;
  bool shows_rotations_ = false;
  bool is_fill_refused_ = false;
  CovarianceReport covariance_;
};

}  // namespace stillframe::nodes
