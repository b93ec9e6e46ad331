#include "nodes/tf_axes/label_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace stillframe::nodes {
namespace {

struct Rectangle {
  glm::dvec2 low;
  glm::dvec2 high;
};

bool overlaps(const Rectangle& a, const Rectangle& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

/// Lines grow upwards from the anchor.
Rectangle rectangleOf(const LabelWish& wish, std::size_t lines) {
  const double height_px = wish.size_px.y * static_cast<double>(lines);
  return {{wish.anchor_px.x, wish.anchor_px.y - height_px}, {wish.anchor_px.x + wish.size_px.x, wish.anchor_px.y}};
}

using Cell = std::pair<std::int64_t, std::int64_t>;

Cell cellOf(const LabelWish& wish, double same_px) {
  return {static_cast<std::int64_t>(std::floor(wish.anchor_px.x / same_px)),
          static_cast<std::int64_t>(std::floor(wish.anchor_px.y / same_px))};
}

/// The first head at the same place, looked for in the cells around.
std::optional<std::size_t> headNear(std::span<const LabelWish> wishes, std::size_t i, double same_px,
                                    const std::map<Cell, std::vector<std::size_t>>& heads_in) {
  const auto [x, y] = cellOf(wishes[i], same_px);
  for (std::int64_t cell = 0; cell < 9; ++cell) {
    const auto found = heads_in.find({x + cell % 3 - 1, y + cell / 3 - 1});
    if (found == heads_in.end()) {
      continue;
    }
    for (const std::size_t head : found->second) {
      if (glm::length(wishes[head].anchor_px - wishes[i].anchor_px) <= same_px) {
        return head;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<LabelPlace> placeLabels(std::span<const LabelWish> wishes, double same_px, std::size_t most_lines) {
  std::vector<LabelPlace> places(wishes.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    if (wishes[i].is_in_picture) {
      order.push_back(i);
    }
  }
  // Of equal depths the first comes first, so that the order does not flicker.
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::tuple(wishes[i].depth_m, i); });
  std::vector<std::size_t> heads;  // of the groups, in order
  std::map<Cell, std::vector<std::size_t>> heads_in;
  for (const std::size_t i : order) {
    if (const auto head = headNear(wishes, i, same_px, heads_in)) {
      places[*head].also.push_back(i);
    } else {
      heads.push_back(i);
      heads_in[cellOf(wishes[i], same_px)].push_back(i);
    }
  }
  std::vector<Rectangle> taken;
  for (const std::size_t head : heads) {
    LabelWish wish = wishes[head];
    for (const std::size_t other : places[head].also) {
      wish.size_px.x = std::max(wish.size_px.x, wishes[other].size_px.x);
    }
    const Rectangle wanted = rectangleOf(wish, std::min(places[head].also.size() + 1, most_lines));
    places[head].is_shown =
        std::ranges::none_of(taken, [&](const Rectangle& other) { return overlaps(other, wanted); });
    if (places[head].is_shown) {
      taken.push_back(wanted);
    } else {
      places[head].also.clear();
    }
  }
  return places;
}

}  // namespace stillframe::nodes
