#include "nodes/markers/scene_history.h"

#include "nodes/markers/scene_fold.h"

namespace stillframe::nodes {
namespace {

// Work is counted in bytes read; a message costs a little even when it is empty.
constexpr std::size_t kWorkStep = std::size_t{2} << 20U;
constexpr std::size_t kWorkOfMessage = 2048;

}  // namespace

SceneHistory::SceneHistory(std::size_t max_bytes, std::size_t max_checkpoint_bytes)
    : max_bytes_(max_bytes), checkpoints_({}, max_checkpoint_bytes, kWorkStep) {}

SceneHistory::~SceneHistory() = default;
SceneHistory::SceneHistory(SceneHistory&&) noexcept = default;
SceneHistory& SceneHistory::operator=(SceneHistory&&) noexcept = default;

std::size_t SceneHistory::byteSize() const noexcept { return sizeof(*this) + checkpoints_.byteSize(); }

SceneState SceneHistory::at(std::size_t count, tf::TimePoint time, const SequenceAt& sequence_at, const Fetch& fetch) {
  const auto isCurrent = [&](std::size_t place, std::uint64_t last_sequence) {
    return place == 0 || (place <= count && sequence_at(place - 1) == last_sequence);
  };
  while (true) {
    const auto& item = checkpoints_.before(count);
    if (isCurrent(item.place, item.state.last_sequence)) {
      break;
    }
    checkpoints_.forgetAfter(item.place - 1);
  }
  const auto& start = checkpoints_.before(count);
  if (head_ == nullptr || head_->place < start.place || !isCurrent(head_->place, head_->last_sequence)) {
    head_ = std::make_unique<Fold>(start.state.state, start.place, start.state.last_sequence, max_bytes_);
  }
  while (head_->place < count) {
    const SceneMessage message = fetch(head_->place);
    head_->apply(message);
    head_->work += kWorkOfMessage + message.payload_bytes;
    if (checkpoints_.isDue(head_->work)) {
      const std::size_t bytes = head_->new_bytes + head_->work / kWorkOfMessage;
      SceneState state = head_->snapshot();
      const std::size_t shared = state.blocks.size() * sizeof(state.blocks.front());
      checkpoints_.keep(head_->place, {std::move(state), head_->last_sequence}, bytes + shared);
      head_->work = 0;
      head_->new_bytes = 0;
    }
  }
  return head_->snapshotAt(time);
}

}  // namespace stillframe::nodes
