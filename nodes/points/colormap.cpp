#include "nodes/points/colormap.h"

#include <algorithm>
#include <cmath>

namespace stillframe::nodes {
namespace {

using Anchors = std::array<SrgbColor, Colormap::kAnchors>;

consteval float hexByte(const char* at) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  return static_cast<float>(digit(at[0]) * 16 + digit(at[1])) / 255.0F;
}

/// Anchors written as "rrggbb" each.
consteval Anchors fromHex(const char (&hex)[6 * Colormap::kAnchors + 1]) {
  Anchors anchors{};
  for (std::size_t i = 0; i < Colormap::kAnchors; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      anchors[i][c] = hexByte(hex + 6 * i + 2 * c);
    }
  }
  return anchors;
}

constexpr float position(std::size_t anchor) {
  return static_cast<float>(anchor) / static_cast<float>(Colormap::kAnchors - 1);
}

constexpr Anchors grayscale() {
  Anchors anchors{};
  for (std::size_t i = 0; i < Colormap::kAnchors; ++i) {
    anchors[i] = {position(i), position(i), position(i)};
  }
  return anchors;
}

/// The classic rainbow: three trapezoids whose corners are multiples of 1/8.
constexpr Anchors jet() {
  Anchors anchors{};
  const auto trapezoid = [](float distance) {
    return std::clamp(1.5F - (distance < 0.0F ? -distance : distance), 0.0F, 1.0F);
  };
  for (std::size_t i = 0; i < Colormap::kAnchors; ++i) {
    const float t = 4.0F * position(i);
    anchors[i] = {trapezoid(t - 3.0F), trapezoid(t - 2.0F), trapezoid(t - 1.0F)};
  }
  return anchors;
}

constexpr std::array<Colormap, 9> kColormaps = {{
    {"viridis",
     fromHex("440154470d6048186a482374472d7b4536814240863f49893b528b375a8d33638d2f6a8e2c728e297a8e26818e23898e"
             "21908c1f988b1f9f8821a68528ae8031b57b3ebc744cc26c5dc9636ece5882d34c96d83fabdc32c0df24d5e21aeae51a"
             "fde725")},
    {"turbo", fromHex("30123b392a734040a14456c7466be3467ff64293ff37a7fa29bbec1dcdd818dcc31ee8b031f2994cf97e6bfd648aff4d"
                      "a3fd3cb8f735cced34dee037edd03af8c03afdae35fe982cfb8022f56817ec520fe04009d23105c02302ac1701950d01"
                      "7a0403")},
    {"plasma",
     fromHex("0d08872206903105963f049c4c02a15901a56600a77201a87e03a88909a69511a29f1a9ca92396b22c8ebb3587c33e80"
             "cb4778d25071d9596ae06263e66c5ceb7555f07f4ff48a48f89441fb9f3afdab33feb72dfdc328fcd025f9dd25f5eb27"
             "f0f921")},
    {"inferno",
     fromHex("0000040403120b0724150b37210c4a2e0a5a3c09654a0c6b57106d63146e70196e7d1e6d89226a962766a32b61af315c"
             "bb3755c63e4dd14644db4f3be35932eb6528f1711ef67f14f98d0afb9c06fcab0ffbba1ff9ca32f5d949f2e865f3f586"
             "fcffa4")},
    {"magma", fromHex("0000040303110a0822130d331d114628115a36106a430f7650127c5d177f691c817621818226818f2a819c2e7fa9327d"
                      "b63779c33b75cf4170db486ae65163ee5c5ef5695cf9785dfb8761fd9668fea571feb47bfec387fed194fde0a2fceeb0"
                      "fcfdbf")},
    {"cividis",
     fromHex("00224e00285b002e6a0433711a386f273e6e32436d3b496c434e6c4b546c52596d5a5f6e61656f686a716f7073757676"
             "7c7b788481798b8778938d789b9376a39a75aba072b3a670bbad6cc3b469ccba64d4c15fddc958e6d051efd748f8df3c"
             "fee838")},
    {"coolwarm",
     fromHex("3b4cc0445acc4d68d75775e16282ea6c8ef1779af782a5fb8db0fe98b9ffa3c2feaec9fcb8d0f9c2d5f4ccd9eed5dbe6"
             "dddddde5d8d1ecd3c5f1ccb9f4c4adf7bba0f7b194f7a687f49a7bf18d6fec7f63e57058de604dd55042cb3e38c0282f"
             "b40426")},
    {"grayscale", grayscale()},
    {"jet", jet()},
}};

}  // namespace

SrgbColor Colormap::at(double t) const noexcept {
  const double x = (t > 0.0 ? std::min(t, 1.0) : 0.0) * static_cast<double>(kAnchors - 1);
  const auto below = std::min(static_cast<std::size_t>(x), kAnchors - 2);
  const auto weight = static_cast<float>(x - static_cast<double>(below));
  SrgbColor color{};
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = anchors[below][c] + (anchors[below + 1][c] - anchors[below][c]) * weight;
  }
  return color;
}

std::span<const Colormap> colormaps() { return kColormaps; }

const Colormap* findColormap(std::string_view name) {
  const auto found = std::ranges::find(kColormaps, name, &Colormap::name);
  return found == kColormaps.end() ? nullptr : &*found;
}

}  // namespace stillframe::nodes
