#include "scenegraph/pipeline/post_chain.h"

#include <algorithm>

namespace stillframe::scenegraph {

int bytesPerTexel(TargetFormat format) noexcept {
  switch (format) {
    case TargetFormat::R16F:
      return 2;
    case TargetFormat::Rgba8:
    case TargetFormat::R11G11B10F:
      return 4;
    case TargetFormat::Rgba16F:
      return 8;
    case TargetFormat::Rgba32F:
      return 16;
  }
  return 16;
}

bool isSameStructure(const PostChain& a, const PostChain& b) {
  return a.msaa_samples == b.msaa_samples && a.scene_format == b.scene_format &&
         std::ranges::equal(a.passes, b.passes, [](const PostPass& x, const PostPass& y) {
           return x.name == y.name && x.fragment_source == y.fragment_source && x.inputs == y.inputs &&
                  x.format == y.format && x.divisor == y.divisor && x.sub_frames == y.sub_frames &&
                  (x.parameters == nullptr) == (y.parameters == nullptr);
         });
}

double bytesPerPixel(const PostChain& chain) {
  constexpr int kDepthBytes = 4;
  const int samples = std::max(1, chain.msaa_samples);
  double bytes = bytesPerTexel(chain.scene_format) + kDepthBytes;
  if (samples > 1) {
    bytes += samples * bytes;
  }
  // Colour goes to and fro between two targets of a format; a pass of another format or size has its own.
  std::vector<std::pair<TargetFormat, int>> counted{{chain.scene_format, 1}};
  for (const PostPass& pass : chain.passes) {
    const std::pair key{pass.format, pass.divisor};
    if (std::ranges::count(counted, key) < 2) {
      counted.push_back(key);
      bytes += static_cast<double>(bytesPerTexel(pass.format)) / (pass.divisor * pass.divisor);
    }
  }
  return bytes;
}

}  // namespace stillframe::scenegraph
