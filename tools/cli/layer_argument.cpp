#include "tools/cli/layer_argument.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace stillframe::cli {
namespace {

bool isKeyCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Length of the key at the head of `text`, when a '=' follows it. Keys that begin with "link." name a link of a robot,
/// which may hold more characters than others.
std::optional<std::size_t> keyLength(std::string_view text) {
  const bool is_link = text.starts_with("link.");
  const auto isPart = [&](char c) { return isKeyCharacter(c) || (is_link && (c == '.' || c == '-' || c == '/')); };
  const auto length = static_cast<std::size_t>(std::ranges::find_if_not(text, isPart) - text.begin());
  return length > 0 && length < text.size() && text[length] == '=' ? std::optional(length) : std::nullopt;
}

/// Takes one value off the head of `text`, up to a comma outside of quotes; nullopt when a quote stays open.
std::optional<std::string> takeValue(std::string_view& text) {
  std::string value;
  char quote = '\0';
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == '\0' && c == ',') {
      break;
    }
    if (quote == '\0' && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = '\0';
    } else if (quote == '"' && c == '\\' && i + 1 < text.size()) {
      value += text[++i];
    } else {
      value += c;
    }
  }
  text.remove_prefix(i);
  return quote == '\0' ? std::optional(value) : std::nullopt;
}

}  // namespace

Result<LayerArgument> parseLayer(std::string_view text) {
  const std::string quoted = "layer '" + std::string(text) + "'";
  std::size_t colon = text.find(':');
  while (colon != std::string_view::npos && !keyLength(text.substr(colon + 1))) {
    colon = text.find(':', colon + 1);
  }
  LayerArgument layer{std::string(text.substr(0, colon)), {}};
  if (layer.id.empty()) {
    return usageError(quoted + " names no topic");
  }
  if (colon == std::string_view::npos) {
    return layer;
  }
  auto settings = parseSettings(quoted, text.substr(colon + 1));
  if (!settings) {
    return std::unexpected(settings.error());
  }
  layer.settings = std::move(*settings);
  return layer;
}

Result<scenegraph::SettingTexts> parseSettings(const std::string& what, std::string_view text) {
  scenegraph::SettingTexts settings;
  while (true) {
    const auto length = keyLength(text);
    if (!length) {
      return usageError(what + ": '" + std::string(text) + "' is not key=value");
    }
    const std::string key(text.substr(0, *length));
    text.remove_prefix(*length + 1);
    auto value = takeValue(text);
    if (!value) {
      return usageError(what + ": a quote is not closed");
    }
    if (!settings.emplace(key, std::move(*value)).second) {
      return usageError(what + " sets '" + key + "' twice");
    }
    if (text.empty()) {
      return settings;
    }
    text.remove_prefix(1);
  }
}

}  // namespace stillframe::cli
