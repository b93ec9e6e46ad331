#include "viewer/layers/range_editor.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/layers/number_box.h"
#include "viewer/layers/range_strip.h"
#include "viewer/layers/setting_editor.h"

namespace stillframe::viewer {
namespace {

constexpr std::array<const char*, 5> kKeys = {"range_mode", "range_min", "range_max", "percentile_low",
                                              "percentile_high"};

double numberOf(const scenegraph::SettingTexts& texts, const char* key) {
  const auto found = texts.find(key);
  return found == texts.end() ? 0.0 : QString::fromStdString(found->second).toDouble();
}

}  // namespace

bool RangeEditor::covers(const std::string& key) { return std::ranges::find(kKeys, key) != kKeys.end(); }

bool RangeEditor::isFor(const std::vector<scenegraph::SettingSpec>& specs) {
  return std::ranges::all_of(kKeys, [&](const char* key) {
    return std::ranges::find(specs, key, &scenegraph::SettingSpec::key) != specs.end();
  });
}

RangeEditor::RangeEditor(const std::vector<scenegraph::SettingSpec>& specs, QWidget* parent)
    : QWidget(parent),
      mode_(new QComboBox(this)),
      low_(new NumberBox(-kLargestNumber, kLargestNumber, this)),
      high_(new NumberBox(-kLargestNumber, kLargestNumber, this)),
      strip_(new RangeStrip(this)) {
  const auto spec = std::ranges::find(specs, "range_mode", &scenegraph::SettingSpec::key);
  for (const std::string& mode : spec->choices) {
    mode_->addItem(QString::fromStdString(mode));
  }
  mode_->setToolTip(QString::fromStdString(spec->help));
  mode_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  low_->setObjectName(QStringLiteral("low"));
  high_->setObjectName(QStringLiteral("high"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 1, 4, 1);
  layout->setSpacing(2);
  layout->addWidget(mode_);
  layout->addWidget(strip_);
  auto* ends = new QHBoxLayout;
  ends->addWidget(low_);
  ends->addWidget(high_);
  layout->addLayout(ends);
  connect(new EditorFilter(*this), &EditorFilter::cancelled, this, [this] {
    for (NumberBox* const box : {low_, high_}) {
      const QSignalBlocker blocker(box);
      box->setValue(box->value());  // writes it over what is half typed
    }
  });
  connect(mode_, &QComboBox::textActivated, this, &RangeEditor::chooseMode);
  // Of percentiles the one that is moved past the other takes that along; a range given may run from high to low.
  connect(low_, &QDoubleSpinBox::valueChanged, this,
          [this](double low) { setEnds(low, isPercentile() ? std::max(low, high_->value()) : high_->value()); });
  connect(high_, &QDoubleSpinBox::valueChanged, this,
          [this](double high) { setEnds(isPercentile() ? std::min(low_->value(), high) : low_->value(), high); });
  connect(strip_, &RangeStrip::dragged, this, [this](double low, double high) {
    Q_EMIT edited({{"range_mode", "manual"},
                   {"range_min", scenegraph::settingText(low)},
                   {"range_max", scenegraph::settingText(high)}});
  });
}

bool RangeEditor::isPercentile() const {
  const auto mode = texts_.find("range_mode");
  return mode != texts_.end() && mode->second == "percentile";
}

/// From the range in use: the colours stay until an end is changed.
void RangeEditor::chooseMode(const QString& mode) {
  scenegraph::SettingTexts chosen{{"range_mode", mode.toStdString()}};
  if (mode == QLatin1String("manual") && legend_) {
    chosen["range_min"] = scenegraph::settingText(legend_->low);
    chosen["range_max"] = scenegraph::settingText(legend_->high);
  }
  Q_EMIT edited(chosen);
}

void RangeEditor::setEnds(double low, double high) {
  const bool is_percentile = isPercentile();
  Q_EMIT edited({{is_percentile ? "percentile_low" : "range_min", scenegraph::settingText(low)},
                 {is_percentile ? "percentile_high" : "range_max", scenegraph::settingText(high)}});
}

void RangeEditor::setTexts(const scenegraph::SettingTexts& texts) {
  texts_.clear();
  for (const char* key : kKeys) {
    if (const auto found = texts.find(key); found != texts.end()) {
      texts_[key] = found->second;
    }
  }
  const QSignalBlocker blocker(mode_);
  mode_->setCurrentText(QString::fromStdString(texts_["range_mode"]));
  showEnds();
}

void RangeEditor::setLegend(const std::optional<scenegraph::ColorLegend>& legend) {
  legend_ = legend;
  strip_->setLegend(legend);
  showEnds();
}

void RangeEditor::setHistogram(const scenegraph::ValueHistogram& histogram) { strip_->setHistogram(histogram); }

void RangeEditor::showEnds() {
  const std::string& mode = texts_["range_mode"];
  const bool is_percentile = mode == "percentile";
  const bool is_auto = mode == "auto";
  const QSignalBlocker low_blocker(low_);
  const QSignalBlocker high_blocker(high_);
  for (NumberBox* box : {low_, high_}) {
    box->setEnabled(!is_auto);
    box->setRange(is_percentile ? 0.0 : -kLargestNumber, is_percentile ? 100.0 : kLargestNumber);
    box->setSuffix(is_percentile ? QStringLiteral(" %") : QString());
  }
  const auto show = [](NumberBox& box, double value) {
    if (std::isfinite(value) && box.value() != value) {  // else what is being typed would go
      box.setValue(value);
    }
  };
  if (is_auto) {
    show(*low_, legend_ ? legend_->low : 0.0);
    show(*high_, legend_ ? legend_->high : 0.0);
  } else {
    show(*low_, numberOf(texts_, is_percentile ? "percentile_low" : "range_min"));
    show(*high_, numberOf(texts_, is_percentile ? "percentile_high" : "range_max"));
  }
  low_->setToolTip(is_percentile ? tr("Share of the values below the first colour") : tr("Value of the first colour"));
  high_->setToolTip(is_percentile ? tr("Share of the values below the last colour") : tr("Value of the last colour"));
}

}  // namespace stillframe::viewer
