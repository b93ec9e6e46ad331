#include "tools/ingest/json_text.h"

#include <array>
#include <charconv>
#include <chrono>

namespace stillframe::ingest {

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

constexpr std::array<std::int8_t, 256> makeBase64Values() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
    values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  }
  values['+'] = values['-'] = 62;
  values['/'] = values['_'] = 63;
  return values;
}

/// Takes `digits` decimal digits off the front, then `separator` unless it is 0.
std::optional<int> takeNumber(std::string_view& text, std::size_t digits, char separator) {
  int value = 0;
  if (text.size() < digits || text[0] < '0' || text[0] > '9') {
    return std::nullopt;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + digits, value);
  if (error != std::errc{} || end != text.data() + digits) {
    return std::nullopt;
  }
  text.remove_prefix(digits);
  if (separator != 0) {
    if (!text.starts_with(separator)) {
      return std::nullopt;
    }
    text.remove_prefix(1);
  }
  return value;
}

/// Takes ".123" off the front, if it is there; in nanoseconds.
std::int64_t takeFraction(std::string_view& text) {
  std::int64_t nanoseconds = 0;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    for (std::int64_t unit = kSecond / 10; !text.empty() && text[0] >= '0' && text[0] <= '9'; unit /= 10) {
      nanoseconds += unit * (text[0] - '0');
      text.remove_prefix(1);
    }
  }
  return nanoseconds;
}

}  // namespace

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text) {
  static constexpr auto kValues = makeBase64Values();
  for (int i = 0; i < 2 && text.ends_with('='); ++i) {
    text.remove_suffix(1);
  }
  if (text.size() % 4 == 1) {
    return std::nullopt;
  }
  std::vector<std::byte> bytes(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int count = 0;
  std::size_t out = 0;
  for (const char c : text) {
    const std::int8_t value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) {
      return std::nullopt;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes[out++] = static_cast<std::byte>(bits >> count & 0xFFu);
    }
  }
  return bytes;
}

std::optional<std::int64_t> parseTime(std::string_view text) {
  const auto year = takeNumber(text, 4, '-');
  const auto month = year ? takeNumber(text, 2, '-') : std::nullopt;
  const auto day = month ? takeNumber(text, 2, 0) : std::nullopt;
  if (!day || text.empty() || (text[0] != 'T' && text[0] != 't' && text[0] != ' ')) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  const auto hour = takeNumber(text, 2, ':');
  const auto minute = hour ? takeNumber(text, 2, ':') : std::nullopt;
  const auto second = minute ? takeNumber(text, 2, 0) : std::nullopt;
  if (!second || *hour > 23 || *minute > 59 || *second > 60) {
    return std::nullopt;
  }
  const std::int64_t fraction = takeFraction(text);
  std::int64_t offset_minutes = 0;
  if (text.starts_with('+') || text.starts_with('-')) {
    const int sign = text[0] == '+' ? 1 : -1;
    text.remove_prefix(1);
    const auto offset_hour = takeNumber(text, 2, ':');
    const auto offset_minute = offset_hour ? takeNumber(text, 2, 0) : std::nullopt;
    if (!offset_minute || !text.empty()) {
      return std::nullopt;
    }
    offset_minutes = sign * (*offset_hour * 60 + *offset_minute);
  } else if (text != "Z" && text != "z") {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year{*year}, std::chrono::month{static_cast<unsigned>(*month)},
                                         std::chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) {
    return std::nullopt;
  }
  const std::int64_t days = std::chrono::sys_days{date}.time_since_epoch().count();
  const std::int64_t seconds = ((days * 24 + *hour) * 60 + *minute - offset_minutes) * 60 + *second;
  std::int64_t result = 0;
  if (__builtin_mul_overflow(seconds, kSecond, &result) || __builtin_add_overflow(result, fraction, &result)) {
    return std::nullopt;
  }
  return result;
}

std::optional<std::int64_t> parseDuration(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  text.remove_prefix(is_negative ? 1 : 0);
  std::int64_t seconds = 0;
  if (text.empty() || text[0] < '0' || text[0] > '9') {
    return std::nullopt;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc{}) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  const std::int64_t fraction = takeFraction(text);
  std::int64_t result = 0;
  if (text != "s" || __builtin_mul_overflow(seconds, kSecond, &result) ||
      __builtin_add_overflow(result, fraction, &result)) {
    return std::nullopt;
  }
  return is_negative ? -result : result;
}

}  // namespace stillframe::ingest
