#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <string>

#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// Lets `write` fill a file beside `path` and moves it there when it returns no reason for failure; the file beside is
/// gone in any case. `write` is given the name beside, with the extension of `path`. Code "CannotWrite".
std::expected<void, Status> replaceFile(
    const std::filesystem::path& path,
    const std::function<std::expected<void, std::string>(const std::filesystem::path&)>& write);

/// The text of errno, or "unknown reason" when it is 0.
[[nodiscard]] std::string lastSystemError();

}  // namespace stillframe::scenegraph
