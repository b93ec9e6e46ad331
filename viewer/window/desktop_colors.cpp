#include "viewer/window/desktop_colors.h"

#include <QDBusConnection>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>
#include <QDBusVariant>
#include <QFileInfo>
#include <QStandardPaths>

namespace stillframe::viewer {
namespace {

const QString kService = QStringLiteral("org.freedesktop.portal.Desktop");
const QString kPath = QStringLiteral("/org/freedesktop/portal/desktop");
const QString kInterface = QStringLiteral("org.freedesktop.portal.Settings");
const QString kSpace = QStringLiteral("org.freedesktop.appearance");
const QString kKey = QStringLiteral("color-scheme");

/// Whether there is a bus to ask: without one the D-Bus library would start a daemon.
bool hasSessionBus() {
  return !qEnvironmentVariableIsEmpty("DBUS_SESSION_BUS_ADDRESS") ||
         (!qEnvironmentVariableIsEmpty("XDG_RUNTIME_DIR") &&
          QFileInfo::exists(qEnvironmentVariable("XDG_RUNTIME_DIR") + QStringLiteral("/bus")));
}

}  // namespace

DesktopColors::DesktopColors(QObject* parent) : QObject(parent) {
  if (!hasSessionBus()) {
    return;
  }
  QDBusConnection bus = QDBusConnection::sessionBus();
  if (!bus.isConnected()) {
    return;
  }
  bus.connect(kService, kPath, kInterface, QStringLiteral("SettingChanged"), this,
              SLOT(takeChange(QString, QString, QDBusVariant)));
  QDBusMessage question = QDBusMessage::createMethodCall(kService, kPath, kInterface, QStringLiteral("Read"));
  question << kSpace << kKey;
  auto* const answer = new QDBusPendingCallWatcher(bus.asyncCall(question), this);
  connect(answer, &QDBusPendingCallWatcher::finished, this, [this, answer] {
    if (const QDBusMessage reply = answer->reply();
        reply.type() == QDBusMessage::ReplyMessage && !reply.arguments().isEmpty()) {
      take(reply.arguments().constFirst());
    }
    answer->deleteLater();
  });
}

std::optional<bool> DesktopColors::prefersDark(const QVariant& value) {
  QVariant inner = value;
  for (int depth = 0; depth < 2 && inner.canConvert<QDBusVariant>(); ++depth) {
    inner = inner.value<QDBusVariant>().variant();
  }
  bool is_number = false;
  const unsigned scheme = inner.toUInt(&is_number);
  return is_number && (scheme == 1 || scheme == 2) ? std::optional(scheme == 1) : std::nullopt;
}

void DesktopColors::takeChange(const QString& space, const QString& key, const QDBusVariant& value) {
  if (space == kSpace && key == kKey) {
    take(value.variant());
  }
}

void DesktopColors::take(const QVariant& value) {
  const auto wish = prefersDark(value);
  if (wish != prefers_dark_) {
    prefers_dark_ = wish;
    Q_EMIT changed();
  }
}

}  // namespace stillframe::viewer
