#include "nodes/markers/model_shelf.h"

#include <algorithm>
#include <utility>

#include "nodes/meshes/mesh_loader.h"

namespace stillframe::nodes {
namespace {

using scenegraph::ModelPrimitive;

ModelSet::Loaded load(const MeshLoader& loader, const std::string& key, const scenegraph::SceneEntity& entity) {
  const auto model = std::ranges::find(entity.models, key, modelKey);
  if (model == entity.models.end()) {
    return std::unexpected(scenegraph::Status{scenegraph::StatusLevel::Error, "MeshMissing", "the model is gone"});
  }
  const auto mesh =
      model->data.bytes.empty() ? loader.load(model->url) : loader.loadBytes(model->data.bytes, model->media_type);
  if (!mesh) {
    return std::unexpected(mesh.error());
  }
  return std::make_shared<const MeshArrays>(**mesh);
}

}  // namespace

std::string modelKey(const ModelPrimitive& model) {
  return model.data.bytes.empty()
             ? model.url
             : "data:" + std::to_string(reinterpret_cast<std::uintptr_t>(model.data.bytes.data())) + "+" +
                   std::to_string(model.data.bytes.size()) + model.media_type;
}

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
      set->models.emplace(name, found != known->models.end() ? found->second : load(loader, name, *entity));
    }
    return set;
  });
  if (auto outcome = job_.take(); outcome && outcome->result) {
    models_ = *outcome->result;
  }
}

}  // namespace stillframe::nodes
