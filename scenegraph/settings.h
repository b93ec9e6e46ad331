#pragma once

#include <algorithm>
#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace stillframe::scenegraph {

/// Colour as the user writes it: sRGB-encoded components 0..1, alpha linear.
struct Color {
  float r = 1.0F;
  float g = 1.0F;
  float b = 1.0F;
  float a = 1.0F;

  friend bool operator==(const Color&, const Color&) = default;
};

/// What kind of widget and what text a setting takes.
enum class SettingKind : std::uint8_t {
  Bool,    ///< "true", "false" ("on", "off", "1", "0", "yes", "no" are read too)
  Int,     ///< decimal
  Double,  ///< shortest text that reads back exactly; "nan" and "inf" never
  Text,    ///< anything; with choices: a combo box, other text allowed unless choices_only
  Color,   ///< "#rrggbb" or "#rrggbbaa"
};

/// One setting of a layer, view or pass: enough to build a widget, a command-line key and an XML attribute from.
struct SettingSpec {
  std::string key;    ///< snake_case, as in `--layer TOPIC:key=value`
  std::string label;  ///< for people, with the unit
  std::string help;   ///< one sentence
  SettingKind kind = SettingKind::Text;
  double minimum = 0.0;  ///< Int and Double; equal to maximum: unbounded
  double maximum = 0.0;
  std::string not_below = {};  ///< Double: the key of another, less than which this must not be
  std::vector<std::string> choices = {};
  bool choices_only = false;
  /// Settings of many like things, each with its own, are shown as a row a thing, which "Namespaces" or "Links" (the
  /// group) fold away; a Bool is the row's check box.
  std::string group = {};
  std::string item = {};  ///< the thing's name, for people
};

/// Settings by key in text form: what the CLI parses and layouts store. Text round-trips exactly.
using SettingTexts = std::map<std::string, std::string>;

/// A setting that was refused.
struct SettingError {
  std::string code;     ///< "UnknownSetting", "BadValue", "OutOfRange"
  std::string message;  ///< names the key, the text and what would be accepted
};

/// The error "UnknownSetting", with those that there are.
[[nodiscard]] std::unexpected<SettingError> unknownSetting(const std::string& key,
                                                           const std::vector<std::string>& known);

/// The error "OutOfRange" of a setting that is less than the one it must not be below.
[[nodiscard]] std::unexpected<SettingError> wrongOrder(const SettingSpec& high, double value, const SettingSpec& low,
                                                       double low_value);

/// A parsed setting.
using SettingValue = std::variant<bool, std::int64_t, double, std::string, Color>;

/// Binds keys to members of a plain settings struct, so that a layer lists each setting once.
///
/// ```cpp
/// const SettingsTable<Settings>& table() {
///   static const SettingsTable<Settings> kTable{
///       {{.key = "size", .label = "Size (m)", .help = "...", .kind = SettingKind::Double, .minimum = 0, .maximum =
///       1e6},
///        &Settings::size_m}, ...};
/// ```
/// Values are checked against kind, range and choices before they are stored.
template <typename S>
class SettingsTable {
 public:
  using Member = std::variant<bool S::*, std::int64_t S::*, double S::*, std::string S::*, Color S::*>;
  struct Row {
    SettingSpec spec;
    Member member;
  };
  SettingsTable(std::initializer_list<Row> rows) : rows_(rows) {}
  /// These rows and those of `more`, whose settings are ours too (a base of S, or S itself).
  template <typename Base>
    requires std::is_base_of_v<Base, S>
  [[nodiscard]] SettingsTable with(const SettingsTable<Base>& more) const;

  [[nodiscard]] std::vector<SettingSpec> specs() const;
  [[nodiscard]] SettingTexts texts(const S& settings) const;
  /// Sets what `texts` names; on error nothing is changed.
  std::expected<void, SettingError> apply(const SettingTexts& texts, S& settings) const;

 private:
  template <typename Other>
  friend class SettingsTable;
  [[nodiscard]] const Row* find(const std::string& key) const;
  // Not inlined: GCC 12 would warn (-Warray-bounds) of member types that S does not have.
  [[gnu::noinline]] static void assign(S& settings, const Member& member, const SettingValue& value);

  std::vector<Row> rows_;
};

/// Text of one value and back; the shared part of SettingsTable.
[[nodiscard]] std::string settingText(bool value);
[[nodiscard]] std::string settingText(std::int64_t value);
[[nodiscard]] std::string settingText(double value);
[[nodiscard]] std::string settingText(const std::string& value);
[[nodiscard]] std::string settingText(const Color& value);
[[nodiscard]] std::expected<SettingValue, SettingError> parseSetting(const SettingSpec& spec, std::string_view text);

template <typename S>
void SettingsTable<S>::assign(S& settings, const Member& member, const SettingValue& value) {
  std::visit(
      [&](auto pointer) {
        using Value = std::remove_reference_t<decltype(settings.*pointer)>;
        settings.*pointer = std::get<Value>(value);
      },
      member);
}

template <typename S>
template <typename Base>
  requires std::is_base_of_v<Base, S>
SettingsTable<S> SettingsTable<S>::with(const SettingsTable<Base>& more) const {
  SettingsTable all = *this;
  for (const auto& row : more.rows_) {
    all.rows_.push_back(
        {row.spec,
         std::visit([]<typename Value>(Value Base::* member) { return Member(static_cast<Value S::*>(member)); },
                    row.member)});
  }
  return all;
}

template <typename S>
std::vector<SettingSpec> SettingsTable<S>::specs() const {
  std::vector<SettingSpec> specs;
  for (const Row& row : rows_) {
    specs.push_back(row.spec);
  }
  return specs;
}

template <typename S>
SettingTexts SettingsTable<S>::texts(const S& settings) const {
  SettingTexts texts;
  for (const Row& row : rows_) {
    texts[row.spec.key] = std::visit([&](auto member) { return settingText(settings.*member); }, row.member);
  }
  return texts;
}

template <typename S>
auto SettingsTable<S>::find(const std::string& key) const -> const Row* {
  const auto row = std::ranges::find(rows_, key, [](const Row& each) -> const std::string& { return each.spec.key; });
  return row == rows_.end() ? nullptr : &*row;
}

template <typename S>
std::expected<void, SettingError> SettingsTable<S>::apply(const SettingTexts& texts, S& settings) const {
  S changed = settings;
  for (const auto& [key, text] : texts) {
    const Row* const found = find(key);
    if (found == nullptr) {
      std::vector<std::string> known;
      for (const Row& row : rows_) {
        known.push_back(row.spec.key);
      }
      return unknownSetting(key, known);
    }
    const auto value = parseSetting(found->spec, text);
    if (!value) {
      return std::unexpected(value.error());
    }
    assign(changed, found->member, *value);
  }
  for (const Row& high : rows_) {
    if (const Row* const low = find(high.spec.not_below)) {
      const double least = changed.*std::get<double S::*>(low->member);
      if (const double value = changed.*std::get<double S::*>(high.member); value < least) {
        return wrongOrder(high.spec, value, low->spec, least);
      }
    }
  }
  settings = std::move(changed);
  return {};
}

}  // namespace stillframe::scenegraph
