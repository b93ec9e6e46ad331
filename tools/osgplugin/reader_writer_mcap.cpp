#include <map>
#include <osg/CopyOp>
#include <osg/Notify>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

#include "scenegraph/export/osgt_export.h"
#include "tools/cli/scene_session.h"
#include "tools/osgplugin/option_string.h"

namespace stillframe::osgplugin {

/// Copies nodes and drawables, and the state sets that they share, each once: the layers empty theirs when they end.
class SceneCopy final : public osg::CopyOp {
 public:
  SceneCopy() : osg::CopyOp(DEEP_COPY_NODES | DEEP_COPY_DRAWABLES | DEEP_COPY_ARRAYS | DEEP_COPY_PRIMITIVES) {}
  using osg::CopyOp::operator();
  osg::StateSet* operator()(const osg::StateSet* state) const override {
    if (state == nullptr) {
      return nullptr;
    }
    osg::ref_ptr<osg::StateSet>& copy = copies_[state];
    if (!copy.valid()) {
      copy = new osg::StateSet(*state, osg::CopyOp(DEEP_COPY_UNIFORMS));
    }
    return copy.get();
  }

 private:
  mutable std::map<const osg::StateSet*, osg::ref_ptr<osg::StateSet>> copies_;
};

/// Reads one instant of a recording as the scene that `stillframe export` would write: stock classes only.
class ReaderWriterMcap final : public osgDB::ReaderWriter {
 public:
  ReaderWriterMcap() {
    supportsExtension("mcap", "Recordings of robots");
    supportsOption("time=T", "Nanoseconds, +SECONDS from the start, start, or end (default)");
    supportsOption("fixed_frame=F", "Frame that stands still; default: map, world, odom, ...");
    supportsOption("layers=L;L", "Draw just these layers, each TOPIC[:key=value,...]");
    supportsOption("layer=L", "Settings of one layer; may be repeated");
    supportsOption("tf_time=auto|header|log", "Clock of the transforms");
    supportsOption("static_always", "Static transforms hold for all time");
    supportsOption("package_path=FOLDER", "Where meshes of robots are looked for; may be repeated");
    supportsOption("robot=FILE", "A URDF file to show with the recording; may be repeated");
    supportsOption("height=PIXELS", "Height of the window, for points whose size is in metres");
  }

  const char* className() const override { return "MCAP recordings"; }

  ReadResult readObject(const std::string& name, const osgDB::Options* options) const override {
    return readNode(name, options);
  }

  ReadResult readNode(const std::string& name, const osgDB::Options* options) const override {
    if (!acceptsExtension(osgDB::getLowerCaseFileExtension(name))) {
      return ReadResult::FILE_NOT_HANDLED;
    }
    const std::string file = osgDB::findDataFile(name, options);
    if (file.empty()) {
      return ReadResult::FILE_NOT_FOUND;
    }
    auto parsed = parseOptionString(options != nullptr ? options->getOptionString() : std::string());
    if (!parsed) {
      return fail(parsed.error());
    }
    for (const std::string& word : parsed->unknown) {
      OSG_NOTICE << "osgdb_mcap: option '" << word << "' means nothing here" << std::endl;
    }
    parsed->view.recording.file = file;
    auto session = cli::SceneSession::make(parsed->view);
    if (!session) {
      return fail(session.error());
    }
    // The layers end with the session: the graph that is handed out has its own.
    const auto graph = scenegraph::makeExportGraph((*session)->scene().root(), (*session)->exportInfo());
    return static_cast<osg::Node*>(graph->clone(SceneCopy()));
  }

 private:
  static ReadResult fail(const cli::CliError& error) {
    OSG_WARN << "osgdb_mcap: " << cli::printable(error.message) << std::endl;
    return ReadResult(error.message);
  }
};

}  // namespace stillframe::osgplugin

using stillframe::osgplugin::ReaderWriterMcap;
REGISTER_OSGPLUGIN(mcap, ReaderWriterMcap)
