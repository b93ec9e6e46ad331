#include "tools/cli/value_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace stillframe::cli {
namespace {

std::optional<double> parseDouble(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string quoted(std::string_view what, std::string_view text) {
  return std::string(what) + " '" + std::string(text) + "' ";
}

std::optional<int> parseHex(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

Result<glm::dvec3> parseVector(std::string_view what, std::string_view text) {
  glm::dvec3 vector{0.0};
  std::string_view rest = text;
  for (glm::length_t i = 0; i < 3; ++i) {
    const std::size_t comma = rest.find(',');
    const auto value = parseDouble(rest.substr(0, comma));
    const bool is_last = comma == std::string_view::npos;
    if (!value || is_last != (i == 2)) {
      return usageError(quoted(what, text) + "is not three finite numbers x,y,z");
    }
    vector[i] = *value;
    rest.remove_prefix(is_last ? rest.size() : comma + 1);
  }
  return vector;
}

Result<PictureSize> parseSize(std::string_view text) {
  const std::size_t x = text.find('x');
  PictureSize size;
  if (x != std::string_view::npos) {
    const auto parse = [](std::string_view side, int& out) {
      const auto [end, error] = std::from_chars(side.data(), side.data() + side.size(), out);
      return error == std::errc{} && end == side.data() + side.size() && out >= 1 && out <= kMaxSide_px;
    };
    if (parse(text.substr(0, x), size.width_px) && parse(text.substr(x + 1), size.height_px)) {
      return size;
    }
  }
  return usageError(quoted("--size", text) + "is not WIDTHxHEIGHT with sides of 1 to " + std::to_string(kMaxSide_px) +
                    " pixels");
}

Result<scenegraph::Color> parseColor(std::string_view what, std::string_view text) {
  std::vector<double> parts;
  double whole = 1.0;
  if (text == "transparent") {
    parts = {0.0, 0.0, 0.0, 0.0};
  } else if (text.starts_with('#') && (text.size() == 7 || text.size() == 9)) {
    whole = 255.0;
    for (std::size_t i = 1; i < text.size(); i += 2) {
      parts.push_back(parseHex(text.substr(i, 2)).value_or(-1));
    }
  } else {
    std::string_view rest = text;
    std::size_t comma = 0;
    while (comma != std::string_view::npos) {
      comma = rest.find(',');
      parts.push_back(parseDouble(rest.substr(0, comma)).value_or(-1.0));
      rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    }
    whole = std::ranges::max(parts) > 1.0 ? 255.0 : 1.0;
  }
  const bool is_color = (parts.size() == 3 || parts.size() == 4) &&
                        std::ranges::all_of(parts, [&](double part) { return part >= 0.0 && part <= whole; });
  if (!is_color) {
    return usageError(quoted(what, text) +
                      "is none of #rrggbb, #rrggbbaa, r,g,b or r,g,b,a with components 0..1 (or 0..255), transparent");
  }
  const auto part = [&](std::size_t i) { return i < parts.size() ? static_cast<float>(parts[i] / whole) : 1.0F; };
  return scenegraph::Color{part(0), part(1), part(2), part(3)};
}

Result<double> parseNumber(std::string_view what, std::string_view text, double minimum, double maximum) {
  const auto value = parseDouble(text);
  if (!value || *value < minimum || *value > maximum) {
    char range[96];
    std::snprintf(range, sizeof range, "is not a number from %g to %g", minimum, maximum);
    return usageError(quoted(what, text) + range);
  }
  return *value;
}

}  // namespace stillframe::cli
