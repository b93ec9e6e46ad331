#include "tools/sample/sign_markers.h"

#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <utility>

#include "tools/sample/image_writers.h"

namespace stillframe::sample {
namespace {

constexpr int kWidth_px = 128;
constexpr int kHeight_px = 64;

/// A yellow board with a black arrow to the right, striped along its upper and lower edge.
std::vector<std::byte> boardPng() {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      const int from_middle = std::abs(2 * y + 1 - kHeight_px) / 2;
      const bool is_stripe = from_middle >= 24 && (x + y) / 8 % 2 == 0;
      const bool is_shaft = from_middle < 6 && x >= 24 && x < 72;
      const bool is_head = x >= 72 && x < 104 && from_middle < (104 - x) / 2 + 2;
      const bool is_black = is_stripe || is_shaft || is_head;
      for (const int value : {250, 200, 30}) {
        rgb.push_back(static_cast<std::uint8_t>(is_black ? 20 : value));
      }
    }
  }
  return writeRgbPng(kWidth_px, rgb);
}

Marker board() {
  Marker marker;
  marker.frame_id = "map";
  marker.ns = "signs";
  marker.type = Marker::Type::TriangleList;
  marker.pose.translation = {10.5, 9.95, 3.2};
  constexpr double kHalfLength_m = 1.4;
  constexpr double kHalfHeight_m = 0.7;
  for (const auto& [u, v] :
       {std::pair{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}}) {
    marker.points.emplace_back((2.0 * u - 1.0) * kHalfLength_m, 0.0, (1.0 - 2.0 * v) * kHalfHeight_m);
    marker.uvs.emplace_back(u, v);
  }
  marker.texture_resource = "embedded://board.png";
  marker.texture_png = boardPng();
  return marker;
}

/// As a Wavefront file: a cone upon a square foot.
std::vector<std::byte> coneObj() {
  constexpr int kSides = 16;
  std::ostringstream text;
  text << "# a traffic cone, 0.7 m high\n" << std::fixed << std::setprecision(4);
  for (const double z : {0.0, 0.04}) {
    for (const auto& [x, y] : {std::pair{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}) {
      text << "v " << x << ' ' << y << ' ' << z << '\n';
    }
  }
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    text << "v " << 0.15 * std::cos(angle) << ' ' << 0.15 * std::sin(angle) << " 0.04\n";
  }
  text << "v 0 0 0.7\nf 4 3 2 1\nf 5 6 7 8\n";
  for (int i = 1; i <= 4; ++i) {
    const int next = i % 4 + 1;
    text << "f " << i << ' ' << next << ' ' << next + 4 << ' ' << i + 4 << '\n';
  }
  constexpr int kFirst = 9;
  for (int i = 0; i < kSides; ++i) {
    text << "f " << kFirst + i << ' ' << kFirst + (i + 1) % kSides << ' ' << kFirst + kSides << '\n';
  }
  const std::string written = text.str();
  const auto bytes = std::as_bytes(std::span(written));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<Marker> makeSigns() {
  std::vector<Marker> signs{board()};
  for (const double x : {8.2, 8.2 + 4.6}) {
    Marker cone;
    cone.frame_id = "map";
    cone.ns = "signs";
    cone.id = static_cast<std::int32_t>(signs.size());
    cone.type = Marker::Type::Mesh;
    cone.pose.translation = {x, 6.6, 0.0};
    cone.rgba = {1.0F, 0.35F, 0.05F, 1.0F};
    cone.mesh_resource = "embedded://cone.obj";
    cone.mesh_filename = "cone.obj";
    cone.mesh_data = coneObj();
    signs.push_back(std::move(cone));
  }
  return signs;
}

}  // namespace stillframe::sample
