#include "tools/ingest/buffer_shelf.h"

#include <algorithm>
#include <utility>

#include "scenegraph/store/large_pages.h"

namespace stillframe::ingest {

Buffer BufferShelf::take(std::size_t size) {
  if (size < kLarge) {
    return makeBuffer(size);
  }
  Block block;
  {
    const std::scoped_lock lock(mutex_);
    const auto fits =
        std::ranges::find_if(blocks_, [&](const Block& kept) { return kept.size >= size && kept.size / 2 <= size; });
    if (fits != blocks_.end()) {
      block = std::move(*fits);
      blocks_.erase(fits);
      bytes_ -= block.size;
    }
  }
  if (block.bytes == nullptr) {
    block = {std::make_unique_for_overwrite<std::byte[]>(size), size};
    scenegraph::useLargePages(block.bytes.get(), size);
  }
  const auto giveBack = [shelf = shared_from_this(), capacity = block.size](std::byte* bytes) {
    shelf->keep({std::unique_ptr<std::byte[]>(bytes), capacity});
  };
  return {std::shared_ptr<std::byte[]>(block.bytes.release(), giveBack), size};
}

/// The newest ones: what is as large as the last will be wanted next.
void BufferShelf::keep(Block block) {
  std::vector<Block> too_many;
  if (block.size > kMostBytes) {
    too_many.push_back(std::move(block));
  } else {
    const std::scoped_lock lock(mutex_);
    bytes_ += block.size;
    blocks_.push_back(std::move(block));
    while (bytes_ > kMostBytes) {
      bytes_ -= blocks_.front().size;
      too_many.push_back(std::move(blocks_.front()));
      blocks_.erase(blocks_.begin());
    }
  }
  for (const Block& freed : too_many) {
    scenegraph::releasePages(freed.bytes.get(), freed.size);
  }
}

}  // namespace stillframe::ingest
