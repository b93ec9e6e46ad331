#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace stillframe::ingest {

/// Base64 of either alphabet, padded or not; nullopt for anything else.
[[nodiscard]] std::optional<std::vector<std::byte>> decodeBase64(std::string_view text);

/// Nanoseconds since the epoch of an RFC 3339 time ("2024-05-01T12:00:00.5Z", with "+02:00" too); digits beyond
/// nanoseconds are dropped.
[[nodiscard]] std::optional<std::int64_t> parseTime(std::string_view text);

/// Nanoseconds of a protobuf duration: "1.5s", "-0.25s".
[[nodiscard]] std::optional<std::int64_t> parseDuration(std::string_view text);

}  // namespace stillframe::ingest
