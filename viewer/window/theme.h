#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

class QMenu;

namespace stillframe::viewer {

/// Colours of the window. System: those of the desktop, dark where it prefers dark.
enum class Theme : std::uint8_t { System, Light, Dark };

/// "system", "light", "dark".
[[nodiscard]] std::string_view toString(Theme theme) noexcept;
[[nodiscard]] std::optional<Theme> themeOf(std::string_view text) noexcept;

/// The one chosen last on this machine (QSettings); System at first.
[[nodiscard]] Theme rememberedTheme();
void rememberTheme(Theme theme);

/// Gives the application its colours, at once and in every window; the 3D views keep theirs. System follows the
/// desktop from then on: it asks the desktop's settings portal, and goes by the platform where there is none. GUI
/// thread, after the application is made.
void applyTheme(Theme theme);
/// What applyTheme() was given last.
[[nodiscard]] Theme appliedTheme() noexcept;

/// A submenu to switch with, which remembers.
void addThemeMenu(QMenu& menu);

}  // namespace stillframe::viewer
