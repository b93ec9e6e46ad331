#include "scenegraph/raster/points_in_view.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace stillframe::scenegraph {
namespace {

using Sizes = std::array<std::size_t, PointsInView::kSizes>;

Sizes sumOf(Sizes sum, const Sizes& more) {
  std::ranges::transform(sum, more, sum.begin(), std::plus{});
  return sum;
}

}  // namespace

std::uint32_t pointsWorthDrawing(const PointBatch& batch, const std::optional<BoxOnScreen>& place) {
  if (!place) {
    return kPassesOfSample;
  }
  // Of sizes in metres the smallest in the group would be needed.
  return place->pointsWorthDrawing(batch.is_size_in_metres ? 1.0 : static_cast<double>(batch.size));
}

void PointsInView::add(const PointBatch& batch, int width_px, int height_px) {
  if (batch.boxes.empty()) {
    by_size_.back() += batch.count();
    return;
  }
  const BoxCull cull(batch.clip_from_points);
  const BoxProjector projector(batch.clip_from_points, width_px, height_px);
  const auto addGroups = [&](const tbb::blocked_range<std::size_t>& groups, Sizes sizes) {
    for (std::size_t group = groups.begin(); group < groups.end(); ++group) {
      const std::size_t first = group * kPassesOfSample;
      const PointBox& box = batch.boxes[group];
      if (first < batch.count() && cull.mayBeSeen(box)) {
        const std::uint32_t most = pointsWorthDrawing(batch, projector.project(box));
        sizes[static_cast<std::size_t>(std::countr_zero(most))] +=
            std::min<std::size_t>(kPassesOfSample, batch.count() - first);
      }
    }
    return sizes;
  };
  constexpr std::size_t kGroupsATask = 512;
  const tbb::blocked_range<std::size_t> all(0, batch.boxes.size(), kGroupsATask);
  by_size_ = sumOf(by_size_, tbb::parallel_reduce(all, Sizes{}, addGroups, sumOf));
}

std::size_t PointsInView::count() const noexcept {
  return std::accumulate(by_size_.begin(), by_size_.end(), std::size_t{0});
}

double PointsInView::drawnBefore(std::uint32_t end) const noexcept {
  double points = 0.0;
  for (std::size_t size = 0; size < kSizes; ++size) {
    const GroupTurns turns = turnsOf({0, end}, std::uint32_t{1} << size);
    points += static_cast<double>(by_size_[size]) * turns.count() / kPassesOfSample;
  }
  return points;
}

std::uint32_t PointsInView::passesFor(double points, std::uint32_t first, std::uint32_t end) const noexcept {
  const double until = drawnBefore(first) + points;
  std::uint32_t most = first;
  for (std::uint32_t beyond = end; most < beyond;) {
    const std::uint32_t middle = beyond - (beyond - most) / 2;
    if (drawnBefore(middle) <= until) {
      most = middle;
    } else {
      beyond = middle - 1;
    }
  }
  return most;
}

}  // namespace stillframe::scenegraph
