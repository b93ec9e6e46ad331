#pragma once

#include <QDBusVariant>
#include <QObject>
#include <QVariant>
#include <optional>

namespace stillframe::viewer {

/// Whether the desktop prefers dark colours, by its settings portal (org.freedesktop.appearance, color-scheme): what
/// GNOME, KDE and others share. Asks without waiting and listens from then on; without a session bus or a portal
/// nothing is known. GUI thread.
class DesktopColors : public QObject {
  Q_OBJECT

 public:
  explicit DesktopColors(QObject* parent = nullptr);

  /// nullopt: not known, or no preference.
  [[nodiscard]] std::optional<bool> prefersDark() const noexcept { return prefers_dark_; }
  /// What the portal's value says: 1 is dark, 2 light; it comes in one variant or two.
  [[nodiscard]] static std::optional<bool> prefersDark(const QVariant& value);

 Q_SIGNALS:
  void changed();

 private Q_SLOTS:
  void takeChange(const QString& space, const QString& key, const QDBusVariant& value);

 private:
  void take(const QVariant& value);

  std::optional<bool> prefers_dark_;
};

}  // namespace stillframe::viewer
