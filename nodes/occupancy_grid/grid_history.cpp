#include "nodes/occupancy_grid/grid_history.h"

#include <algorithm>
#include <unordered_set>

#include "tf/transform_buffer.h"

namespace stillframe::nodes {
namespace {

using scenegraph::OccupancyGridUpdate;

// Work is counted in bytes moved; an update costs a little even when it is empty.
constexpr std::size_t kWorkStep = std::size_t{2} << 20U;
constexpr std::size_t kWorkOfUpdate = 2048;

/// The update with bytes of its own: those of the message keep a whole chunk of the file alive.
GridHistory::Update detached(const OccupancyGridUpdate& update) {
  auto copy = std::make_shared<OccupancyGridUpdate>(update);
  const auto bytes = std::make_shared<const std::vector<std::byte>>(update.data.bytes.begin(), update.data.bytes.end());
  copy->data = {*bytes, bytes};
  return copy;
}

GridState baseState(const GridHeader& header, std::span<const std::byte> cells) {
  GridState base;
  base.cells = GridCells(header, cells);
  return base;
}

std::size_t pointerBytes(const GridState& state) {
  return state.cells.blocks().size() * sizeof(std::shared_ptr<GridBlock>);
}

/// Of all checkpoints but the base: blocks that several share count once, those of the base not at all.
std::size_t checkpointBytes(std::span<const Checkpoints<GridState>::Item> items) {
  std::unordered_set<const GridBlock*> known;
  std::size_t bytes = 0;
  for (const auto& item : items) {
    const bool is_base = item.place == 0;
    bytes += is_base ? 0 : pointerBytes(item.state);
    for (const auto& block : item.state.cells.blocks()) {
      bytes += known.insert(block.get()).second && !is_base ? block->byteSize() : 0;
    }
  }
  return bytes;
}

std::string patchText(const OccupancyGridUpdate& update) {
  return std::to_string(update.width) + " x " + std::to_string(update.height) + " cells at (" +
         std::to_string(update.x) + ", " + std::to_string(update.y) + ")";
}

}  // namespace

GridHistory::GridHistory(GridHeader header, std::span<const std::byte> cells, std::size_t max_bytes)
    : header_(std::move(header)),
      max_bytes_(max_bytes),
      checkpoints_(baseState(header_, cells), max_bytes, kWorkStep, checkpointBytes) {
  base_bytes_ = checkpoints_.before(0).state.cells.byteSize();
}

std::size_t GridHistory::byteSize() const noexcept {
  return sizeof(*this) + base_bytes_ + checkpoints_.byteSize() + update_bytes_ +
         ids_.capacity() * (sizeof(std::uint64_t) + sizeof(Update));
}

void GridHistory::forgetAfter(std::size_t place) {
  if (head_ && head_->place > place) {
    head_.reset();
  }
  checkpoints_.forgetAfter(place);
  for (std::size_t i = place; i < updates_.size(); ++i) {
    update_bytes_ -= updates_[i] != nullptr ? updates_[i]->byteSize() : 0;
  }
  ids_.resize(std::min(ids_.size(), place));
  updates_.resize(ids_.size());
}

GridHistory::Update GridHistory::update(std::size_t place, const Fetch& fetch) {
  if (updates_[place] != nullptr) {
    return updates_[place];
  }
  Update fetched = fetch(place);
  if (fetched != nullptr && update_bytes_ + fetched->byteSize() <= max_bytes_ / 4) {
    fetched = detached(*fetched);
    update_bytes_ += fetched->byteSize();
    updates_[place] = fetched;
  }
  return fetched;
}

void GridHistory::apply(GridState& state, const Update& update) const {
  const auto refuse = [&](const std::string& why) {
    if (state.refused++ == 0) {
      state.first_refusal = why;
    }
  };
  if (update == nullptr) {
    refuse("it cannot be decoded");
    return;
  }
  switch (state.cells.apply(*update)) {
    case PatchOutcome::Clipped:
      ++state.clipped;
      ++state.applied;
      break;
    case PatchOutcome::Applied:
      ++state.applied;
      break;
    case PatchOutcome::Outside:
      refuse(patchText(*update) + " lie outside the grid");
      return;
    case PatchOutcome::Short:
      refuse(patchText(*update) + " come with " + std::to_string(update->data.bytes.size()) + " bytes");
      return;
  }
  const std::string_view frame = tf::stripLeadingSlashes(update->frame_id);
  if (!frame.empty() && frame != header_.frame_id && state.other_frame++ == 0) {
    state.first_frame = std::string(frame);
  }
}

std::shared_ptr<const GridState> GridHistory::at(std::span<const std::uint64_t> ids, const Fetch& fetch) {
  const auto same = static_cast<std::size_t>(std::ranges::mismatch(ids, ids_).in1 - ids.begin());
  if (same < std::min(ids.size(), ids_.size())) {
    forgetAfter(same);
  }
  if (ids_.size() < ids.size()) {
    ids_.assign(ids.begin(), ids.end());
    updates_.resize(ids_.size());
  }
  const auto& start = checkpoints_.before(ids.size());
  if (!head_ || head_->place > ids.size() || head_->place < start.place) {
    head_ = Head{start.place, 0, std::make_shared<GridState>(start.state)};
  }
  Head& head = *head_;
  if (head.is_given_out && head.place < ids.size()) {
    head.state = std::make_shared<GridState>(*head.state);
    head.is_given_out = false;
  }
  while (head.place < ids.size()) {
    const Update patch = update(head.place, fetch);
    const std::size_t before = head.state->cells.ownBytes();
    apply(*head.state, patch);
    const std::size_t copied = head.state->cells.ownBytes() - before;
    head.work += kWorkOfUpdate + 2 * copied + (patch != nullptr ? patch->data.bytes.size() : 0);
    ++head.place;
    if (checkpoints_.isDue(head.work)) {
      const std::size_t own_bytes = pointerBytes(*head.state) + head.state->cells.ownBytes();  // before it is copied
      checkpoints_.keep(head.place, *head.state, own_bytes);
      head.work = 0;
    }
  }
  head.is_given_out = true;
  return head.state;
}

}  // namespace stillframe::nodes
