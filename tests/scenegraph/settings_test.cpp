#include "scenegraph/settings.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "scenegraph/near_names.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

SettingSpec spec(SettingKind kind, double minimum = 0.0, double maximum = 0.0) {
  SettingSpec made;
  made.key = "it";
  made.kind = kind;
  made.minimum = minimum;
  made.maximum = maximum;
  return made;
}

template <typename T>
T parsed(const SettingSpec& of, std::string_view text) {
  const auto value = parseSetting(of, text);
  EXPECT_TRUE(value.has_value()) << text;
  return value ? std::get<T>(*value) : T{};
}

std::string refused(const SettingSpec& of, std::string_view text) {
  const auto value = parseSetting(of, text);
  EXPECT_FALSE(value.has_value()) << text;
  return value ? "" : value.error().code;
}

TEST(Settings, DoublesComeBackBitForBit) {
  test::Random random(1);
  for (int i = 0; i < 2'000; ++i) {
    const double value = random.number(-1, 1) * std::pow(10.0, random.number(-300, 300));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parsed<double>(spec(SettingKind::Double), settingText(value))),
              std::bit_cast<std::uint64_t>(value));
  }
  for (const double value :
       {0.0, -0.0, std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()}) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parsed<double>(spec(SettingKind::Double), settingText(value))),
              std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Settings, EveryByteOfAColourComesBackBitForBit) {
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    const float part = static_cast<float>(byte) / 255.0F;
    const Color color{.r = part, .g = 1.0F, .b = part, .a = part};
    EXPECT_EQ(parsed<Color>(spec(SettingKind::Color), settingText(color)), color);
  }
  EXPECT_EQ(settingText(Color{.r = 2.0F, .g = -1.0F, .b = std::numeric_limits<float>::quiet_NaN(), .a = 0.5F}),
            "#ff000080");
}

TEST(Settings, ReadsTheWordsOfABool) {
  for (const char* text : {"true", "on", "1", "yes", " true "}) {
    EXPECT_TRUE(parsed<bool>(spec(SettingKind::Bool), text));
  }
  for (const char* text : {"false", "off", "0", "no"}) {
    EXPECT_FALSE(parsed<bool>(spec(SettingKind::Bool), text));
  }
  EXPECT_EQ(refused(spec(SettingKind::Bool), "True!"), "BadValue");
}

TEST(Settings, RefusesWhatIsNoNumberOrOutOfRange) {
  for (const char* text : {"", " ", "nan", "inf", "-inf", "1,5", "0x10", "1e", "++1", "+-1"}) {
    EXPECT_EQ(refused(spec(SettingKind::Double), text), "BadValue");
  }
  EXPECT_EQ(refused(spec(SettingKind::Double), "1e999"), "OutOfRange");
  EXPECT_EQ(refused(spec(SettingKind::Double, 0, 1), "1.0000001"), "OutOfRange");
  EXPECT_EQ(refused(spec(SettingKind::Int), "9223372036854775808"), "OutOfRange");
  EXPECT_EQ(refused(spec(SettingKind::Int), "1.0"), "BadValue");
  EXPECT_EQ(parsed<std::int64_t>(spec(SettingKind::Int), "-9223372036854775808"),
            std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parsed<std::int64_t>(spec(SettingKind::Int), "+5"), 5);
}

TEST(Settings, TextIsFreeUnlessChoicesOnly) {
  SettingSpec text = spec(SettingKind::Text);
  text.choices = {"turbo", "gray"};
  EXPECT_EQ(parsed<std::string>(text, " other "), " other ");
  text.choices_only = true;
  EXPECT_EQ(refused(text, "other"), "BadValue");
  EXPECT_TRUE(parseSetting(text, "x").error().message.contains("turbo, gray"));
  EXPECT_EQ(parsed<std::string>(text, "gray"), "gray");
}

TEST(NearNames, FindsTyposCaseAndParts) {
  const std::vector<std::string> known = {"map", "base_link", "base_footprint", "Odom", "lidar_top"};
  EXPECT_EQ(nearNames("base_lnk", known).front(), "base_link");
  EXPECT_EQ(nearNames("odom", known).front(), "Odom");
  EXPECT_EQ(nearNames("lidar", known).front(), "lidar_top");
  EXPECT_TRUE(nearNames("xyzzy", known).empty());
  EXPECT_TRUE(nearNames("", known).empty());
  EXPECT_EQ(quotedList(known, 2), "'map', 'base_link' and 3 more");
}

struct BaseSettings {
  double far_m = 2.0;
  std::string name = "base";
};
struct DerivedSettings : BaseSettings {
  bool on = false;
};

struct NothingToSet {};

TEST(SettingsTable, AnUnknownKeyIsToldWhatThereIsOrThatThereIsNothing) {
  NothingToSet nothing;
  const auto refused_by_none = SettingsTable<NothingToSet>({}).apply({{"foo", "1"}}, nothing);
  ASSERT_FALSE(refused_by_none);
  EXPECT_EQ(refused_by_none.error().code, "UnknownSetting");
  EXPECT_EQ(refused_by_none.error().message, "no setting 'foo'; there are none");
  EXPECT_EQ(unknownSetting("foo", {"a", "b"}).error().message, "no setting 'foo'; known: a, b");
}

TEST(SettingsTable, RefusesAnEndBelowTheOtherAndChangesNothing) {
  struct Ends {
    double low = 1.0;
    double high = 99.0;
  };
  const SettingsTable<Ends> table{
      {{.key = "low", .label = "Low", .help = "Low.", .kind = SettingKind::Double}, &Ends::low},
      {{.key = "high", .label = "High", .help = "High.", .kind = SettingKind::Double, .not_below = "low"},
       &Ends::high}};
  Ends ends;
  const auto refused = table.apply({{"low", "99.5"}}, ends);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "OutOfRange");
  EXPECT_EQ(refused.error().message, "high=99 is below low=99.5; both may be set at once");
  EXPECT_EQ(ends.low, 1.0);
  EXPECT_TRUE(table.apply({{"low", "99.5"}, {"high", "99.75"}}, ends));
  EXPECT_TRUE(table.apply({{"low", "99.75"}}, ends)) << "a range of one value";
  EXPECT_FALSE(table.apply({{"high", "50"}}, ends));
  EXPECT_EQ(ends.high, 99.75);
}

TEST(SettingsTable, TakesTheRowsOfABaseInTheirPlace) {
  const SettingsTable<BaseSettings> base{
      {{.key = "far", .label = "", .help = "", .kind = SettingKind::Double}, &BaseSettings::far_m},
      {{.key = "name", .label = "", .help = "", .kind = SettingKind::Text}, &BaseSettings::name}};
  const SettingsTable<DerivedSettings> table = SettingsTable<DerivedSettings>{
      {{.key = "on", .label = "", .help = "", .kind = SettingKind::Bool},
       &DerivedSettings::on}}.with(base);
  ASSERT_EQ(table.specs().size(), 3U);
  EXPECT_EQ(table.specs()[1].key, "far");

  DerivedSettings settings;
  ASSERT_TRUE(table.apply({{"on", "true"}, {"far", "7"}, {"name", "x"}}, settings));
  EXPECT_TRUE(settings.on);
  EXPECT_EQ(settings.far_m, 7.0);
  EXPECT_EQ(table.texts(settings), (SettingTexts{{"far", "7"}, {"name", "x"}, {"on", "true"}}));
}

}  // namespace
}  // namespace stillframe::scenegraph
