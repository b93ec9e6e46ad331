#include "scenegraph/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace stillframe::scenegraph {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto begin = text.find_first_not_of(kSpace);
  return begin == std::string_view::npos ? std::string_view{}
                                         : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) {
    all += (all.empty() ? "" : ", ") + word;
  }
  return all;
}

std::unexpected<SettingError> badValue(const SettingSpec& spec, std::string_view text, const std::string& wanted) {
  return std::unexpected(SettingError{"BadValue", spec.key + "='" + std::string(text) + "': " + wanted});
}

std::unexpected<SettingError> outOfRange(const SettingSpec& spec, std::string_view text) {
  std::string wanted = "too large to hold";
  if (spec.minimum < spec.maximum) {
    wanted = "accepted are " + settingText(spec.minimum) + " to " + settingText(spec.maximum);
  }
  return std::unexpected(SettingError{"OutOfRange", spec.key + "='" + std::string(text) + "': " + wanted});
}

template <typename T>
std::expected<SettingValue, SettingError> parseNumber(const SettingSpec& spec, std::string_view text,
                                                      const char* wanted) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') {
    digits.remove_prefix(1);
  }
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range && end == digits.data() + digits.size()) {
    return outOfRange(spec, text);
  }
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(static_cast<double>(value))) {
    return badValue(spec, text, wanted);
  }
  const auto as_double = static_cast<double>(value);
  if (spec.minimum < spec.maximum && (as_double < spec.minimum || as_double > spec.maximum)) {
    return outOfRange(spec, text);
  }
  return value;
}

std::optional<Color> parseColor(std::string_view text) {
  if ((text.size() != 7 && text.size() != 9) || text.front() != '#') {
    return std::nullopt;
  }
  std::array<float, 4> parts{1.0F, 1.0F, 1.0F, 1.0F};
  for (std::size_t i = 0; 1 + 2 * i < text.size(); ++i) {
    unsigned byte = 0;
    const char* const begin = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, byte, 16);
    if (error != std::errc{} || end != begin + 2) {
      return std::nullopt;
    }
    parts[i] = static_cast<float>(byte) / 255.0F;
  }
  return Color{parts[0], parts[1], parts[2], parts[3]};
}

}  // namespace

std::string settingText(bool value) { return value ? "true" : "false"; }

std::string settingText(std::int64_t value) { return std::to_string(value); }

std::string settingText(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string settingText(const std::string& value) { return value; }

std::string settingText(const Color& value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const float part : {value.r, value.g, value.b, value.a}) {
    // Written so that NaN becomes 0.
    const auto byte = static_cast<unsigned>(std::lround((part > 0.0F ? std::min(part, 1.0F) : 0.0F) * 255.0F));
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  if (text.ends_with("ff")) {
    text.resize(7);
  }
  return text;
}

std::unexpected<SettingError> unknownSetting(const std::string& key, const std::vector<std::string>& known) {
  return std::unexpected(SettingError{
      "UnknownSetting", "no setting '" + key + "'; " + (known.empty() ? "there are none" : "known: " + joined(known))});
}

std::unexpected<SettingError> wrongOrder(const SettingSpec& high, double value, const SettingSpec& low,
                                         double low_value) {
  return std::unexpected(SettingError{"OutOfRange", high.key + "=" + settingText(value) + " is below " + low.key + "=" +
                                                        settingText(low_value) + "; both may be set at once"});
}

std::expected<SettingValue, SettingError> parseSetting(const SettingSpec& spec, std::string_view text) {
  const std::string_view word = trimmed(text);
  switch (spec.kind) {
    case SettingKind::Bool:
      if (word == "true" || word == "on" || word == "1" || word == "yes") {
        return true;
      }
      if (word == "false" || word == "off" || word == "0" || word == "no") {
        return false;
      }
      return badValue(spec, text, "accepted are true and false");
    case SettingKind::Int:
      return parseNumber<std::int64_t>(spec, word, "a whole number is wanted");
    case SettingKind::Double:
      return parseNumber<double>(spec, word, "a finite number is wanted");
    case SettingKind::Text:
      if (spec.choices_only && std::ranges::find(spec.choices, text) == spec.choices.end()) {
        return badValue(spec, text, "accepted are " + joined(spec.choices));
      }
      return std::string(text);
    case SettingKind::Color:
      if (const auto color = parseColor(word)) {
        return *color;
      }
      return badValue(spec, text, "a colour is written #rrggbb or #rrggbbaa");
  }
  return badValue(spec, text, "the setting has no kind");
}

}  // namespace stillframe::scenegraph
