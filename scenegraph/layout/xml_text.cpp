#include "scenegraph/layout/xml_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace stillframe::scenegraph {
namespace {

/// Length of the UTF-8 character at the head of `text` when XML can hold it, else 0.
std::size_t characterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) {
    return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  }
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  std::uint32_t code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return 0;
    }
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_held = first >= 0xC0 && first < 0xF8 && code >= kSmallest[length] && code <= 0x10FFFF &&
                       (code < 0xD800 || code > 0xDFFF) && code != 0xFFFE && code != 0xFFFF;
  return is_held ? length : 0;
}

void writeEscaped(std::string_view text, bool is_attribute, std::string& out) {
  while (!text.empty()) {
    const std::size_t length = characterLength(text);
    switch (length == 1 ? text.front() : 'x') {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += is_attribute ? "&quot;" : "\"";
        break;
      case '\r':
        out += "&#13;";
        break;
      case '\t':
        out += is_attribute ? "&#9;" : "\t";
        break;
      case '\n':
        out += is_attribute ? "&#10;" : "\n";
        break;
      default:
        out += length == 0 ? std::string_view("\xEF\xBF\xBD") : text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
}

}  // namespace

void appendXmlText(std::string_view text, std::string& out) { writeEscaped(text, false, out); }

void appendXmlAttribute(std::string_view text, std::string& out) { writeEscaped(text, true, out); }

void appendXmlComment(std::string_view text, std::string& out) {
  char before = ' ';
  while (!text.empty()) {
    const std::size_t length = characterLength(text);
    if (text.front() == '-' && before == '-') {
      out += ' ';
    }
    before = text.front();
    out += length == 0 || before == '\r' ? std::string_view("\xEF\xBF\xBD") : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  if (before == '-') {
    out += ' ';
  }
}

}  // namespace stillframe::scenegraph
