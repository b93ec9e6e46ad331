#pragma once

#include <QString>
#include <QWidget>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/color_legend.h"
#include "scenegraph/settings.h"

class QComboBox;

namespace stillframe::viewer {

class NumberBox;
class RangeStrip;

/// The range that values are coloured over, in one widget: how it is found, its two ends or percentiles, and a strip
/// with the colours, the histogram of the values and two handles. For layers whose settings are those of
/// nodes::ValueColoring, which it knows by their keys. GUI thread.
class RangeEditor : public QWidget {
  Q_OBJECT

 public:
  explicit RangeEditor(const std::vector<scenegraph::SettingSpec>& specs, QWidget* parent = nullptr);

  /// Whether these settings have a range; `covers` says which of them it edits.
  [[nodiscard]] static bool isFor(const std::vector<scenegraph::SettingSpec>& specs);
  [[nodiscard]] static bool covers(const std::string& key);

  /// Shows the settings without telling anybody.
  void setTexts(const scenegraph::SettingTexts& texts);
  /// The range in use and its colours; nullopt while nothing is coloured by value.
  void setLegend(const std::optional<scenegraph::ColorLegend>& legend);
  void setHistogram(const scenegraph::ValueHistogram& histogram);
  [[nodiscard]] RangeStrip& strip() noexcept { return *strip_; }

 Q_SIGNALS:
  /// The user has chosen these.
  void edited(const stillframe::scenegraph::SettingTexts& texts);

 private:
  void chooseMode(const QString& mode);
  [[nodiscard]] bool isPercentile() const;
  void setEnds(double low, double high);
  void showEnds();

  scenegraph::SettingTexts texts_;
  std::optional<scenegraph::ColorLegend> legend_;
  QComboBox* mode_ = nullptr;
  NumberBox* low_ = nullptr;
  NumberBox* high_ = nullptr;
  RangeStrip* strip_ = nullptr;
};

}  // namespace stillframe::viewer
