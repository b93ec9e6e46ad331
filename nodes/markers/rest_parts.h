#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <osg/BoundingBox>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <utility>
#include <vector>

#include "nodes/lines/line_drawable.h"
#include "nodes/markers/model_parts.h"
#include "nodes/primitives/triangle_drawable.h"
#include "nodes/text/text_maker.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/pick/pick_hit.h"

namespace stillframe::nodes {

/// Lines, triangles, texts and models of the entities in one frame.
///
/// Lines share a draw call, triangles another, translucent ones two more; a change among them makes them anew, at the
/// cost of all lines and triangles in the frame. A text is a node of its own and changes alone. GUI thread.
class RestParts {
 public:
  /// Texts beyond are left out: a draw call each.
  static constexpr std::size_t kMostTexts = 5000;

  RestParts(const std::string& name, TextMaker& texts);

  /// What the entity in `slot` has; nullptr: nothing (any more).
  void set(std::size_t slot, std::shared_ptr<const scenegraph::SceneEntity> entity);
  void setLook(double opacity, bool shows_texts);
  /// What the driver takes in one texture buffer; lines that need more are not drawn.
  void setBufferTexels(std::uint64_t texels);
  /// What lines left out for that would need; 0 when all are drawn.
  [[nodiscard]] std::uint64_t texelsTooMany() const noexcept;
  /// Call once after changes.
  void commit();
  void setModels(std::shared_ptr<const ModelSet> models) { models_.setModels(std::move(models)); }
  void collectModels(WantedModels& wanted) const { ModelParts::collect(entities_, wanted); }
  [[nodiscard]] const ModelParts& models() const noexcept { return models_; }
  /// Adds the nodes to draw, in an order that does not depend on what came before.
  void list(std::vector<osg::Node*>& nodes) const;

  /// What is hit of the entity in which slot, and where in the frame.
  struct RestHit {
    std::size_t slot = 0;
    const char* primitive = "";  ///< "line", "triangles", "model", "text"
    glm::dvec3 point_in_frame{0.0};
  };
  [[nodiscard]] std::optional<RestHit> entityAt(const scenegraph::PickHit& hit) const;

  [[nodiscard]] bool isEmpty() const noexcept { return entities_.empty(); }
  /// In the frame; invalid for nothing.
  [[nodiscard]] const osg::BoundingBoxd& box() const noexcept { return box_; }
  [[nodiscard]] std::size_t drawCalls() const noexcept;
  /// Lines, triangles or texts left out, as their numbers make no sense or there are too many.
  [[nodiscard]] std::size_t leftOut() const noexcept { return unsound_ + texts_left_out_; }

 private:
  /// Where the parts of each entity end in what is drawn together: a number of points or triangles, and the slot.
  using Ends = std::vector<std::pair<std::size_t, std::size_t>>;
  struct Strokes {
    osg::ref_ptr<osg::MatrixTransform> node;
    std::unique_ptr<LineDrawable> lines;
    bool is_drawn = false;
    Ends ends;
  };
  void makeLines();
  void makeTriangles();
  void makeTexts(std::size_t slot);
  void dropTexts(std::size_t slot);

  TextMaker& text_maker_;
  ModelParts::Entities entities_;
  std::array<Strokes, 2> strokes_;  // opaque, translucent
  std::array<std::unique_ptr<TriangleDrawable>, 2> surfaces_;
  std::array<Ends, 2> surface_ends_;
  struct Texts {
    osg::ref_ptr<osg::Group> node;
    osg::BoundingBoxd box;
    std::size_t count = 0;
  };
  std::map<std::size_t, Texts> texts_;
  std::size_t text_count_ = 0;
  bool has_new_lines_ = false;
  bool has_new_triangles_ = false;
  bool has_new_look_ = true;
  double opacity_ = 1.0;
  bool shows_texts_ = true;
  std::size_t unsound_lines_ = 0;
  std::size_t unsound_triangles_ = 0;
  std::size_t unsound_ = 0;
  std::size_t texts_left_out_ = 0;
  ModelParts models_;
  osg::BoundingBoxd lines_box_;
  osg::BoundingBoxd box_;
};

}  // namespace stillframe::nodes
