#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "nodes/points/convert_cloud.h"
#include "scenegraph/raster/background_tasks.h"

namespace stillframe::nodes {

/// Points `first` to `first + count` of a cloud, which begin in a run of its data.
struct PointPiece {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t run = 0;   ///< that holds the first of them
  std::size_t skip = 0;  ///< points of that run before it
};

/// The points of a cloud in pieces that take a fraction of a millisecond each: the same whatever the number of threads.
[[nodiscard]] inline std::vector<PointPiece> piecesOf(const ConvertedCloud& cloud) {
  constexpr std::size_t kPoints = std::size_t{1} << 17U;
  std::vector<PointPiece> pieces;
  std::size_t first = 0;  // of the run
  for (std::size_t run = 0; run < cloud.runs.size(); first += cloud.runs[run++].count) {
    const std::size_t end = first + cloud.runs[run].count;
    for (std::size_t begin = pieces.size() * kPoints; begin < std::min(end, cloud.points); begin += kPoints) {
      pieces.push_back({begin, std::min(kPoints, cloud.points - begin), run, begin - first});
    }
  }
  return pieces;
}

/// `work(number of the piece, offset, count, first)` for all points, in parallel: `count` of them, the cloud's `first`
/// and on, which lie a point step after each other from `offset` bytes into the data; those of a piece in order.
template <typename Work>
void forPieces(const ConvertedCloud& cloud, const std::vector<PointPiece>& pieces, const Work& work) {
  scenegraph::runInBackground(pieces.size(), [&](std::size_t number) {
    PointPiece rest = pieces[number];
    while (rest.count > 0) {
      const PointRun& run = cloud.runs[rest.run];
      const std::size_t count = std::min(rest.count, run.count - rest.skip);
      work(number, run.offset + rest.skip * cloud.point_step, count, rest.first);
      rest = {rest.first + count, rest.count - count, rest.run + 1, 0};
    }
  });
}

}  // namespace stillframe::nodes
