#pragma once

#include <sstream>
#include <string>

namespace stillframe::ingest {

/// The parts as one text, numbers in decimal: for messages of faults, never on a hot path.
template <typename... Parts>
[[nodiscard]] std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return std::move(out).str();
}

}  // namespace stillframe::ingest
