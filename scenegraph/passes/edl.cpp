#include "scenegraph/passes/edl.h"

#include "generated/stillframe_passes/shaders.h"

namespace stillframe::scenegraph {

namespace glsl = shaders::stillframe_passes;

EffectType edlEffect() {
  return makeEffectType<EdlSettings>(
      {.name = "edl", .label = "Eye-dome lighting", .help = "Shades by depth alone: shows the shape of point clouds"},
      {{{.key = "strength",
         .label = "Strength",
         .help = "How dark edges get: 1/4 of their light at 1, 1/16 at 2",
         .kind = SettingKind::Double,
         .minimum = 0.0,
         .maximum = 4.0},
        &EdlSettings::strength},
       {{.key = "radius",
         .label = "Radius (px)",
         .help = "Distance of the neighbours, in pixels of a picture 1080 high",
         .kind = SettingKind::Double,
         .minimum = 0.5,
         .maximum = 32.0},
        &EdlSettings::radius},
       {{.key = "neighbours",
         .label = "Neighbours",
         .help = "How many are looked at: more are slower and smoother",
         .kind = SettingKind::Int,
         .minimum = 4,
         .maximum = 128},
        &EdlSettings::neighbours}},
      appendEdl);
}

void appendEdl(const EdlSettings& settings, PostChain& chain) {
  const std::string color = chain.color();
  chain.passes.push_back(
      {.name = "edl",
       .fragment_source = glsl::k_edl_frag,
       .inputs = {{"u_image", color}, {"u_depth", "depth"}},
       .parameters = passParameters(std::pair{"u_strength", static_cast<float>(settings.strength)},
                                    std::pair{"u_radius", static_cast<float>(settings.radius)},
                                    std::pair{"u_neighbours", static_cast<int>(settings.neighbours)})});
}

}  // namespace stillframe::scenegraph
