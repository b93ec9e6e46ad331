#include "viewer/window/theme.h"

#include <QActionGroup>
#include <QApplication>
#include <QMenu>
#include <QPalette>
#include <QSettings>
#include <QToolTip>
#include <array>
#include <utility>

#include "viewer/window/desktop_colors.h"

namespace stillframe::viewer {
namespace {

constexpr std::array<std::pair<Theme, std::string_view>, 3> kNames{
    {{Theme::System, "system"}, {Theme::Light, "light"}, {Theme::Dark, "dark"}}};
const QString kSettings = QStringLiteral("Stillframe");
const QString kKey = QStringLiteral("theme");

QPalette darkPalette() {
  QPalette colors(QColor(0x45, 0x49, 0x50), QColor(0x3e, 0x42, 0x48));
  const QColor text(0xe6, 0xe6, 0xe6);
  const QColor dimmed(0x9a, 0x9d, 0xa2);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
    colors.setColor(role, text);
    colors.setColor(QPalette::Disabled, role, dimmed);
  }
  colors.setColor(QPalette::PlaceholderText, dimmed);
  colors.setColor(QPalette::BrightText, Qt::white);
  colors.setColor(QPalette::Base, QColor(0x19, 0x1b, 0x1e));
  colors.setColor(QPalette::AlternateBase, QColor(0x20, 0x23, 0x27));
  colors.setColor(QPalette::ToolTipBase, QColor(0x2a, 0x2d, 0x31));
  colors.setColor(QPalette::Highlight, QColor(0x2f, 0x6f, 0xb5));
  colors.setColor(QPalette::HighlightedText, Qt::white);
  colors.setColor(QPalette::Disabled, QPalette::Highlight, QColor(0x50, 0x54, 0x5a));
  colors.setColor(QPalette::Link, QColor(0x6f, 0xb3, 0xff));
  return colors;
}

QPalette lightPalette() {
  QPalette colors(QColor(0xef, 0xef, 0xef), QColor(0xef, 0xef, 0xef));
  const QColor dimmed(0x80, 0x80, 0x80);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
    colors.setColor(role, QColor(0x1a, 0x1a, 0x1a));
    colors.setColor(QPalette::Disabled, role, dimmed);
  }
  colors.setColor(QPalette::PlaceholderText, dimmed);
  colors.setColor(QPalette::Base, Qt::white);
  colors.setColor(QPalette::AlternateBase, QColor(0xf6, 0xf6, 0xf6));
  colors.setColor(QPalette::ToolTipBase, QColor(0xff, 0xff, 0xdc));
  colors.setColor(QPalette::Highlight, QColor(0x30, 0x8c, 0xc6));
  colors.setColor(QPalette::HighlightedText, Qt::white);
  return colors;
}

/// The application's theme, a child of it.
class ThemeKeeper : public QObject {
 public:
  static ThemeKeeper& get() {
    for (QObject* const child : qApp->children()) {
      if (auto* const keeper = dynamic_cast<ThemeKeeper*>(child)) {
        return *keeper;
      }
    }
    return *new ThemeKeeper;
  }

  void apply(Theme theme) {
    theme_ = theme;
    if (theme_ == Theme::System && desktop_ == nullptr) {
      desktop_ = new DesktopColors(this);
      connect(desktop_, &DesktopColors::changed, this, &ThemeKeeper::show);
    }
    show();
  }
  [[nodiscard]] Theme theme() const noexcept { return theme_; }

 private:
  ThemeKeeper() : QObject(qApp) {}

  void show() {
    const auto wish = theme_ == Theme::System ? desktop_->prefersDark() : std::optional(theme_ == Theme::Dark);
    // Without a wish, the platform's own: that is what an empty palette resolves to.
    const QPalette colors = !wish ? QPalette() : *wish ? darkPalette() : lightPalette();
    QApplication::setPalette(colors);
    QToolTip::setPalette(colors);
  }

  Theme theme_ = Theme::System;
  DesktopColors* desktop_ = nullptr;
};

}  // namespace

std::string_view toString(Theme theme) noexcept {
  for (const auto& [value, name] : kNames) {
    if (value == theme) {
      return name;
    }
  }
  return "system";
}

std::optional<Theme> themeOf(std::string_view text) noexcept {
  for (const auto& [value, name] : kNames) {
    if (name == text) {
      return value;
    }
  }
  return std::nullopt;
}

Theme rememberedTheme() {
  const QString text = QSettings(kSettings, kSettings).value(kKey).toString();
  return themeOf(text.toStdString()).value_or(Theme::System);
}

void rememberTheme(Theme theme) {
  const std::string_view name = toString(theme);
  QSettings(kSettings, kSettings).setValue(kKey, QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())));
}

void applyTheme(Theme theme) { ThemeKeeper::get().apply(theme); }

Theme appliedTheme() noexcept { return ThemeKeeper::get().theme(); }

void addThemeMenu(QMenu& menu) {
  QMenu* const themes = menu.addMenu(QMenu::tr("&Theme"));
  themes->setObjectName(QStringLiteral("themes"));
  auto* const group = new QActionGroup(themes);
  for (const auto& [theme, text] : {std::pair{Theme::System, QMenu::tr("As the &system")},
                                    {Theme::Light, QMenu::tr("&Light")},
                                    {Theme::Dark, QMenu::tr("&Dark")}}) {
    QAction* const action = themes->addAction(text);
    action->setCheckable(true);
    action->setActionGroup(group);
    action->setChecked(appliedTheme() == theme);
    QObject::connect(action, &QAction::triggered, themes, [theme] {
      applyTheme(theme);
      rememberTheme(theme);
    });
  }
}

}  // namespace stillframe::viewer
