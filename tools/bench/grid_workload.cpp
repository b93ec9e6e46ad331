#include "tools/bench/grid_workload.h"

#include <random>

namespace stillframe::bench {

PatchStream::PatchStream() : cells_(std::size_t{kSide} * kSide, std::byte{0xFF}) {
  header_.width = header_.height = kSide;
  header_.resolution_m = 0.05;
  header_.tile_edge = nodes::tileEdge(kSide, kSide);
  header_.block_edge = nodes::blockEdge(kSide, kSide);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < kPatches; ++i) {
    const auto bytes = std::make_shared<std::vector<std::byte>>(std::size_t{kPatchSide} * kPatchSide);
    for (std::byte& byte : *bytes) {
      byte = static_cast<std::byte>(random() % 101);
    }
    scenegraph::OccupancyGridUpdate patch;
    patch.width = patch.height = kPatchSide;
    patch.x = static_cast<std::int32_t>(random() % (kSide - kPatchSide));
    patch.y = static_cast<std::int32_t>(random() % (kSide - kPatchSide));
    patch.data = {*bytes, bytes};
    patches_.push_back(std::make_shared<const scenegraph::OccupancyGridUpdate>(std::move(patch)));
    ids_.push_back(i);
  }
}

nodes::GridHistory PatchStream::makeHistory() const { return {header_, cells_}; }

scenegraph::OccupancyGrid PatchStream::base() const {
  scenegraph::OccupancyGrid grid;
  grid.frame_id = "map";
  grid.resolution_m = header_.resolution_m;
  grid.width = grid.height = kSide;
  grid.data.bytes = cells_;
  return grid;
}

std::shared_ptr<const nodes::GridState> PatchStream::seek(nodes::GridHistory& history, std::size_t count) const {
  return history.at(std::span(ids_).first(count), [&](std::size_t place) { return patches_[place]; });
}

}  // namespace stillframe::bench
