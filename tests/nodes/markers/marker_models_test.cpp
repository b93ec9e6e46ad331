// Models, and triangles with a texture.
#include <gmock/gmock.h>

#include <span>

#include "tests/nodes/markers/marker_builder.h"
#include "tests/nodes/scene_picture.h"
#include "tools/sample/image_writers.h"

namespace stillframe::test {
namespace {

using scenegraph::SceneEntity;
using testing::HasSubstr;

class MarkerModels : public ScenePictureTest {};

TEST_F(MarkerModels, DrawsEmbeddedMeshesAndNamesTheMissingOne) {
  const auto stl = std::make_shared<const std::string>(
      "solid s\n"
      "facet normal 0 0 1 outer loop vertex -0.5 -0.5 0 vertex 0.5 -0.5 0 vertex 0.5 0.5 0 endloop endfacet\n"
      "facet normal 0 0 1 outer loop vertex -0.5 -0.5 0 vertex 0.5 0.5 0 vertex -0.5 0.5 0 endloop endfacet\n"
      "endsolid s\n");
  SceneEntity entity = entityIn("map", "models");
  scenegraph::ModelPrimitive square{.pose = at(5, 5),
                                    .scale = {2, -2, 2},
                                    .color = kGreen,
                                    .is_color_override = true,
                                    .url = "",
                                    .media_type = "model/stl",
                                    .data = {std::as_bytes(std::span(*stl)), stl}};
  entity.models.push_back(square);
  open(datasetOf(sceneOf({entity})), "map");
  const auto& layer = add("/markers");
  const auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(layer.status(), scenegraph::Status{}) << layer.status().message;
  EXPECT_EQ(pixel(picture, 150, 50), (Bytes3{0, 255, 0}));
  EXPECT_EQ(drawnPixels(picture), 400);

  square.data = {};
  square.url = "package://nowhere/at_all.stl";
  square.pose = at(-5, -5);
  entity.models.push_back(square);
  entity.id = "6:models:7";
  entity.marker_namespace = "models";
  open(datasetOf(sceneOf({entity})), "map");
  const auto& other = add("/markers");
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 500) << "a box of 1 m stands for it";
  EXPECT_EQ(other.status().code, "UnknownPackage");
  EXPECT_THAT(other.status().message, testing::AllOf(HasSubstr("the marker 7 of 'models'"),
                                                     HasSubstr("package://nowhere/at_all.stl"), HasSubstr("a box")));
}

/// Two triangles over a square of 4 m, with the picture's first row at +y.
SceneEntity poster(std::vector<std::byte> picture) {
  SceneEntity entity = entityIn("map", "0::3");
  scenegraph::TrianglePrimitive& square = entity.triangles.emplace_back();
  square.points = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
  square.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}};
  square.texture_url = "embedded://poster";
  const auto bytes = std::make_shared<const std::vector<std::byte>>(std::move(picture));
  square.texture = {*bytes, bytes};
  return entity;
}

TEST_F(MarkerModels, DrawsTrianglesWithATextureOfTheMessage) {
  // Red and green above blue and white, in blocks that filtering leaves alone at their middles.
  std::vector<std::uint8_t> rgb;
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) {
      const Bytes3 color = row < 8 ? (column < 8 ? Bytes3{255, 0, 0} : Bytes3{0, 255, 0})
                                   : (column < 8 ? Bytes3{0, 0, 255} : Bytes3{255, 255, 255});
      for (const int channel : color) {
        rgb.push_back(static_cast<std::uint8_t>(channel));
      }
    }
  }
  SceneEntity entity = poster(sample::writeRgbPng(16, rgb));
  const auto open_with = [&](const SceneEntity& shown) -> const scenegraph::Layer& {
    open(datasetOf(sceneOf({shown})), "map");
    return add("/markers");
  };
  const auto& layer = open_with(entity);
  auto picture = draw(1_s, fromAbove());
  EXPECT_EQ(layer.status(), scenegraph::Status{}) << layer.status().message;
  EXPECT_EQ(drawnPixels(picture), 1600);
  EXPECT_EQ(pixel(picture, 90, 90), (Bytes3{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 110, 90), (Bytes3{0, 255, 0}));
  EXPECT_EQ(pixel(picture, 90, 110), (Bytes3{0, 0, 255}));
  EXPECT_EQ(pixel(picture, 110, 110), (Bytes3{255, 255, 255}));
  entity.triangles[0].color = {0.0F, 1.0F, 0.0F, 1.0F};
  open_with(entity);
  picture = draw(1_s, fromAbove());
  EXPECT_EQ(pixel(picture, 90, 90), (Bytes3{0, 0, 0})) << "colours multiply the picture";
  EXPECT_EQ(pixel(picture, 110, 110), (Bytes3{0, 255, 0}));
}

TEST_F(MarkerModels, DrawsTrianglesWithoutTheTextureThatIsMissingOrBroken) {
  SceneEntity entity = poster({std::byte{1}, std::byte{2}, std::byte{3}});
  entity.triangles[0].color = kGreen;
  open(datasetOf(sceneOf({entity})), "map");
  const auto* layer = &add("/markers");
  EXPECT_EQ(pixel(draw(1_s, fromAbove()), 100, 100), (Bytes3{0, 255, 0}));
  EXPECT_EQ(layer->status().code, "TextureUnreadable");
  EXPECT_THAT(layer->status().message, HasSubstr("the marker '3': its texture, in the message"));
  entity.triangles[0].texture = {};
  entity.triangles[0].texture_url = "package://nowhere/poster.png";
  open(datasetOf(sceneOf({entity})), "map");
  layer = &add("/markers");
  EXPECT_EQ(pixel(draw(1_s, fromAbove()), 100, 100), (Bytes3{0, 255, 0}));
  EXPECT_EQ(layer->status().code, "TextureMissing");
  EXPECT_THAT(layer->status().message, HasSubstr("package://nowhere/poster.png"));
}

}  // namespace
}  // namespace stillframe::test
