#pragma once

#include <string_view>

namespace stillframe::ingest::converters {

/// "urdf", "sdf" or "mjcf" by the first element of an XML text (declarations and comments before it aside); "" for
/// anything else.
[[nodiscard]] std::string_view robotFormat(std::string_view text) noexcept;

}  // namespace stillframe::ingest::converters
