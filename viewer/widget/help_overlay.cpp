#include "viewer/widget/help_overlay.h"

#include <algorithm>

#include "viewer/widget/camera_keys.h"

namespace stillframe::viewer {

HelpOverlay::HelpOverlay(QWidget* parent) : QLabel(parent) {
  setObjectName(QStringLiteral("help"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setTextFormat(Qt::RichText);
  setStyleSheet(
      QStringLiteral("color: #f0f0f0; background: rgba(20, 22, 26, 225); border-radius: 6px; padding: 10px 14px;"));
  QString rows;
  for (const KeyHelp& line : CameraKeys::help()) {
    rows += QStringLiteral("<tr><td style='padding-right: 14px'><b>%1</b></td><td>%2</td></tr>")
                .arg(line.keys.toHtmlEscaped(), line.what.toHtmlEscaped());
  }
  setText(QStringLiteral("<table cellspacing='1'>%1</table>").arg(rows));
  hide();
}

void HelpOverlay::setShown(bool shown) {
  if (shown) {
    place();
    raise();
  }
  setVisible(shown);
}

void HelpOverlay::place() {
  setWordWrap(false);
  QSize size = sizeHint();
  if (size.width() > parentWidget()->width()) {  // a narrow view: what the keys do is told in more lines
    setWordWrap(true);
    size = {parentWidget()->width(), heightForWidth(parentWidget()->width())};
  }
  resize(size);
  move(std::max(0, (parentWidget()->width() - width()) / 2), std::max(0, (parentWidget()->height() - height()) / 2));
}

}  // namespace stillframe::viewer
