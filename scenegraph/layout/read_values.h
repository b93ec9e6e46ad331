#pragma once

#include <cstdint>
#include <expected>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/layout/xml.h"
#include "scenegraph/settings.h"

namespace stillframe::scenegraph {

/// Why an element of a layout cannot be read: "<Layer id="/points">: visible='maybe': accepted are true and false".
[[nodiscard]] Status badElement(const XmlElement& element, const std::string& why);

/// Refuses an element whose version is not `version`, with the code "WrongVersion".
[[nodiscard]] std::expected<void, Status> checkVersion(const XmlElement& element, int version);

/// Attribute `key` as a switch, or `absent` where there is none.
[[nodiscard]] std::expected<bool, Status> readBool(const XmlElement& element, const std::string& key, bool absent);
/// Attribute `key` as a whole number within a range.
[[nodiscard]] std::expected<int, Status> readInt(const XmlElement& element, const std::string& key, int absent,
                                                 int minimum, int maximum);
/// The same of 64 bits.
[[nodiscard]] std::expected<std::int64_t, Status> readInt64(const XmlElement& element, const std::string& key,
                                                            std::int64_t absent);
/// Attribute `key` as a finite number, within a range where minimum and maximum differ.
[[nodiscard]] std::expected<double, Status> readDouble(const XmlElement& element, const std::string& key, double absent,
                                                       double minimum = 0.0, double maximum = 0.0);
[[nodiscard]] std::string readText(const XmlElement& element, const std::string& key);

/// What writing knows of an element by its name: its own attributes and children; all else is somebody else's.
struct KnownElement {
  std::string_view name;
  std::vector<std::string> attributes;
  std::vector<std::string_view> children = {};
  std::string_view key = {};  ///< the attribute that tells several of them apart
};

/// Adds to `fresh` what `source`, the element it was once read from, holds besides what is known, in all its depth:
/// elements behind the known ones, comments before what they stood before.
void keepUnknown(XmlElement& fresh, const XmlElement& source, std::span<const KnownElement> known);

}  // namespace stillframe::scenegraph
