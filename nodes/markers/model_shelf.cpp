#include "nodes/markers/model_shelf.h"

#include <algorithm>
#include <utility>

#include "nodes/markers/textured_triangles.h"
#include "nodes/meshes/mesh_loader.h"
#include "nodes/primitives/triangle_mesh.h"

namespace stillframe::nodes {
namespace {

using scenegraph::ModelPrimitive;
using scenegraph::Status;
using scenegraph::StatusLevel;
using scenegraph::TrianglePrimitive;

std::string keyOf(const void* at, std::size_t size) {
  return std::to_string(reinterpret_cast<std::uintptr_t>(at)) + "+" + std::to_string(size);
}

ShelfModel placeholder(Status failure) {
  return {std::make_shared<const MeshArrays>(boxMesh()), std::move(failure), true};
}

ShelfModel loadMesh(const MeshLoader& loader, const ModelPrimitive& model) {
  const auto mesh =
      model.data.bytes.empty() ? loader.load(model.url) : loader.loadBytes(model.data.bytes, model.media_type);
  if (!mesh) {
    return placeholder(mesh.error());
  }
  ShelfModel loaded{std::make_shared<const MeshArrays>(**mesh), std::nullopt};
  if (!(*mesh)->remarks.empty()) {
    loaded.failure =
        Status{StatusLevel::Warn, "MeshIncomplete",
               (model.data.bytes.empty() ? "'" + model.url + "'" : std::string("the mesh in the message")) + ": " +
                   (*mesh)->remarks};
  }
  return loaded;
}

ShelfModel loadTriangles(const MeshLoader& loader, const TrianglePrimitive& triangles) {
  TexturedTriangles made = texturedTriangles(triangles, loader);
  return {std::make_shared<const MeshArrays>(made.mesh), std::move(made.failure), false, made.origin};
}

ShelfModel load(const MeshLoader& loader, const std::string& key, const scenegraph::SceneEntity& entity) {
  const auto isNamed = [&](const auto& primitive) { return modelKey(primitive) == key; };
  if (const auto model = std::ranges::find_if(entity.models, isNamed); model != entity.models.end()) {
    return loadMesh(loader, *model);
  }
  const auto triangles = std::ranges::find_if(entity.triangles, isNamed);
  return triangles != entity.triangles.end() ? loadTriangles(loader, *triangles)
                                             : placeholder({StatusLevel::Error, "MeshMissing", "the model is gone"});
}

}  // namespace

std::string modelKey(const ModelPrimitive& model) {
  return model.data.bytes.empty()
             ? model.url
             : "data:" + keyOf(model.data.bytes.data(), model.data.bytes.size()) + model.media_type;
}

std::string modelKey(const TrianglePrimitive& triangles) {
  return "triangles:" + keyOf(triangles.points.data(), triangles.points.size());
}

bool isTextured(const TrianglePrimitive& triangles) { return !triangles.uvs.empty(); }

ModelShelf::ModelShelf(const scenegraph::LayerContext& context)
    : dataset_(context.dataset.shared_from_this()), job_(context.executor, context.request_update) {}

void ModelShelf::want(const WantedModels& wanted) {
  const bool is_there =
      std::ranges::all_of(wanted, [&](const auto& model) { return models_->models.contains(model.first); });
  if (is_there) {
    job_.cancel();
    return;
  }
  scenegraph::CacheKey key;
  key.product = "models";
  for (const auto& [name, entity] : wanted) {
    key.product += "\n" + name;
  }
  job_.request(key, [dataset = dataset_, wanted, known = models_]() -> scenegraph::LatestJob<ModelSet>::Result {
    const MeshLoader loader(dataset->cache(), dataset->resources());
    auto set = std::make_shared<ModelSet>();
    for (const auto& [name, entity] : wanted) {
      const auto found = known->models.find(name);
      const bool is_known = found != known->models.end();
      set->models.emplace(name, is_known ? found->second : load(loader, name, *entity));
      set->owners.emplace(name, is_known ? known->owners.at(name) : entity);
    }
    return set;
  });
  if (auto outcome = job_.take(); outcome && outcome->result) {
    models_ = *outcome->result;
  }
}

}  // namespace stillframe::nodes
