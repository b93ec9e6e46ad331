#include "tools/ingest/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

scenegraph::Status cannotOpen(const std::string& path, const char* reason) {
  return {scenegraph::StatusLevel::Error, "CannotOpen", sentence("cannot open '", path, "': ", reason)};
}

}  // namespace

std::expected<std::shared_ptr<const File>, scenegraph::Status> File::open(const std::filesystem::path& path) {
  // Without O_NONBLOCK a named pipe would hang here.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    return std::unexpected(cannotOpen(path.string(), strerror(errno)));
  }
  struct stat info{};
  if (::fstat(descriptor, &info) != 0 || !S_ISREG(info.st_mode)) {
    const char* reason = S_ISDIR(info.st_mode) ? "it is a directory" : "it is not a regular file";
    ::close(descriptor);
    return std::unexpected(cannotOpen(path.string(), reason));
  }
  return std::shared_ptr<const File>(new File(descriptor, static_cast<std::uint64_t>(info.st_size), path.string()));
}

File::File(int descriptor, std::uint64_t size, std::string path)
    : descriptor_(descriptor), size_(size), path_(std::move(path)) {}

File::~File() { ::close(descriptor_); }

std::size_t File::read(std::uint64_t offset, std::span<std::byte> out) const noexcept {
  std::size_t done = 0;
  while (done < out.size() && offset + done < size_) {
    const ssize_t got = ::pread(descriptor_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::span<const std::byte> ForwardReader::view(std::uint64_t offset, std::uint64_t size) {
  if (offset >= file_.size()) {
    return {};
  }
  const auto wanted = static_cast<std::size_t>(std::min(size, file_.size() - offset));
  if (offset < start_ || offset + wanted > start_ + filled_) {
    const std::size_t needed = std::max(wanted, window_);
    if (needed > capacity_) {
      buffer_ = std::make_unique_for_overwrite<std::byte[]>(needed);
      capacity_ = needed;
    }
    start_ = offset;
    filled_ = file_.read(offset, {buffer_.get(), needed});
  }
  const auto skip = static_cast<std::size_t>(offset - start_);
  return {buffer_.get() + skip, std::min(wanted, filled_ - std::min(skip, filled_))};
}

}  // namespace stillframe::ingest
