#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/markers/frame_parts.h"
#include "nodes/markers/markers_settings.h"
#include "nodes/markers/scene_state.h"
#include "nodes/text/text_maker.h"
#include "scenegraph/frame_graph.h"
#include "scenegraph/pick/pick_hit.h"
#include "scenegraph/pick/picked.h"

namespace stillframe::nodes {

/// The nodes of one topic's entities, beneath all the frames they name.
///
/// show() writes what differs from the state shown before, in place, and what is drawn does not depend on that state.
/// GUI thread.
class MarkerPicture {
 public:
  MarkerPicture(scenegraph::FrameGraph& frames, std::string name);
  ~MarkerPicture();

  /// What needs a texture buffer of more than `buffer_texels` is left out.
  void show(std::shared_ptr<const SceneState> state, const MarkersSettings& settings, std::uint64_t buffer_texels);
  /// The models to load; and those that were. Call after show().
  [[nodiscard]] WantedModels wantedModels() const;
  void setModels(const std::shared_ptr<const ModelSet>& models);
  /// Why the first of the models that failed did.
  [[nodiscard]] std::optional<scenegraph::Status> modelFailure() const;
  /// Draws nothing and holds no frame.
  void clear();

  /// The entity that is hit, with its fields; nullopt when it is none of these.
  [[nodiscard]] std::optional<scenegraph::Picked> describe(const scenegraph::PickHit& hit) const;

  struct Counts {
    std::uint64_t entities = 0;    ///< drawn, as far as they have a place
    std::uint64_t primitives = 0;  ///< of these
    std::uint64_t hidden = 0;      ///< entities in namespaces that are switched off
    std::uint64_t draw_calls = 0;
    std::uint64_t left_out = 0;  ///< lines, triangles, texts (RestParts)
    std::uint64_t failed_models = 0;
    std::uint64_t texels_too_many = 0;  ///< that the largest thing left out for its size needs; 0: all is drawn
  };
  [[nodiscard]] Counts counts() const;
  void collectNodes(std::vector<osg::Node*>& nodes) const;
  /// Of the entities that are there, drawn or not.
  [[nodiscard]] std::set<std::string> namespaces() const;
  /// Another number whenever they have become others.
  [[nodiscard]] std::uint64_t namespacesRevision() const noexcept { return namespaces_revision_; }
  /// Frames that something is drawn in, in the order of their names.
  [[nodiscard]] std::vector<std::string> frames() const;
  [[nodiscard]] osg::BoundingBoxd boxIn(const std::string& frame) const;
  /// Log time of the oldest entity drawn in that frame that is not frame-locked.
  [[nodiscard]] std::optional<tf::TimePoint> oldestFree(const std::string& frame) const;

 private:
  struct Change {
    std::size_t slot = 0;
    const LiveEntity* before = nullptr;
    const LiveEntity* after = nullptr;
  };
  FrameParts& partsOf(const std::string& frame);
  void count(const LiveEntity* entity, bool is_there);
  [[nodiscard]] bool isShown(const LiveEntity& entity) const;
  std::set<std::pair<std::string, ShapeBatchKey>> openBatches(const SceneState& state);
  void writeShapes(const LiveEntity& entity) const;
  void dropEmptyFrames();

  scenegraph::FrameGraph& frame_graph_;
  std::string name_;
  TextMaker texts_;
  MarkersSettings settings_;
  std::shared_ptr<const SceneState> shown_;
  std::map<std::string, std::unique_ptr<FrameParts>> parts_;
  std::map<std::string, std::uint64_t> namespaces_;
  std::uint64_t namespaces_revision_ = 0;
  std::map<std::string, std::map<std::int64_t, std::uint64_t>> free_;  // by frame and log time: how many
  std::uint64_t entities_ = 0;
  std::uint64_t primitives_ = 0;
  std::uint64_t hidden_ = 0;
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels;
};

}  // namespace stillframe::nodes
