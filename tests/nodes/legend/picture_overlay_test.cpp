#include "nodes/legend/picture_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scenegraph/srgb.h"

namespace stillframe::nodes {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr PixelColor kRed{255, 0, 0, 255};

/// A picture of one colour, in linear light, premultiplied.
std::vector<float> plain(float light, float alpha) {
  std::vector<float> rgba;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    rgba.insert(rgba.end(), {light * alpha, light * alpha, light * alpha, alpha});
  }
  return rgba;
}

std::array<float, 4> at(const std::vector<float>& rgba, int x, int y) {
  const float* const pixel = &rgba[4 * static_cast<std::size_t>(y * kWidth + x)];
  return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

int changed(const std::vector<float>& before, const std::vector<float>& after) {
  int count = 0;
  for (std::size_t i = 0; i < before.size(); i += 4) {
    count += std::equal(&before[i], &before[i] + 4, &after[i]) ? 0 : 1;
  }
  return count;
}

TEST(PictureOverlay, LinesGoWhereTheyAreToldAndAreAsWide) {
  auto rgba = plain(0.0F, 1.0F);
  PictureOverlay overlay(rgba, kWidth, kHeight, 1.0);
  overlay.drawLine({50, 100}, {250, 100}, 4.0, kRed);
  EXPECT_NEAR(at(rgba, 150, 98)[0], 1.0F, 1e-6F);
  EXPECT_NEAR(at(rgba, 150, 101)[0], 1.0F, 1e-6F);
  EXPECT_EQ(at(rgba, 150, 96)[0], 0.0F);
  EXPECT_EQ(at(rgba, 150, 103)[0], 0.0F);
  EXPECT_EQ(at(rgba, 40, 100)[0], 0.0F);
  EXPECT_NEAR(changed(plain(0.0F, 1.0F), rgba), 200 * 4, 40);
}

TEST(PictureOverlay, SlantedLinesAreAsWideAsLevelOnes) {
  for (const glm::dvec2& to : {glm::dvec2(200, 230), glm::dvec2(101, 230), glm::dvec2(300, 30), glm::dvec2(100, 230)}) {
    auto rgba = plain(0.0F, 1.0F);
    PictureOverlay overlay(rgba, kWidth, kHeight, 1.0);
    const glm::dvec2 from(100, 20);
    overlay.drawLine(from, to, 3.0, PixelColor{255, 255, 255, 255});
    double ink = 0.0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      ink += scenegraph::srgbFromLinear(rgba[i]);
    }
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    EXPECT_NEAR(ink, 3.0 * length, 0.05 * 3.0 * length + 9.0);
  }
}

TEST(PictureOverlay, WhatReachesFarBeyondThePictureCostsNoMoreThanThePicture) {
  auto rgba = plain(0.2F, 1.0F);
  PictureOverlay overlay(rgba, kWidth, kHeight, 1.0);
  overlay.drawLine({-1e12, -1e12}, {1e12, 1e12}, 2.0, kRed);
  EXPECT_GT(changed(plain(0.2F, 1.0F), rgba), kHeight);
  auto same = plain(0.2F, 1.0F);
  PictureOverlay none(same, kWidth, kHeight, 1.0);
  none.drawLine({-100, -50}, {-20, 900}, 2.0, kRed);
  none.drawLine({std::nan(""), 0}, {100, 100}, 2.0, kRed);
  none.drawLine({0, 0}, {std::numeric_limits<double>::infinity(), 100}, 2.0, kRed);
  none.drawRing({1e9, 1e9}, 7.0, 2.0, kRed);
  none.drawRing({std::nan(""), 10.0}, 7.0, 2.0, kRed);
  EXPECT_EQ(changed(plain(0.2F, 1.0F), same), 0);
}

TEST(PictureOverlay, RingLeavesItsMiddleFree) {
  auto rgba = plain(0.0F, 1.0F);
  PictureOverlay overlay(rgba, kWidth, kHeight, 1.0);
  overlay.addPicks({.ring_px = glm::dvec2(100.5, 80.5), .lines = {}});
  EXPECT_EQ(at(rgba, 100, 80), (std::array{0.0F, 0.0F, 0.0F, 1.0F}));
  EXPECT_GT(at(rgba, 107, 80)[0], 0.5F);
  EXPECT_GT(at(rgba, 100, 73)[0], 0.5F);
  EXPECT_EQ(at(rgba, 111, 80)[0], 0.0F);
}

TEST(PictureOverlay, LengthsAreWrittenBesideTheirLines) {
  auto with_text = plain(0.5F, 1.0F);
  auto without = with_text;
  const scenegraph::PlacedPicks::Line line{{40, 150}, {280, 150}, "12.345 m"};
  PictureOverlay(with_text, kWidth, kHeight, 1.0).addPicks({.ring_px = {}, .lines = {line}});
  PictureOverlay(without, kWidth, kHeight, 1.0).drawLine(line.from_px, line.to_px, 4.0, PixelColor{0, 0, 0, 170});
  EXPECT_GT(changed(without, with_text), 600) << "a card with a text";
  const auto card = at(with_text, 160, 130);
  EXPECT_LT(card[0], 0.5F);
}

TEST(PictureOverlay, TheTextOfALengthLiesInThePicture) {
  const glm::dvec2 text_px{80.0, 20.0};
  const auto corner = [&](glm::dvec2 middle, scenegraph::PictureSize size) {
    return scenegraph::textCorner({middle - glm::dvec2(200.0, 3.0), middle + glm::dvec2(200.0, 3.0), "2 m"}, text_px,
                                  size);
  };
  EXPECT_EQ(corner({160.0, 120.0}, {320.0, 240.0}), glm::dvec2(120.0, 90.0)) << "above the middle";
  EXPECT_EQ(corner({10.0, 5.0}, {320.0, 240.0}), glm::dvec2(0.0, 0.0));
  EXPECT_EQ(corner({310.0, 239.0}, {320.0, 240.0}), glm::dvec2(240.0, 209.0));
  EXPECT_EQ(corner({30.0, 20.0}, {60.0, 30.0}), glm::dvec2(0.0, 0.0)) << "in a picture that is smaller";
  EXPECT_EQ(corner({-1.0, 120.0}, {320.0, 240.0}), std::nullopt);
}

TEST(PictureOverlay, MixesAsScreensDo) {
  auto rgba = plain(1.0F, 1.0F);
  PictureOverlay overlay(rgba, kWidth, kHeight, 1.0);
  overlay.lay({1, 1, {0, 0, 0, 128}}, 10, 10);
  EXPECT_NEAR(scenegraph::srgbByteFromLinear(at(rgba, 10, 10)[0]), 127, 1) << "half of encoded white, not of its light";
  EXPECT_EQ(at(rgba, 10, 10)[3], 1.0F);
  EXPECT_EQ(at(rgba, 11, 10)[0], 1.0F);
}

TEST(PictureOverlay, OverATransparentPictureItBringsItsOwnAlpha) {
  auto rgba = plain(0.0F, 0.0F);
  PictureOverlay overlay(rgba, kWidth, kHeight, 1.0);
  overlay.lay({1, 1, {255, 255, 255, 128}}, 10, 10);
  const auto pixel = at(rgba, 10, 10);
  EXPECT_NEAR(pixel[3], 128.0F / 255.0F, 1e-6F);
  EXPECT_NEAR(pixel[0], pixel[3], 1e-6F) << "premultiplied white";
  overlay.lay({1, 1, {255, 255, 255, 255}}, -1, 400);  // outside
  EXPECT_EQ(changed(plain(0.0F, 0.0F), rgba), 1);
}

TEST(PictureOverlay, LegendsKeepToTheirCornerAndGrowWithThePicture) {
  const std::vector<LegendEntry> entries{
      {"/points", {.title = "z", .unit = "m", .low = 0.0, .high = 1.0, .colors = {{0, 0, 1}, {1, 0, 0}}}}};
  auto rgba = plain(0.5F, 1.0F);
  PictureOverlay(rgba, kWidth, kHeight, 1.0).addLegends(entries);
  EXPECT_GT(changed(plain(0.5F, 1.0F), rgba), 5000);
  EXPECT_EQ(at(rgba, 100, 100)[0], 0.5F);
  EXPECT_NE(at(rgba, 200, 220)[0], 0.5F);
  auto small = plain(0.5F, 1.0F);
  PictureOverlay(small, kWidth, kHeight, 4.0).addLegends(entries);
  EXPECT_EQ(changed(plain(0.5F, 1.0F), small), 0) << "no room";
  EXPECT_EQ(overlayScale(720), 1.0);
  EXPECT_EQ(overlayScale(1440), 2.0);
  EXPECT_EQ(overlayScale(100'000), 8.0);
}

}  // namespace
}  // namespace stillframe::nodes
