#include "tools/ingest/converters/robot_text.h"

#include <algorithm>
#include <cctype>

namespace stillframe::ingest::converters {

namespace {

/// What follows `end`, or nothing.
std::string_view behind(std::string_view text, std::string_view end) noexcept {
  const std::size_t at = text.find(end);
  return at == std::string_view::npos ? std::string_view{} : text.substr(at + end.size());
}

}  // namespace

std::string_view robotFormat(std::string_view text) noexcept {
  for (;;) {
    text = text.substr(std::min(text.find('<'), text.size()));
    if (text.starts_with("<!--")) {
      text = behind(text, "-->");
    } else if (text.starts_with("<?")) {
      text = behind(text, "?>");
    } else if (text.starts_with("<!")) {
      text = behind(text, ">");
    } else {
      break;
    }
  }
  const auto isRoot = [&](std::string_view name) {
    return text.size() > name.size() + 1 && text.substr(1).starts_with(name) &&
           (std::isspace(static_cast<unsigned char>(text[name.size() + 1])) != 0 || text[name.size() + 1] == '>' ||
            text[name.size() + 1] == '/');
  };
  if (isRoot("robot")) {
    return "urdf";
  }
  if (isRoot("sdf")) {
    return "sdf";
  }
  return isRoot("mujoco") ? "mjcf" : "";
}

}  // namespace stillframe::ingest::converters
