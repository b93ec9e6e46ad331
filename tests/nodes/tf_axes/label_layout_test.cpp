#include "nodes/tf_axes/label_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/builders.h"

namespace stillframe::nodes {
namespace {

LabelWish wish(double x, double y, double depth_m = 1.0) { return {{x, y}, {60.0, 12.0}, depth_m, true}; }

TEST(LabelLayout, ShowsNamesThatHaveRoom) {
  const std::vector<LabelWish> wishes{wish(10, 20), wish(10, 40), wish(100, 20)};
  for (const LabelPlace& place : placeLabels(wishes, 3.0, 6)) {
    EXPECT_TRUE(place.is_shown);
    EXPECT_TRUE(place.also.empty());
  }
}

TEST(LabelLayout, OfTwoThatOverlapTheNearerIsShown) {
  const auto places = placeLabels(std::vector<LabelWish>{wish(10, 20, 9.0), wish(30, 24, 2.0)}, 3.0, 6);
  EXPECT_FALSE(places[0].is_shown);
  EXPECT_TRUE(places[1].is_shown);
}

TEST(LabelLayout, NamesAtOnePlaceBecomeOne) {
  const auto places =
      placeLabels(std::vector<LabelWish>{wish(10, 20, 2.0), wish(11, 21, 1.0), wish(10, 20, 3.0)}, 3.0, 6);
  EXPECT_FALSE(places[0].is_shown);
  EXPECT_TRUE(places[1].is_shown);
  EXPECT_EQ(places[1].also, (std::vector<std::size_t>{0, 2}));
  EXPECT_FALSE(places[2].is_shown);
}

TEST(LabelLayout, WhatIsOutsideThePictureTakesNoRoom) {
  LabelWish outside = wish(10, 20, 0.1);
  outside.is_in_picture = false;
  const auto places = placeLabels(std::vector<LabelWish>{outside, wish(10, 20)}, 3.0, 6);
  EXPECT_FALSE(places[0].is_shown);
  EXPECT_TRUE(places[1].is_shown);
  EXPECT_TRUE(places[1].also.empty());
}

TEST(LabelLayout, NoTwoShownOverlapWhateverComes) {
  test::Random random(7);
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 10'000; ++i) {
    wishes.push_back(wish(random.number(0, 1920), random.number(0, 1080), random.number(0.1, 100)));
    wishes.back().size_px = {random.number(10, 200), random.number(8, 30)};
  }
  const auto places = placeLabels(wishes, 3.0, 1);
  std::vector<LabelWish> shown;
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    if (places[i].is_shown) {
      LabelWish whole = wishes[i];
      for (const std::size_t other : places[i].also) {
        whole.size_px.x = std::max(whole.size_px.x, wishes[other].size_px.x);
      }
      shown.push_back(whole);
    }
  }
  EXPECT_GT(shown.size(), 100U);
  for (std::size_t a = 0; a < shown.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const bool is_apart = shown[a].anchor_px.x >= shown[b].anchor_px.x + shown[b].size_px.x ||
                            shown[b].anchor_px.x >= shown[a].anchor_px.x + shown[a].size_px.x ||
                            shown[a].anchor_px.y - shown[a].size_px.y >= shown[b].anchor_px.y ||
                            shown[b].anchor_px.y - shown[b].size_px.y >= shown[a].anchor_px.y;
      ASSERT_TRUE(is_apart);
    }
  }
}

}  // namespace
}  // namespace stillframe::nodes
