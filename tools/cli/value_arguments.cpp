#include "tools/cli/value_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

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
  if (text.starts_with('#') && text.size() == 7) {
    const auto r = parseHex(text.substr(1, 2));
    const auto g = parseHex(text.substr(3, 2));
    const auto b = parseHex(text.substr(5, 2));
    if (r && g && b) {
      return scenegraph::Color{static_cast<float>(*r) / 255.0F, static_cast<float>(*g) / 255.0F,
                               static_cast<float>(*b) / 255.0F, 1.0F};
    }
  } else if (const auto rgb = parseVector(what, text)) {
    const double highest = std::max({rgb->x, rgb->y, rgb->z});
    const double scale = highest > 1.0 ? 255.0 : 1.0;
    if (std::min({rgb->x, rgb->y, rgb->z}) >= 0.0 && highest <= 255.0) {
      return scenegraph::Color{static_cast<float>(rgb->x / scale), static_cast<float>(rgb->y / scale),
                               static_cast<float>(rgb->z / scale), 1.0F};
    }
  }
  return usageError(quoted(what, text) + "is neither #rrggbb nor r,g,b with components 0..1 (or 0..255)");
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
