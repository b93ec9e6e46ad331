#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Group>
#include <osg/ref_ptr>
#include <string>
#include <utility>

#include "nodes/markers/entity_shapes.h"
#include "nodes/markers/rest_parts.h"
#include "nodes/primitives/instanced_mesh.h"
#include "nodes/text/text_maker.h"

namespace stillframe::nodes {

/// What a topic's entities in one frame are drawn with: an InstancedMesh for each batch of shapes, and the rest. GUI
/// thread.
class FrameParts {
 public:
  FrameParts(const std::string& name, TextMaker& texts);

  [[nodiscard]] osg::Group& node() const noexcept { return *node_; }
  /// Makes room for `size` copies; true when the mesh was made anew, finer or coarser, and is empty.
  bool open(const ShapeBatchKey& key, std::uint32_t size);
  /// nullptr when it is not open.
  [[nodiscard]] InstancedMesh* batch(const ShapeBatchKey& key) const;
  /// Drops those batches that `is_kept` does not name.
  template <typename IsKept>
  void close(IsKept is_kept) {
    std::erase_if(batches_, [&](const auto& batch) { return !is_kept(batch.first); });
  }
  /// The batch that is hit, and its mesh; nullopt when it is none.
  [[nodiscard]] std::optional<std::pair<ShapeBatchKey, const InstancedMesh*>> batchAt(
      const scenegraph::PickHit& hit) const;
  [[nodiscard]] RestParts& rest() noexcept { return rest_; }
  [[nodiscard]] const RestParts& rest() const noexcept { return rest_; }
  void setLook(double opacity, bool shows_texts);
  /// What the driver takes in one texture buffer; what needs more is not drawn.
  void setBufferTexels(std::uint64_t texels);
  void commit();
  /// What the largest thing left out for that would need; 0 when all is drawn.
  [[nodiscard]] std::uint64_t texelsTooMany() const;

  [[nodiscard]] bool isEmpty() const noexcept { return batches_.empty() && rest_.isEmpty(); }
  /// In the frame; invalid for nothing.
  [[nodiscard]] osg::BoundingBoxd box() const;
  [[nodiscard]] std::size_t drawCalls() const;

 private:
  struct Batch {
    std::unique_ptr<InstancedMesh> mesh;
    unsigned detail = 0;
  };
  void applyLook(const ShapeBatchKey& key, InstancedMesh& mesh) const;

  std::string name_;
  osg::ref_ptr<osg::Group> node_;
  std::map<ShapeBatchKey, Batch> batches_;
  RestParts rest_;
  double opacity_ = 1.0;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
};

}  // namespace stillframe::nodes
