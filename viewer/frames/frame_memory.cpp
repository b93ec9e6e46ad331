#include "viewer/frames/frame_memory.h"

#include <QSettings>
#include <QString>
#include <QUrl>

namespace stillframe::viewer {
namespace {

const QString kName = QStringLiteral("Stillframe");  // of organisation and program

/// A name may hold slashes, which would nest groups.
QString keyOf(const std::string& source) {
  return QStringLiteral("fixed_frames/") +
         QString::fromLatin1(QUrl::toPercentEncoding(QString::fromStdString(source), {}, "/\\"));
}

}  // namespace

std::optional<std::string> FrameMemory::recall(const std::string& source) const {
  if (source.empty()) {
    return unnamed_;
  }
  const QString frame = QSettings(kName, kName).value(keyOf(source)).toString();
  return frame.isEmpty() ? std::nullopt : std::optional(frame.toStdString());
}

void FrameMemory::remember(const std::string& source, const std::optional<std::string>& frame) {
  if (source.empty()) {
    unnamed_ = frame;
    return;
  }
  QSettings kept(kName, kName);
  if (frame) {
    kept.setValue(keyOf(source), QString::fromStdString(*frame));
  } else {
    kept.remove(keyOf(source));
  }
}

}  // namespace stillframe::viewer
