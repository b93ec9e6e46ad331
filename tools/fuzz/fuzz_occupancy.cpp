// A base grid and patches from the fuzzer, visited in any order: no state may depend on the way to it, and each must be
// what patching an array of cells, one by one, gives.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "nodes/occupancy_grid/grid_history.h"

namespace {

using namespace stillframe;

/// Takes numbers off the front of the input; zeros when it has run out.
struct Bytes {
  std::span<const std::uint8_t> left;

  template <typename T>
  T take() {
    T value{};
    const std::size_t size = std::min(left.size(), sizeof(value));
    if (size > 0) {
      std::memcpy(&value, left.data(), size);
    }
    left = left.subspan(size);
    return value;
  }
  /// Mostly small, sometimes anything.
  std::uint32_t size() {
    const auto kind = take<std::uint8_t>();
    return kind < 240 ? kind : take<std::uint32_t>();
  }
  /// A copy of exactly that size, or of what is left, so that one byte too many is caught.
  scenegraph::Payload payload(std::uint64_t size) {
    const auto bytes = std::make_shared<std::vector<std::byte>>(std::min<std::uint64_t>(size, left.size()));
    std::ranges::copy(std::as_bytes(left.first(bytes->size())), bytes->begin());
    left = left.subspan(bytes->size());
    return {*bytes, bytes};
  }
};

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

using Cells = std::vector<std::int8_t>;

/// Whether the patch was applied, cell by cell.
bool patch(Cells& cells, const nodes::GridHeader& header, const scenegraph::OccupancyGridUpdate& update) {
  const std::uint64_t count = std::uint64_t{update.width} * update.height;
  if (update.data.bytes.size() < count) {
    return false;
  }
  bool is_inside = count == 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto x = std::int64_t{update.x} + static_cast<std::int64_t>(i % update.width);
    const auto y = std::int64_t{update.y} + static_cast<std::int64_t>(i / update.width);
    if (x >= 0 && y >= 0 && x < header.width && y < header.height) {
      cells[static_cast<std::size_t>(y * header.width + x)] = static_cast<std::int8_t>(update.data.bytes[i]);
      is_inside = true;
    }
  }
  return is_inside;
}

void requireState(const nodes::GridState& state, const nodes::GridHeader& header, const Cells& cells,
                  std::uint64_t applied) {
  require(state.applied == applied);
  for (std::uint32_t y = 0; y < header.height && header.width > 0; ++y) {
    for (std::uint32_t x = 0; x < header.width; ++x) {
      require(state.cells.at(x, y) == cells[std::size_t{y} * header.width + x]);
    }
  }
  require(state.cells.counts() == nodes::countCells(cells));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes input{{data, size}};
  scenegraph::OccupancyGrid grid;
  grid.width = input.size();
  grid.height = input.size();
  grid.resolution_m = input.take<std::uint8_t>() < 240 ? 0.05 : static_cast<double>(input.take<float>());
  grid.origin.rotation.z = static_cast<double>(input.take<float>());
  grid.origin.translation.x = static_cast<double>(input.take<float>());
  const unsigned updates = input.take<std::uint8_t>() % 40U;
  std::vector<std::shared_ptr<const scenegraph::OccupancyGridUpdate>> stream;
  std::vector<std::uint64_t> ids;
  for (unsigned i = 0; i < updates; ++i) {
    auto update = std::make_shared<scenegraph::OccupancyGridUpdate>();
    update->x = static_cast<std::int32_t>(input.size() - 40U);
    update->y = static_cast<std::int32_t>(input.size() - 40U);
    update->width = input.size() % 65536;
    update->height = input.size();
    update->data = input.payload(input.take<std::uint8_t>());
    stream.push_back(std::move(update));
    ids.push_back(input.take<std::uint8_t>() < 200 ? 1000 + i : 7);  // ids that repeat are another stream's
  }
  // Cells by repeating what is left: otherwise only tiny grids would be whole.
  const scenegraph::Payload seed = input.payload(64);
  const std::uint64_t count = std::uint64_t{grid.width} * grid.height;
  const bool is_whole = !seed.bytes.empty() && count <= 65536;
  const auto bytes = std::make_shared<std::vector<std::byte>>(is_whole ? count : seed.bytes.size());
  for (std::size_t i = 0; i < bytes->size(); ++i) {
    (*bytes)[i] = seed.bytes[i % seed.bytes.size()];
  }
  grid.data = {*bytes, bytes};
  const auto header = nodes::checkGrid(grid);
  if (!header) {
    require(!header.error().code.empty() && !header.error().message.empty());
    return 0;
  }
  require(grid.data.bytes.size() >= count);

  // The smallest budget, so that checkpoints are thinned out all the time.
  nodes::GridHistory history(*header, grid.data.bytes, 1024);
  Cells base(static_cast<std::size_t>(count));
  std::ranges::transform(grid.data.bytes.first(base.size()), base.begin(),
                         [](std::byte cell) { return static_cast<std::int8_t>(cell); });
  for (const std::size_t place : {ids.size(), ids.size() / 2, std::size_t{0}, ids.size() * 3 / 4, ids.size()}) {
    Cells cells = base;
    std::uint64_t applied = 0;
    for (std::size_t i = 0; i < place; ++i) {
      applied += patch(cells, *header, *stream[i]) ? 1 : 0;
    }
    const auto state = history.at(std::span(ids).first(place), [&](std::size_t at) { return stream[at]; });
    requireState(*state, *header, cells, applied);
  }
  return 0;
}
