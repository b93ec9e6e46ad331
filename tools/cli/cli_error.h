#pragma once

#include <expected>
#include <string>

namespace stillframe::cli {

/// Exit codes of the program.
enum class ExitCode : int {
  Ok = 0,
  Failure = 1,       ///< a file cannot be read or written, a picture cannot be made
  Usage = 2,         ///< the command line is wrong: an option, a layer, a frame, a setting
  LookupFailed = 3,  ///< `tf`: there is no such transform; `pick`: nothing is there
};

/// Why a command ends early: printed as one line, "stillframe: <message>".
struct CliError {
  ExitCode code = ExitCode::Failure;
  std::string message;
};

template <typename T>
using Result = std::expected<T, CliError>;

[[nodiscard]] inline std::unexpected<CliError> usageError(std::string message) {
  return std::unexpected(CliError{ExitCode::Usage, std::move(message)});
}
[[nodiscard]] inline std::unexpected<CliError> failure(std::string message) {
  return std::unexpected(CliError{ExitCode::Failure, std::move(message)});
}

}  // namespace stillframe::cli
