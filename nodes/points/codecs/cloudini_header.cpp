#include "nodes/points/codecs/cloudini_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

namespace stillframe::nodes::cloudini {
namespace {

using std::unexpected;

constexpr std::string_view kMagic = "CLOUDINI_V";
constexpr std::size_t kMagicSize = kMagic.size() + 2;
constexpr std::size_t kMaxFields = 1024;
constexpr std::array<std::string_view, 11> kTypeNames = {"UNKNOWN", "INT8",    "UINT8",   "INT16", "UINT16", "INT32",
                                                         "UINT32",  "FLOAT32", "FLOAT64", "INT64", "UINT64"};
constexpr std::array<std::string_view, 3> kEncodingNames = {"NONE", "LOSSY", "LOSSLESS"};
constexpr std::array<std::string_view, 3> kCompressionNames = {"NONE", "LZ4", "ZSTD"};

unexpected<CodecError> malformed(const std::string& what) {
  return unexpected(CodecError{CodecErrorCode::MalformedHeader, "the Cloudini header " + what});
}
unexpected<CodecError> unsupported(const std::string& what) {
  return unexpected(CodecError{CodecErrorCode::UnsupportedVersion, what});
}

std::string quoted(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + "'"; }

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

template <typename Number>
std::optional<Number> toNumber(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

template <std::size_t N>
std::optional<std::uint8_t> indexOf(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::uint8_t>(found - names.begin()));
}

/// Sets what one "key: value" line says; keys that are not known are left alone, for the writers to come.
class YamlHeader {
 public:
  explicit YamlHeader(Header& header) : header_(header) {}

  std::expected<void, CodecError> take(std::string_view line) {
    const bool is_indented = line.starts_with(' ') || line.starts_with('\t') || line.starts_with('-');
    line = trim(line);
    if (line.empty() || line.starts_with('#')) {
      return {};
    }
    if (line.starts_with("- ")) {
      line = trim(line.substr(2));
      if (is_in_fields_) {
        if (header_.fields.size() == kMaxFields) {
          return malformed("names more than 1024 fields");
        }
        header_.fields.emplace_back();
      }
    }
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) {
      return malformed("has the line " + quoted(line) + " without a colon");
    }
    const std::string_view key = trim(line.substr(0, colon));
    const std::string_view value = trim(line.substr(colon + 1));
    if (!is_indented) {
      is_in_fields_ = key == "fields";
    }
    const bool is_understood = is_in_fields_ ? takeField(key, value) : takeTop(key, value);
    return is_understood ? std::expected<void, CodecError>() : malformed("has the line " + quoted(line));
  }

  [[nodiscard]] bool isComplete() const { return seen_ == 0x1f; }

 private:
  bool takeTop(std::string_view key, std::string_view value) {
    const auto number = toNumber<std::uint32_t>(value);
    const auto set = [&](unsigned bit, auto& target, const auto& parsed) {
      seen_ |= 1U << bit;
      if (parsed) {
        target = static_cast<std::remove_reference_t<decltype(target)>>(*parsed);
      }
      return parsed.has_value();
    };
    if (key == "width") {
      return set(0, header_.width, number);
    }
    if (key == "height") {
      return set(1, header_.height, number);
    }
    if (key == "point_step") {
      return set(2, header_.point_step, number);
    }
    if (key == "encoding_opt") {
      return set(3, header_.encoding, indexOf(kEncodingNames, value));
    }
    if (key == "compression_opt") {
      return set(4, header_.compression, indexOf(kCompressionNames, value));
    }
    return true;
  }
  bool takeField(std::string_view key, std::string_view value) {
    if (key == "fields") {
      return true;
    }
    if (header_.fields.empty()) {
      return false;
    }
    Field& field = header_.fields.back();
    if (key == "name") {
      field.name = value;
      return true;
    }
    if (key == "offset") {
      const auto number = toNumber<std::uint32_t>(value);
      field.offset = number.value_or(0);
      return number.has_value();
    }
    if (key == "type") {
      const auto type = indexOf(kTypeNames, value);
      field.type = static_cast<ValueType>(type.value_or(0));
      return type.value_or(0) != 0;
    }
    if (key == "resolution" && value != "null" && value != "~" && !value.empty()) {
      field.resolution = toNumber<float>(value);
      return field.resolution && std::isfinite(*field.resolution) && *field.resolution > 0.0F;
    }
    return true;
  }

  Header& header_;
  bool is_in_fields_ = false;
  unsigned seen_ = 0;
};

std::expected<Header, CodecError> readYaml(std::string_view text, Header header) {
  const auto end = text.find('\0');
  if (end == std::string_view::npos) {
    return malformed("is text without the NUL that ends it");
  }
  header.size = kMagicSize + end + 1;
  text = text.substr(0, end);
  YamlHeader yaml(header);
  while (!text.empty()) {
    const auto line_end = std::min(text.find('\n'), text.size());
    if (const auto taken = yaml.take(text.substr(0, line_end)); !taken) {
      return unexpected(taken.error());
    }
    text.remove_prefix(std::min(line_end + 1, text.size()));
  }
  if (!yaml.isComplete()) {
    return malformed("does not state width, height, point_step, encoding_opt and compression_opt");
  }
  return header;
}

std::expected<Header, CodecError> readBinary(std::span<const std::byte> blob, Header header) {
  std::size_t at = kMagicSize;
  bool is_short = false;
  const auto read = [&]<typename T>(T& value) {
    if (is_short || blob.size() - at < sizeof(T)) {
      is_short = true;
      return;
    }
    std::memcpy(&value, blob.data() + at, sizeof(T));
    at += sizeof(T);
  };
  std::uint8_t encoding = 0;
  std::uint8_t compression = 0;
  std::uint16_t field_count = 0;
  read(header.width);
  read(header.height);
  read(header.point_step);
  read(encoding);
  read(compression);
  read(field_count);
  if (!is_short && (encoding >= kEncodingNames.size() || compression >= kCompressionNames.size())) {
    return malformed("names encoding " + std::to_string(encoding) + " and compression " + std::to_string(compression) +
                     ", which do not exist");
  }
  if (field_count > kMaxFields) {
    return malformed("names " + std::to_string(field_count) + " fields: more than 1024");
  }
  header.encoding = static_cast<Encoding>(encoding);
  header.compression = static_cast<Compression>(compression);
  for (unsigned i = 0; i < field_count && !is_short; ++i) {
    Field field;
    std::uint16_t length = 0;
    std::uint8_t type = 0;
    float resolution = 0.0F;
    read(length);
    if (is_short || blob.size() - at < length) {
      is_short = true;
      break;
    }
    field.name.assign(reinterpret_cast<const char*>(blob.data()) + at, length);
    at += length;
    read(field.offset);
    read(type);
    read(resolution);
    if (!is_short && (type == 0 || type >= kTypeNames.size())) {
      return malformed("gives field " + quoted(field.name) + " the type " + std::to_string(type) +
                       ", which does not exist");
    }
    field.type = static_cast<ValueType>(type);
    if (std::isfinite(resolution) && resolution > 0.0F) {
      field.resolution = resolution;
    }
    header.fields.push_back(std::move(field));
  }
  if (is_short) {
    return malformed("ends after " + std::to_string(blob.size()) + " bytes");
  }
  header.size = at;
  return header;
}

/// A width of 10 begins with the same byte as the text; but text goes on with a key.
bool isYaml(std::string_view rest) {
  if (!rest.starts_with('\n')) {
    return false;
  }
  const auto colon = rest.find(':');
  return colon != std::string_view::npos && std::ranges::all_of(rest.substr(1, colon - 1), [](char c) {
           return (c >= 'a' && c <= 'z') || c == '_' || c == ' ';
         });
}

}  // namespace

std::uint32_t byteSize(ValueType type) noexcept {
  constexpr std::array<std::uint32_t, 11> kSizes = {0, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::expected<Header, CodecError> readHeader(std::span<const std::byte> blob) {
  const std::string_view text(reinterpret_cast<const char*>(blob.data()), blob.size());
  if (text.size() < kMagicSize || !text.starts_with(kMagic)) {
    return malformed("is missing: " + std::to_string(blob.size()) + " bytes that do not begin with 'CLOUDINI_V'");
  }
  const auto version = toNumber<unsigned>(text.substr(kMagic.size(), 2));
  if (!version) {
    return malformed("has no version number");
  }
  if (*version < 3 || *version > 5) {
    return unsupported("the cloud is of Cloudini version " + std::to_string(*version) + "; 3, 4 and 5 are read" +
                       (*version == 6 ? ", 6 is an experiment whose layout is not settled" : ""));
  }
  Header header;
  header.version = *version;
  return isYaml(text.substr(kMagicSize)) ? readYaml(text.substr(kMagicSize), std::move(header))
                                         : readBinary(blob, std::move(header));
}

}  // namespace stillframe::nodes::cloudini
