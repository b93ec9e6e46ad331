#include "tools/cli/layer_ids.h"

#include <cmath>
#include <limits>

namespace stillframe::cli {

std::expected<void, scenegraph::Status> addLayerIds(scenegraph::OffscreenRenderer& renderer, SceneSession& session,
                                                    const scenegraph::CameraView& view,
                                                    const scenegraph::RenderOptions& options,
                                                    scenegraph::Picture& picture) {
  scenegraph::RenderOptions plain = options;
  plain.post = {};
  plain.background.a = 1.0F;
  const auto all = renderer.render(session.scene().root(), view, plain);
  if (!all) {
    return std::unexpected(all.error());
  }
  const auto& layers = session.scene().layers();
  std::vector<bool> was_visible;
  for (const auto& slot : layers) {
    was_visible.push_back(slot->layer->isVisible());
  }
  picture.layer_ids.assign(all->depth_m.size(), 0U);
  std::vector<float> nearest(all->depth_m.size(), std::numeric_limits<float>::infinity());  // metres off
  std::expected<void, scenegraph::Status> result;
  for (std::size_t shown = 0; shown < layers.size() && result; ++shown) {
    picture.layer_names.push_back(layers[shown]->id);
    if (!was_visible[shown]) {
      continue;
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
      layers[i]->layer->setVisible(i == shown);
    }
    session.showTime(session.time());
    const auto alone = renderer.render(session.scene().root(), view, plain);
    if (!alone) {
      result = std::unexpected(alone.error());
      continue;
    }
    for (std::size_t i = 0; i < all->depth_m.size(); ++i) {
      // What lies on one plane with others may be drawn a step deeper in their company: nearly the same counts too.
      const float off = std::abs(alone->depth_m[i] - all->depth_m[i]);
      if (std::isfinite(all->depth_m[i]) && off < nearest[i]) {
        nearest[i] = off;
        picture.layer_ids[i] = static_cast<std::uint32_t>(shown + 1);
      }
    }
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    layers[i]->layer->setVisible(was_visible[i]);
  }
  session.showTime(session.time());
  return result;
}

}  // namespace stillframe::cli
