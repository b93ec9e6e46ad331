#include "scenegraph/export/replace_file.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace stillframe::scenegraph {

std::string lastSystemError() {
  return errno == 0 ? "unknown reason" : std::error_code(errno, std::generic_category()).message();
}

std::expected<void, Status> replaceFile(
    const std::filesystem::path& path,
    const std::function<std::expected<void, std::string>(const std::filesystem::path&)>& write) {
  const auto failure = [&](const std::string& reason) {
    return std::unexpected(Status{StatusLevel::Error, "CannotWrite", "cannot write " + path.string() + ": " + reason});
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return failure("it is a directory");
  }
  const bool is_special = std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
  if (is_special) {  // a pipe or device: nothing to keep, and not to be replaced by a file
    const auto written = write(path);
    return written ? std::expected<void, Status>{} : failure(written.error());
  }
  std::filesystem::path beside = path;
  beside.replace_filename("." + path.stem().string() + "." + std::to_string(getpid()) + path.extension().string());
  const auto written = write(beside);
  if (!written) {
    std::filesystem::remove(beside, error);
    return failure(written.error());
  }
  std::filesystem::rename(beside, path, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(beside, error);
    return failure(reason);
  }
  return {};
}

}  // namespace stillframe::scenegraph
