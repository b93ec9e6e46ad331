#include "tools/ingest/unpack_helper.h"

#include <algorithm>
#include <system_error>

#include "scenegraph/store/large_pages.h"

namespace stillframe::ingest {

std::span<const std::byte> PackedWindow::from(std::size_t position) {
  if (position >= packed_.size) {
    return {};
  }
  bytes_.resize(std::min(packed_.size, kBytes));
  const auto wanted = std::span(bytes_).first(std::min(bytes_.size(), packed_.size - position));
  return wanted.first(packed_.read(position, wanted));
}

std::unique_ptr<UnpackHelper> UnpackHelper::start(const PackedBytes& packed,
                                                  const std::function<void(std::span<const std::byte>)>& made,
                                                  std::span<std::byte> out) {
  try {
    return std::unique_ptr<UnpackHelper>(new UnpackHelper(packed, made, out));
  } catch (const std::system_error&) {
    return nullptr;
  }
}

UnpackHelper::UnpackHelper(const PackedBytes& packed, const std::function<void(std::span<const std::byte>)>& made,
                           std::span<std::byte> out)
    : packed_(packed), hand_on_(made), out_(out) {
  for (Filled& window : windows_) {
    window.bytes.resize(std::min(PackedWindow::kBytes, packed.size));
  }
  thread_ = std::thread([this] { work(); });
}

UnpackHelper::~UnpackHelper() {
  {
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

std::span<const std::byte> UnpackHelper::from(std::size_t position) {
  if (position >= packed_.size) {
    return {};
  }
  std::unique_lock lock(mutex_);
  if (taken_ < filled_ && position >= windows_[taken_ % kWindows].end()) {
    ++taken_;
    wake_.notify_all();
  }
  wake_.wait(lock, [this] { return taken_ < filled_ || is_at_end_; });
  if (taken_ == filled_) {
    return {};
  }
  const Filled& window = windows_[taken_ % kWindows];
  return std::span(window.bytes).first(window.size).subspan(position - window.position);
}

void UnpackHelper::made(std::size_t bytes) {
  {
    const std::scoped_lock lock(mutex_);
    made_ = bytes;
  }
  wake_.notify_all();
}

void UnpackHelper::work() {
  constexpr std::size_t kAhead = std::size_t{8} << 20;  // bytes
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    if (!is_at_end_ && filled_ - taken_ < kWindows) {
      fill(lock);
    } else if (populated_ < std::min(made_ + kAhead, out_.size())) {
      populate(lock);
    } else if (handed_on_ < made_) {
      handOn(lock);
    } else {
      wake_.wait(lock);
    }
  }
  while (handed_on_ < made_) {
    handOn(lock);
  }
}

void UnpackHelper::fill(std::unique_lock<std::mutex>& lock) {
  Filled& window = windows_[filled_ % kWindows];
  window.position = read_;
  lock.unlock();
  window.size = packed_.read(
      window.position, std::span(window.bytes).first(std::min(window.bytes.size(), packed_.size - window.position)));
  lock.lock();
  read_ += window.size;
  filled_ += window.size > 0 ? 1 : 0;
  is_at_end_ = window.size == 0 || read_ == packed_.size;
  wake_.notify_all();
}

void UnpackHelper::populate(std::unique_lock<std::mutex>& lock) {
  constexpr std::size_t kPiece = std::size_t{2} << 20;  // bytes: a large page
  const auto piece = out_.subspan(populated_, std::min(kPiece, out_.size() - populated_));
  populated_ += piece.size();
  lock.unlock();
  scenegraph::populatePages(piece.data(), piece.size());
  lock.lock();
}

void UnpackHelper::handOn(std::unique_lock<std::mutex>& lock) {
  const auto piece = out_.subspan(handed_on_, std::min(PackedWindow::kBytes, made_ - handed_on_));
  handed_on_ += piece.size();
  lock.unlock();
  hand_on_(piece);
  lock.lock();
}

}  // namespace stillframe::ingest
