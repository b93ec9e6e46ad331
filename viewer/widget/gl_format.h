#pragma once

#include <QLoggingCategory>
#include <QSurfaceFormat>

namespace stillframe::viewer {

/// "stillframe.gl": what OpenGL's debug output and OpenSceneGraph have to say.
Q_DECLARE_LOGGING_CATEGORY(glLog)

/// What every view asks of its context: OpenGL 4.5 compatibility profile with deprecated functions (without that flag
/// Qt quietly gives a core context, in which OpenSceneGraph draws nothing), debug output, no depth buffer of its own
/// (the pipeline brings a 32-bit float one). What the driver gave is checked by scenegraph::inspectCurrentContext().
[[nodiscard]] QSurfaceFormat glFormat();

/// Makes glFormat() the default, shares contexts between windows and sends OpenSceneGraph's warnings to glLog. Call it
/// before the QApplication is made.
void prepareApplication();

}  // namespace stillframe::viewer
