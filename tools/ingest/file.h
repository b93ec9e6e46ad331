#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "scenegraph/status.h"

namespace stillframe::ingest {

/// A file read by position. Any thread.
///
/// pread rather than a mapping: a file that shrinks while it is open gives a short read, not a signal.
class File {
 public:
  /// Codes: "CannotOpen" (absent, a directory, no permission, ...).
  [[nodiscard]] static std::expected<std::shared_ptr<const File>, scenegraph::Status> open(
      const std::filesystem::path& path);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Size when it was opened.
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  /// Fills `out` from `offset`; the number of bytes read is less only at the end of the file or on a disk error.
  [[nodiscard]] std::size_t read(std::uint64_t offset, std::span<std::byte> out) const noexcept;

 private:
  File(int descriptor, std::uint64_t size, std::string path);

  int descriptor_;
  std::uint64_t size_;
  std::string path_;
};

/// Reads a file forward in large steps, for many small reads in order. One thread; the file outlives it.
class ForwardReader {
 public:
  explicit ForwardReader(const File& file, std::size_t window_bytes = std::size_t{256} << 10)
      : file_(file), window_(window_bytes) {}

  /// A view of `size` bytes at `offset`, valid until the next call; shorter at the end of the file. Memory grows to
  /// the largest size asked for that the file really has.
  [[nodiscard]] std::span<const std::byte> view(std::uint64_t offset, std::uint64_t size);

 private:
  const File& file_;
  std::size_t window_;
  std::unique_ptr<std::byte[]> buffer_;
  std::size_t capacity_ = 0;
  std::size_t filled_ = 0;
  std::uint64_t start_ = 0;
};

}  // namespace stillframe::ingest
