#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace stillframe::cli {

using Json = nlohmann::ordered_json;

/// One object, indented, in UTF-8 whatever the strings hold: bytes that are not become U+FFFD.
[[nodiscard]] inline std::string jsonText(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace stillframe::cli
