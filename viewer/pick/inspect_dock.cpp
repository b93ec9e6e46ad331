#include "viewer/pick/inspect_dock.h"

#include <QMainWindow>
#include <utility>

#include "viewer/pick/inspect_panel.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {

InspectDock::InspectDock(QMainWindow& window) : QDockWidget(tr("Inspect"), &window), panel_(new InspectPanel(this)) {
  setObjectName(QStringLiteral("inspectDock"));
  setWidget(panel_);
  window.addDockWidget(Qt::RightDockWidgetArea, this);
  hide();
}

void InspectDock::watch(SceneWidget& view) {
  connect(&view.picks(), &ViewPicks::picked, this, [this, &view] {
    setView(view);
    if (!std::exchange(has_been_shown_, true) && isHidden()) {
      show();
      auto& window = *qobject_cast<QMainWindow*>(parentWidget());
      window.resizeDocks({this}, {window.height() / 2}, Qt::Vertical);
    }
    show();
  });
}

void InspectDock::setView(SceneWidget& view) { panel_->setView(&view); }

}  // namespace stillframe::viewer
