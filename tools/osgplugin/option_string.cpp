#include "tools/osgplugin/option_string.h"

#include <algorithm>
#include <utility>

namespace stillframe::osgplugin {
namespace {

/// Splits at `separator` outside of double quotes; keeps the quotes.
std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::string part;
  bool is_quoted = false;
  for (const char c : text) {
    is_quoted = is_quoted != (c == '"');
    if (c == separator && !is_quoted) {
      parts.push_back(std::exchange(part, {}));
    } else {
      part += c;
    }
  }
  parts.push_back(part);
  std::erase(parts, "");
  return parts;
}

std::string withoutQuotes(std::string text) {
  std::erase(text, '"');
  return text;
}

cli::Result<void> addLayer(cli::ViewOptions& view, const std::string& text) {
  auto layer = cli::parseLayer(text);
  if (!layer) {
    return std::unexpected(layer.error());
  }
  view.layers.push_back(std::move(*layer));
  return {};
}

cli::Result<void> addLayers(cli::ViewOptions& view, const std::string& list) {
  view.only_named_layers = true;
  for (const std::string& text : split(list, ';')) {
    if (auto added = addLayer(view, text); !added) {
      return added;
    }
  }
  return {};
}

template <typename T>
cli::Result<void> assign(T& target, const cli::Result<T>& parsed) {
  if (!parsed) {
    return std::unexpected(parsed.error());
  }
  target = *parsed;
  return {};
}

/// Whether the key is known; the error when its value is not.
cli::Result<bool> apply(cli::ViewOptions& view, const std::string& key, const std::string& value) {
  cli::Result<void> done;
  if (key == "time") {
    done = assign(view.time, cli::parseTime(withoutQuotes(value)));
  } else if (key == "fixed_frame") {
    view.fixed_frame = withoutQuotes(value);
  } else if (key == "tf_time") {
    done = assign(view.recording.clock, cli::parseTfClock(withoutQuotes(value)));
  } else if (key == "static_always") {
    view.recording.static_always = value.empty() || value == "true" || value == "1";
  } else if (key == "package_path") {
    view.recording.package_paths.push_back(withoutQuotes(value));
  } else if (key == "robot") {
    view.recording.robots.push_back(withoutQuotes(value));
  } else if (key == "layout") {
    auto layout = cli::readLayoutFile(withoutQuotes(value));
    done = layout ? cli::Result<void>() : std::unexpected(layout.error());
    view.layout = layout ? std::optional(*scenegraph::viewsOf(*layout).front()) : std::nullopt;
  } else if (key == "layers") {
    done = addLayers(view, value);
  } else if (key == "layer") {
    done = addLayer(view, value);
  } else if (key == "height") {
    double height_px = 0.0;
    done = assign(height_px, cli::parseNumber("height", withoutQuotes(value), 1, cli::kMaxSide_px));
    view.size.height_px = done ? static_cast<int>(height_px) : view.size.height_px;
  } else {
    return false;
  }
  if (!done) {
    return std::unexpected(done.error());
  }
  return true;
}

}  // namespace

cli::Result<PluginOptions> parseOptionString(std::string_view text) {
  PluginOptions options;
  for (const std::string& word : split(text, ' ')) {
    const std::size_t equals = word.find('=');
    const std::string value = equals == std::string::npos ? std::string() : word.substr(equals + 1);
    const auto known = apply(options.view, word.substr(0, equals), value);
    if (!known) {
      return std::unexpected(known.error());
    }
    if (!*known) {
      options.unknown.push_back(word);
    }
  }
  return options;
}

}  // namespace stillframe::osgplugin
