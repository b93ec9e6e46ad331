#include "tools/cli/picture_legend.h"

#include <algorithm>
#include <cmath>

#include "nodes/legend/legend_picture.h"

namespace stillframe::cli {
namespace {

constexpr double kDesignHeight = 720.0;  // of a picture in which a legend has its own size
constexpr double kMostOfPicture = 0.9;   // of its height
constexpr double kMargin = 10.0;

float linearFromByte(std::uint8_t byte) {
  const double srgb = byte / 255.0;
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

}  // namespace

void addLegends(const scenegraph::Scene& scene, scenegraph::Picture& picture) {
  const double scale = std::clamp(picture.height / kDesignHeight, 0.75, 8.0);
  const nodes::LegendPicture legend =
      nodes::drawLegends(nodes::legendEntries(scene), scale, static_cast<int>(picture.height * kMostOfPicture));
  const int margin = static_cast<int>(std::lround(kMargin * scale));
  const int left = picture.width - legend.width - margin;
  const int top = picture.height - legend.height - margin;
  if (legend.isEmpty() || left < 0 || top < 0) {
    return;
  }
  for (int y = 0; y < legend.height; ++y) {
    for (int x = 0; x < legend.width; ++x) {
      const std::uint8_t* const above =
          &legend.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(legend.width) +
                            static_cast<std::size_t>(x))];
      float* const pixel =
          &picture.rgba[4 * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(left + x))];
      const float share = static_cast<float>(above[3]) / 255.0F;
      const float alpha = share + pixel[3] * (1.0F - share);
      for (int i = 0; i < 3 && alpha > 0.0F; ++i) {
        pixel[i] = (linearFromByte(above[i]) * share + pixel[i] * pixel[3] * (1.0F - share)) / alpha;
      }
      pixel[3] = alpha;
    }
  }
}

}  // namespace stillframe::cli
