#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tf/time.h"

namespace stillframe::scenegraph {

/// How much a status asks of the user.
enum class StatusLevel : std::uint8_t {
  Ok,     ///< drawn, nothing to say
  Info,   ///< drawn, with something worth knowing (points dropped, flag ignored)
  Warn,   ///< not drawn for now, and why (no transform at this time, no message yet, still decoding)
  Error,  ///< cannot be drawn, and why (malformed, not decodable)
};

/// Typed state of a layer or dataset, read by the UI, the CLI and the tests.
///
/// `code` is a stable CamelCase word for programs ("NoSampleAtTime", "MalformedCloud"); `message` is one sentence for
/// people that names the frame, topic, edge, bytes or times that are the reason, and the remedy when there is one.
struct Status {
  StatusLevel level = StatusLevel::Ok;
  std::string code = "Ok";
  std::string message;

  friend bool operator==(const Status&, const Status&) = default;
};

/// What a function returns that cannot do what it was asked for.
[[nodiscard]] inline std::unexpected<Status> failure(std::string code, std::string message) {
  return std::unexpected(Status{StatusLevel::Error, std::move(code), std::move(message)});
}

/// "ok", "info", "warn", "error".
[[nodiscard]] std::string_view toString(StatusLevel level) noexcept;

/// A fault found in a recording while reading it, counted. Same rules for code and message as Status.
struct Problem {
  std::string code;
  std::string message;
  std::uint64_t count = 1;
  std::optional<tf::TimePoint> time = {};  ///< of the first of them, where one can go and see
};

}  // namespace stillframe::scenegraph
