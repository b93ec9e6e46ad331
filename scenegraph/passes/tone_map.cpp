#include "scenegraph/passes/tone_map.h"

#include <cmath>

#include "generated/stillframe_passes/shaders.h"

namespace stillframe::scenegraph {

namespace glsl = shaders::stillframe_passes;

EffectType toneMapEffect() {
  return makeEffectType<ToneMapSettings>(
      {.name = "tonemap",
       .label = "Exposure and tone mapping",
       .help = "Grades lit and photographic colours; data colours stay as their legend has them",
       .is_for_display = true},
      {{{.key = "curve",
         .label = "Curve",
         .help = "none: exposure alone; aces: filmic, with contrast; neutral: true to colours, bright ones rolled off",
         .kind = SettingKind::Text,
         .choices = {"none", "aces", "neutral"},
         .choices_only = true},
        &ToneMapSettings::curve},
       {{.key = "exposure",
         .label = "Exposure (EV)",
         .help = "Each step doubles the light of what is graded",
         .kind = SettingKind::Double,
         .minimum = -16.0,
         .maximum = 16.0},
        &ToneMapSettings::exposure}},
      appendToneMap);
}

void appendToneMap(const ToneMapSettings& settings, PostChain& chain) {
  const std::string color = chain.color();
  const int curve = settings.curve == "aces" ? 1 : settings.curve == "neutral" ? 2 : 0;
  chain.passes.push_back(
      {.name = "tonemap",
       .fragment_source = glsl::k_tone_map_frag,
       .inputs = {{"u_image", color}},
       .parameters = passParameters(std::pair{"u_gain", static_cast<float>(std::exp2(settings.exposure))},
                                    std::pair{"u_curve", curve})});
}

}  // namespace stillframe::scenegraph
