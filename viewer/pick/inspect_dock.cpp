#include "viewer/pick/inspect_dock.h"

#include <QMainWindow>

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
  connect(&view.picks(), &ViewPicks::changed, this, [this, &view] {
    if (view.picks().selected()) {
      setView(view);
      show();
    }
  });
}

void InspectDock::setView(SceneWidget& view) { panel_->setView(&view); }

}  // namespace stillframe::viewer
