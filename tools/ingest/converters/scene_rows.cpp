#include "tools/ingest/converters/scene_rows.h"

#include <utility>

#include "tf/transform_buffer.h"
#include "tools/ingest/converters/shapes.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest::converters {

namespace {

using namespace scenegraph;  // NOLINT(google-build-using-namespace): every primitive by its name

Shape arrowShape() {
  Shape shape;
  shape.row<&ArrowPrimitive::pose>("pose", poseShape())
      .field<&ArrowPrimitive::shaft_length>("shaft_length")
      .field<&ArrowPrimitive::shaft_diameter>("shaft_diameter")
      .field<&ArrowPrimitive::head_length>("head_length")
      .field<&ArrowPrimitive::head_diameter>("head_diameter")
      .row<&ArrowPrimitive::color>("color", colorShape());
  return shape;
}

/// Cube and Sphere.
template <typename Primitive>
Shape boxShape() {
  Shape shape;
  shape.row<&Primitive::pose>("pose", poseShape())
      .template row<&Primitive::size>("size", vectorShape())
      .template row<&Primitive::color>("color", colorShape());
  return shape;
}

Shape cylinderShape() {
  Shape shape = boxShape<CylinderPrimitive>();
  shape.field<&CylinderPrimitive::bottom_scale>("bottom_scale").field<&CylinderPrimitive::top_scale>("top_scale");
  return shape;
}

Shape lineShape() {
  Shape shape;
  shape.field<&LineRow::type>("type")
      .row<&LineRow::line, &LinePrimitive::pose>("pose", poseShape())
      .field<&LineRow::line, &LinePrimitive::thickness>("thickness")
      .field<&LineRow::line, &LinePrimitive::is_scale_invariant>("scale_invariant")
      .rows<&LineRow::line, &LinePrimitive::points>("points", vectorShape())
      .row<&LineRow::line, &LinePrimitive::color>("color", colorShape())
      .rows<&LineRow::line, &LinePrimitive::colors>("colors", colorShape())
      .field<&LineRow::line, &LinePrimitive::indices>("indices");
  return shape;
}

Shape triangleShape() {
  Shape shape;
  shape.row<&TrianglePrimitive::pose>("pose", poseShape())
      .rows<&TrianglePrimitive::points>("points", vectorShape())
      .row<&TrianglePrimitive::color>("color", colorShape())
      .rows<&TrianglePrimitive::colors>("colors", colorShape())
      .field<&TrianglePrimitive::indices>("indices");
  return shape;
}

Shape textShape() {
  Shape shape;
  shape.row<&TextPrimitive::pose>("pose", poseShape())
      .field<&TextPrimitive::is_billboard>("billboard")
      .field<&TextPrimitive::font_size>("font_size")
      .field<&TextPrimitive::is_scale_invariant>("scale_invariant")
      .row<&TextPrimitive::color>("color", colorShape())
      .field<&TextPrimitive::text>("text");
  return shape;
}

Shape modelShape() {
  Shape shape;
  shape.row<&ModelRow::model, &ModelPrimitive::pose>("pose", poseShape())
      .row<&ModelRow::model, &ModelPrimitive::scale>("scale", vectorShape())
      .row<&ModelRow::model, &ModelPrimitive::color>("color", colorShape())
      .field<&ModelRow::model, &ModelPrimitive::is_color_override>("override_color")
      .field<&ModelRow::model, &ModelPrimitive::url>("url")
      .field<&ModelRow::model, &ModelPrimitive::media_type>("media_type")
      .field<&ModelRow::data>("data");
  return shape;
}

Shape axesShape() {
  Shape shape;
  shape.row<&AxesPrimitive::pose>("pose", poseShape())
      .field<&AxesPrimitive::length>("length")
      .field<&AxesPrimitive::thickness>("thickness")
      .field<&AxesPrimitive::is_scale_invariant>("scale_invariant");
  return shape;
}

SceneEntity entityFromRow(EntityRow& row, const std::vector<LineType>& line_types, const MessageView& payloads,
                          std::vector<std::string>& faults) {
  SceneEntity entity = std::move(row.entity);
  entity.frame_id = std::string(tf::stripLeadingSlashes(entity.frame_id));
  entity.lifetime_ns = row.lifetime.ns;
  for (KeyValueRow& pair : row.metadata) {
    entity.metadata.emplace_back(std::move(pair.key), std::move(pair.value));
  }
  for (LineRow& line : row.lines) {
    if (line.type >= line_types.size()) {
      faults.push_back(sentence("a line of the entity '", entity.id, "' has the unknown type ", line.type));
      continue;
    }
    line.line.type = line_types[line.type];
    entity.lines.push_back(std::move(line.line));
  }
  for (ModelRow& model : row.models) {
    if (!model.data.empty()) {
      model.model.data = payloadOf(model.data, payloads);
    }
    entity.models.push_back(std::move(model.model));
  }
  return entity;
}

}  // namespace

Shape entityShape() {
  Shape pair;
  pair.field<&KeyValueRow::key>("key").field<&KeyValueRow::value>("value");
  Shape shape;
  shape.field<&EntityRow::entity, &SceneEntity::stamp>("timestamp")
      .field<&EntityRow::entity, &SceneEntity::frame_id>("frame_id")
      .field<&EntityRow::entity, &SceneEntity::id>("id")
      .field<&EntityRow::lifetime>("lifetime")
      .field<&EntityRow::entity, &SceneEntity::is_frame_locked>("frame_locked")
      .rows<&EntityRow::metadata>("metadata", std::move(pair))
      .optional()
      .rows<&EntityRow::entity, &SceneEntity::arrows>("arrows", arrowShape())
      .rows<&EntityRow::entity, &SceneEntity::cubes>("cubes", boxShape<CubePrimitive>())
      .rows<&EntityRow::entity, &SceneEntity::spheres>("spheres", boxShape<SpherePrimitive>())
      .rows<&EntityRow::entity, &SceneEntity::cylinders>("cylinders", cylinderShape())
      .rows<&EntityRow::lines>("lines", lineShape())
      .rows<&EntityRow::entity, &SceneEntity::triangles>("triangles", triangleShape())
      .rows<&EntityRow::entity, &SceneEntity::texts>("texts", textShape())
      .rows<&EntityRow::models>("models", modelShape())
      .optional()
      .rows<&EntityRow::entity, &SceneEntity::axes>("axes", axesShape())  // the host's addition
      .optional();
  return shape;
}

Shape deletionShape() {
  Shape shape;
  shape.field<&DeletionRow::deletion, &SceneEntityDeletion::stamp>("timestamp")
      .field<&DeletionRow::type>("type")
      .field<&DeletionRow::deletion, &SceneEntityDeletion::id>("id");
  return shape;
}

AnyObject sceneFromRow(SceneRow& row, const std::vector<LineType>& line_types, const MessageView& payloads) {
  SceneEntities scene;
  scene.payload_bytes = payloads.data.size();
  for (DeletionRow& deletion : row.deletions) {
    if (deletion.type > 1) {
      scene.faults.push_back(sentence("a deletion has the unknown type ", deletion.type));
      continue;
    }
    deletion.deletion.type =
        deletion.type == 0 ? SceneEntityDeletion::Type::MatchingId : SceneEntityDeletion::Type::All;
    scene.steps.push_back({true, scene.deletions.size()});
    scene.deletions.push_back(std::move(deletion.deletion));
  }
  for (EntityRow& entity : row.entities) {
    scene.steps.push_back({false, scene.entities.size()});
    scene.entities.push_back(entityFromRow(entity, line_types, payloads, scene.faults));
  }
  return AnyObject::make(std::move(scene));
}

}  // namespace stillframe::ingest::converters
