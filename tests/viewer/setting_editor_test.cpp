#include "viewer/layers/setting_editor.h"

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QTreeWidget>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "viewer/layers/number_box.h"
#include "viewer/layers/range_editor.h"
#include "viewer/layers/range_strip.h"
#include "viewer/layers/setting_rows.h"

namespace stillframe::viewer {
namespace {

using scenegraph::SettingKind;
using scenegraph::SettingSpec;
using scenegraph::SettingTexts;

SettingSpec spec(const char* key, SettingKind kind) { return {.key = key, .label = key, .help = "", .kind = kind}; }

TEST(SettingEditor, BuildsAWidgetForEachKindAndReportsEdits) {
  QString heard;
  const auto watch = [&](SettingEditor& editor) {
    QObject::connect(&editor, &SettingEditor::edited, &editor,
                     [&](const QString& key, const QString& text) { heard = key + QLatin1Char('=') + text; });
  };
  SettingEditor on({.key = "on", .label = "On", .help = "", .kind = SettingKind::Bool}, "true");
  watch(on);
  auto* box = on.findChild<QCheckBox*>();
  ASSERT_NE(box, nullptr);
  EXPECT_TRUE(box->isChecked());
  box->click();
  EXPECT_EQ(heard, QStringLiteral("on=false"));

  SettingEditor size(
      {.key = "size", .label = "Size", .help = "", .kind = SettingKind::Double, .minimum = 0.0, .maximum = 2.0}, "0.3");
  watch(size);
  EXPECT_NE(size.findChild<QSlider*>(), nullptr);
  size.findChild<NumberBox*>()->setValue(0.5);
  EXPECT_EQ(heard, QStringLiteral("size=0.5"));
  EXPECT_EQ(size.findChild<QSlider*>()->value(), 250);

  SettingEditor map({.key = "map",
                     .label = "Map",
                     .help = "",
                     .kind = SettingKind::Text,
                     .choices = {"turbo", "viridis"},
                     .choices_only = true},
                    "turbo");
  watch(map);
  auto* combo = map.findChild<QComboBox*>();
  ASSERT_NE(combo, nullptr);
  EXPECT_FALSE(combo->isEditable());
  QTest::keyClick(combo, Qt::Key_Down);
  EXPECT_EQ(heard, QStringLiteral("map=viridis"));

  SettingEditor color({.key = "color", .label = "Colour", .help = "", .kind = SettingKind::Color}, "#ff0000");
  EXPECT_EQ(color.findChild<QPushButton*>()->text(), QStringLiteral("#ff0000"));
}

TEST(SettingEditor, ShowingAValueReportsNothing) {
  SettingEditor size(
      {.key = "size", .label = "Size", .help = "", .kind = SettingKind::Double, .minimum = 0.0, .maximum = 2.0}, "0.3");
  int edits = 0;
  QObject::connect(&size, &SettingEditor::edited, &size, [&] { ++edits; });
  size.setText("0.123456789");
  EXPECT_EQ(edits, 0) << "else the rounding of a spin box would reach the layer";
}

TEST(SettingEditor, AChoiceAmongManyIsFoundByAPartOfItsName) {
  SettingSpec map = spec("map", SettingKind::Text);
  map.choices = {"turbo", "viridis", "plasma", "inferno", "magma", "cividis", "coolwarm", "grayscale"};
  map.choices_only = true;
  SettingEditor editor(map, "turbo");
  QString heard;
  QObject::connect(&editor, &SettingEditor::edited, &editor,
                   [&](const QString&, const QString& text) { heard = text; });
  auto* combo = editor.findChild<QComboBox*>();
  ASSERT_TRUE(combo->isEditable());
  EXPECT_EQ(combo->completer()->filterMode(), Qt::MatchContains);
  combo->lineEdit()->selectAll();
  QTest::keyClicks(combo->lineEdit(), QStringLiteral("magma"));
  QTest::keyClick(combo->lineEdit(), Qt::Key_Return);
  EXPECT_EQ(heard, QStringLiteral("magma"));
  combo->lineEdit()->selectAll();
  QTest::keyClicks(combo->lineEdit(), QStringLiteral("mag"));
  combo->completer()->popup()->hide();
  QTest::keyClick(combo->lineEdit(), Qt::Key_Return);
  EXPECT_EQ(combo->currentText(), QStringLiteral("magma"));
  combo->lineEdit()->selectAll();
  QTest::keyClicks(combo->lineEdit(), QStringLiteral("gray"));
  combo->completer()->popup()->hide();
  QTest::keyClick(combo->lineEdit(), Qt::Key_Return);
  EXPECT_EQ(heard, QStringLiteral("grayscale")) << "the first that has it";
  combo->lineEdit()->selectAll();
  QTest::keyClicks(combo->lineEdit(), QStringLiteral("xyz"));
  QTest::keyClick(combo->lineEdit(), Qt::Key_Return);
  EXPECT_EQ(combo->currentText(), QStringLiteral("grayscale")) << "what no name has is none";
  EXPECT_EQ(heard, QStringLiteral("grayscale"));
}

TEST(SettingEditor, TheWheelChangesNothingThatItMerelyPassesOver) {
  SettingSpec size = spec("size", SettingKind::Double);
  size.maximum = 2.0;
  SettingEditor editor(size, "1");
  editor.show();
  for (QWidget* const part : editor.findChildren<QWidget*>()) {
    const QPointF middle(part->width() / 2.0, part->height() / 2.0);
    QWheelEvent wheel(middle, part->mapToGlobal(middle), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                      false);
    QCoreApplication::sendEvent(part, &wheel);
  }
  EXPECT_DOUBLE_EQ(editor.findChild<NumberBox*>()->value(), 1.0);
}

TEST(NumberBox, ShowsEveryNumberWithAllItsDigits) {
  NumberBox box(-kLargestNumber, kLargestNumber);
  for (const auto& [value, text] :
       {std::pair{2.0, "2"}, {0.1, "0.1"}, {1e-9, "1e-09"}, {-123456789.125, "-123456789.125"}}) {
    box.setValue(value);
    EXPECT_EQ(box.value(), value);
    EXPECT_EQ(box.text(), QLatin1String(text));
  }
  box.setValue(1e-300);
  EXPECT_GT(box.value(), 0.0);
}

TEST(NumberBox, StepsByItsOwnSize) {
  NumberBox box(-kLargestNumber, kLargestNumber);
  for (const auto& [from, steps, to] :
       {std::tuple{0.0, 1, 0.1}, {0.3, 1, 0.31}, {12.0, -1, 11.0}, {1e-9, 1, 1.1e-9}, {5e8, 2, 5.2e8}}) {
    box.setValue(from);
    box.stepBy(steps);
    EXPECT_DOUBLE_EQ(box.value(), to) << from;
  }
}

TEST(NumberBox, TakesTypedNumbersOfAnyForm) {
  NumberBox box(-kLargestNumber, kLargestNumber);
  box.findChild<QLineEdit*>()->selectAll();
  QTest::keyClicks(&box, QStringLiteral("-2.5e-3"));
  QTest::keyClick(&box, Qt::Key_Return);
  EXPECT_DOUBLE_EQ(box.value(), -2.5e-3);
  box.findChild<QLineEdit*>()->selectAll();
  QTest::keyClicks(&box, QStringLiteral("nan"));
  QTest::keyClick(&box, Qt::Key_Return);
  EXPECT_DOUBLE_EQ(box.value(), -2.5e-3);
}

TEST(NumberBox, ANumberBeyondItsEndsBecomesTheEnd) {
  NumberBox box(0.0, 100.0);
  box.setSuffix(QStringLiteral(" %"));
  const auto type = [&](const char* text) {
    box.findChild<QLineEdit*>()->selectAll();
    QTest::keyClicks(&box, QLatin1String(text));
    QTest::keyClick(&box, Qt::Key_Return);
    return box.value();
  };
  EXPECT_DOUBLE_EQ(type("150"), 100.0);
  EXPECT_DOUBLE_EQ(type("-3"), 0.0);
  EXPECT_DOUBLE_EQ(type("1e999"), 100.0) << "more than a double holds";
  EXPECT_DOUBLE_EQ(type("-"), 100.0) << "no number";
}

class RangeEditorTest : public testing::Test {
 protected:
  RangeEditorTest() {
    editor.resize(200, 100);
    editor.setTexts({{"range_mode", "auto"},
                     {"range_min", "0"},
                     {"range_max", "1"},
                     {"percentile_low", "1"},
                     {"percentile_high", "99"}});
    editor.setLegend(scenegraph::ColorLegend{
        .title = "z", .unit = "m", .low = 2.0, .high = 6.0, .colors = {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}});
    QObject::connect(&editor, &RangeEditor::edited, &editor, [this](const SettingTexts& texts) { heard = texts; });
  }
  static std::vector<SettingSpec> specs() {
    std::vector<SettingSpec> specs;
    for (const char* key : {"range_min", "range_max", "percentile_low", "percentile_high"}) {
      specs.push_back(spec(key, SettingKind::Double));
    }
    specs.push_back(spec("range_mode", SettingKind::Text));
    specs.back().choices = {"auto", "percentile", "manual"};
    return specs;
  }
  NumberBox& box(const char* name) { return *editor.findChild<NumberBox*>(QLatin1String(name)); }

  RangeEditor editor{specs()};
  SettingTexts heard;
};

TEST_F(RangeEditorTest, ShowsTheRangeThatAutoHasFound) {
  EXPECT_DOUBLE_EQ(box("low").value(), 2.0);
  EXPECT_DOUBLE_EQ(box("high").value(), 6.0);
  EXPECT_FALSE(box("low").isEnabled());
  EXPECT_TRUE(heard.empty());
}

TEST_F(RangeEditorTest, ManualBeginsWithTheRangeInUse) {
  auto* mode = editor.findChild<QComboBox*>();
  QTest::keyClick(mode, Qt::Key_End);
  EXPECT_EQ(heard, (SettingTexts{{"range_mode", "manual"}, {"range_min", "2"}, {"range_max", "6"}}));
}

TEST_F(RangeEditorTest, PercentilesHaveTheirOwnEnds) {
  editor.setTexts({{"range_mode", "percentile"}, {"percentile_low", "5"}, {"percentile_high", "95"}});
  EXPECT_EQ(box("low").text(), QStringLiteral("5 %"));
  box("high").setValue(90.0);
  EXPECT_EQ(heard, (SettingTexts{{"percentile_low", "5"}, {"percentile_high", "90"}}));
  box("high").setValue(200.0);
  EXPECT_DOUBLE_EQ(box("high").value(), 100.0);
}

TEST_F(RangeEditorTest, APercentileTakesTheOtherAlongWhenItPassesIt) {
  editor.setTexts({{"range_mode", "percentile"}, {"percentile_low", "5"}, {"percentile_high", "95"}});
  box("low").setValue(97.0);
  EXPECT_EQ(heard, (SettingTexts{{"percentile_low", "97"}, {"percentile_high", "97"}}));
  editor.setTexts({{"range_mode", "percentile"}, {"percentile_low", "20"}, {"percentile_high", "95"}});
  box("high").setValue(10.0);
  EXPECT_EQ(heard, (SettingTexts{{"percentile_low", "10"}, {"percentile_high", "10"}}));
  editor.setTexts({{"range_mode", "manual"}, {"range_min", "5"}, {"range_max", "8"}});
  box("low").setValue(9.0);
  EXPECT_EQ(heard, (SettingTexts{{"range_min", "9"}, {"range_max", "8"}})) << "a range may run downwards";
}

TEST_F(RangeEditorTest, AnEndIsDraggedInTheHistogram) {
  editor.setHistogram({.low = 0.0, .high = 10.0, .counts = {1, 5, 2, 0, 1}});
  editor.show();
  RangeStrip& strip = editor.strip();
  const auto at = [&](double value) { return QPoint(static_cast<int>(strip.xOf(value)), strip.height() / 2); };
  QTest::mousePress(&strip, Qt::LeftButton, {}, at(6.0));
  QTest::mouseMove(&strip, at(8.0));
  QTest::mouseRelease(&strip, Qt::LeftButton, {}, at(8.0));
  EXPECT_EQ(heard["range_mode"], "manual");
  EXPECT_EQ(heard["range_min"], "2") << "the other end stays";
  EXPECT_NEAR(std::stod(heard["range_max"]), 8.0, 0.2);
  heard.clear();
  QTest::mousePress(&strip, Qt::LeftButton, {}, at(4.0));
  QTest::mouseMove(&strip, at(5.0));
  EXPECT_TRUE(heard.empty()) << "nothing is taken hold of between the ends";
}

TEST_F(RangeEditorTest, ADraggedEndHasNoMoreDigitsThanPixelsTell) {
  editor.show();
  RangeStrip& strip = editor.strip();
  for (const auto& [left, right, most] :
       {std::tuple{0.0, 190.0, 4}, {-1e-7, 3e-7, 4}, {1e9, 1e9 + 1.0, 13}, {-3e12, 7e12, 5}, {1e18, 1e18 + 1e5, 19}}) {
    editor.setLegend(scenegraph::ColorLegend{.title = "", .unit = "", .low = left, .high = right, .colors = {{}, {}}});
    const double pixel = (right - left) / (strip.width() - 10);
    const QPoint from(static_cast<int>(strip.xOf(left)), strip.height() / 2);
    QTest::mousePress(&strip, Qt::LeftButton, {}, from);
    QTest::mouseMove(&strip, from + QPoint(31, 0));
    QTest::mouseRelease(&strip, Qt::LeftButton, {}, from + QPoint(31, 0));
    const std::string& text = heard["range_min"];
    EXPECT_NEAR(std::stod(text), left + 31.0 * pixel, 0.51 * pixel + 256.0 * (left == 1e18)) << text;
    const auto digits =
        std::count_if(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(text.find('e'), text.size())),
                      [](char c) { return c >= '0' && c <= '9'; });
    EXPECT_LE(digits, most) << text;
    heard.clear();
  }
}

TEST_F(RangeEditorTest, EndsBeyondAllSenseAreShownAtTheRim) {
  for (const auto& [low, high] : {std::pair{-1e300, 1e300}, {3.0, 3.0}, {std::nan(""), 1.0}, {6.0, 2.0}}) {
    editor.setLegend(scenegraph::ColorLegend{.title = "", .unit = "", .low = low, .high = high, .colors = {{}, {}}});
    EXPECT_GE(editor.strip().xOf(low), 0.0);
    EXPECT_LE(editor.strip().xOf(high), editor.strip().width());
    (void)editor.strip().grab();
  }
}

class SettingRowsTest : public testing::Test {
 protected:
  SettingRowsTest() {
    for (const char* link : {"arm", "base"}) {
      specs.push_back(spec(link, SettingKind::Bool));
      specs.push_back(spec(link, SettingKind::Double));
      for (std::size_t i = specs.size() - 2; i < specs.size(); ++i) {
        specs[i].key += i % 2 == 1 ? ".visible" : ".opacity";
        specs[i].group = "Links";
        specs[i].item = link;
      }
    }
    QObject::connect(&rows, &SettingRows::edited, &tree, [this](const SettingTexts& edited) { heard = edited; });
    QObject::connect(&tree, &QTreeWidget::itemChanged, &tree, [this](QTreeWidgetItem* item) { rows.takeCheck(item); });
    rows.show(specs, texts);
  }
  QTreeWidget tree;
  QTreeWidgetItem* layer = new QTreeWidgetItem(&tree);
  SettingRows rows{tree, *layer};
  std::vector<SettingSpec> specs{spec("opacity", SettingKind::Double)};
  SettingTexts texts{{"opacity", "1"},
                     {"arm.visible", "true"},
                     {"arm.opacity", "0.5"},
                     {"base.visible", "false"},
                     {"base.opacity", "1"}};
  SettingTexts heard;
};

TEST_F(SettingRowsTest, ThingsThatComeManyTimesAreRowsBeneathOne) {
  ASSERT_EQ(layer->childCount(), 2);
  QTreeWidgetItem* const links = rows.row("Links", "");
  ASSERT_NE(links, nullptr);
  EXPECT_EQ(links->text(0), QStringLiteral("Links (2)"));
  EXPECT_EQ(links->checkState(0), Qt::PartiallyChecked);
  EXPECT_EQ(rows.row("Links", "arm")->checkState(0), Qt::Checked);
  EXPECT_EQ(rows.row("Links", "base")->checkState(0), Qt::Unchecked);
  EXPECT_EQ(rows.editor("arm.opacity"), tree.itemWidget(rows.row("Links", "arm"), 1));
  EXPECT_EQ(rows.row("Links", "wheel"), nullptr);
}

TEST_F(SettingRowsTest, ACheckBoxSwitchesOneAndTheGroupsSwitchesAll) {
  rows.row("Links", "base")->setCheckState(0, Qt::Checked);
  EXPECT_EQ(heard, (SettingTexts{{"base.visible", "true"}}));
  rows.row("Links", "")->setCheckState(0, Qt::Unchecked);
  EXPECT_EQ(heard, (SettingTexts{{"arm.visible", "false"}, {"base.visible", "false"}}));
}

TEST_F(SettingRowsTest, RowsStayAsLongAsTheSpecsDo) {
  const QTreeWidgetItem* const arm = rows.row("Links", "arm");
  rows.row("Links", "")->setExpanded(true);
  texts["arm.visible"] = "false";
  rows.show(specs, texts);
  EXPECT_EQ(rows.row("Links", "arm"), arm);
  EXPECT_EQ(arm->checkState(0), Qt::Unchecked);
  EXPECT_TRUE(heard.empty()) << "showing reports nothing";
  specs.pop_back();
  specs.pop_back();
  rows.show(specs, texts);
  EXPECT_EQ(rows.row("Links", "")->childCount(), 1);
  EXPECT_TRUE(rows.row("Links", "")->isExpanded()) << "what was open stays open";
  SettingRows anew{tree, *layer};
  anew.setOpenGroups(rows.openGroups());
  anew.show(specs, texts);
  EXPECT_TRUE(anew.row("Links", "")->isExpanded()) << "in rows made anew, too";
}

}  // namespace
}  // namespace stillframe::viewer
