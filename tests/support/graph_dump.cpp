#include "tests/support/graph_dump.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <osg/BufferObject>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osg/Switch>
#include <osgDB/ObjectWrapper>
#include <osgDB/Options>
#include <osgDB/Registry>
#include <span>
#include <sstream>
#include <vector>

namespace stillframe::test {
namespace {

std::uint64_t hashOf(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const std::byte byte : bytes) {
    hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3U;
  }
  return hash;
}

/// "type x count #hash" of the bytes behind an array or the like.
std::string summary(const osg::BufferData& data) {
  std::ostringstream text;
  text << data.className() << " " << data.getTotalDataSize() << " bytes #" << std::hex
       << hashOf({static_cast<const std::byte*>(data.getDataPointer()), data.getTotalDataSize()});
  return text.str();
}

osg::ref_ptr<osgDB::Options> exact(GraphFile file) {
  osg::ref_ptr<osgDB::Options> options = new osgDB::Options("precision 17");
  // A stream has no extension to tell.
  options->setPluginStringData("fileType", file == GraphFile::Text ? "Ascii" : "Binary");
  return options;
}

/// The object as OSG's own text, without what differs between equal objects.
std::string osgText(const osg::Object& object) {
  auto* const writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgt");
  std::ostringstream text;
  if (writer == nullptr || !writer->writeObject(object, text, exact(GraphFile::Text)).success()) {
    return std::string("not writable: ") + object.className();
  }
  return text.str();
}

class Dump : public osg::NodeVisitor {
 public:
  Dump() : NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) { out_ << std::setprecision(17); }

  void apply(osg::Node& node) override {
    if (node.getNodeMask() == 0U) {
      return;
    }
    indent() << node.className() << " '" << node.getName() << "' mask " << node.getNodeMask() << "\n";
    ++depth_;
    for (const std::string& description : node.getDescriptions()) {
      indent() << "description " << description << "\n";
    }
    if (node.getStateSet() != nullptr) {
      state(*node.getStateSet());
    }
    for (const osg::Callback* callback : {node.getUpdateCallback(), node.getCullCallback(), node.getEventCallback()}) {
      if (callback != nullptr) {
        indent() << "callback " << callback->libraryName() << "::" << callback->className() << "\n";
      }
    }
    children(node);
    --depth_;
  }
  void apply(osg::Transform& node) override {
    osg::Matrixd local;
    node.computeLocalToWorldMatrix(local, nullptr);
    pending_ = "matrix";
    for (int i = 0; i < 16; ++i) {
      std::ostringstream number;
      number << std::setprecision(17) << local.ptr()[i];
      pending_ += " " + number.str();
    }
    apply(static_cast<osg::Node&>(node));
  }
  void apply(osg::Geometry& geometry) override {
    if (geometry.getNodeMask() == 0U) {
      return;
    }
    apply(static_cast<osg::Node&>(geometry));
    ++depth_;
    osg::Geometry::ArrayList arrays;
    geometry.getArrayList(arrays);
    for (const auto& array : arrays) {
      indent() << "array " << summary(*array) << " binding " << array->getBinding() << " normalize "
               << array->getNormalize() << "\n";
    }
    for (const auto& primitives : geometry.getPrimitiveSetList()) {
      indent() << "primitives " << primitives->className() << " mode " << primitives->getMode() << " instances "
               << primitives->getNumInstances() << " indices";
      for (unsigned i = 0; i < std::min(primitives->getNumIndices(), 1024U); ++i) {
        out_ << " " << primitives->index(i);
      }
      out_ << " of " << primitives->getNumIndices() << "\n";
    }
    --depth_;
  }
  void apply(osg::Drawable& drawable) override {
    if (drawable.getNodeMask() == 0U) {
      return;
    }
    apply(static_cast<osg::Node&>(drawable));
    indent() << osgText(drawable) << "\n";
  }
  [[nodiscard]] std::string text() const { return out_.str(); }

 private:
  std::ostream& indent() { return out_ << std::string(2 * depth_, ' '); }

  void children(osg::Node& node) {
    if (!pending_.empty()) {
      indent() << std::exchange(pending_, {}) << "\n";
    }
    osg::Group* const group = node.asGroup();
    if (group == nullptr) {
      return;
    }
    std::vector<osg::Node*> ordered;
    for (unsigned i = 0; i < group->getNumChildren(); ++i) {
      const osg::Switch* const chooser = group->asSwitch();
      if (chooser == nullptr || chooser->getValue(i)) {
        ordered.push_back(group->getChild(i));
      }
    }
    for (osg::Node* const child : ordered) {
      child->accept(*this);
    }
  }
  void state(const osg::StateSet& set) {
    indent() << "state bin " << set.getRenderBinMode() << " " << set.getBinNumber() << " " << set.getBinName()
             << " hint " << set.getRenderingHint() << "\n";
    ++depth_;
    for (const auto& [mode, value] : set.getModeList()) {
      indent() << "mode " << mode << " " << value << "\n";
    }
    attributes(set.getAttributeList());
    for (const auto& unit : set.getTextureAttributeList()) {
      attributes(unit);
    }
    for (const auto& [name, uniform] : set.getUniformList()) {
      indent() << "uniform " << name << " type " << uniform.first->getType() << " x" << uniform.first->getNumElements();
      for (const osg::Array* array : {static_cast<const osg::Array*>(uniform.first->getFloatArray()),
                                      static_cast<const osg::Array*>(uniform.first->getDoubleArray()),
                                      static_cast<const osg::Array*>(uniform.first->getIntArray()),
                                      static_cast<const osg::Array*>(uniform.first->getUIntArray())}) {
        if (array != nullptr) {
          out_ << " " << summary(*array);
        }
      }
      out_ << "\n";
    }
    for (const auto& [name, define] : set.getDefineList()) {
      indent() << "define " << name << " " << define.first << "\n";
    }
    --depth_;
  }
  void attributes(const osg::StateSet::AttributeList& list) {
    for (const auto& [key, attribute] : list) {
      indent() << "attribute " << attribute.second << " " << osgText(*attribute.first) << "\n";
    }
  }

  std::ostringstream out_;
  std::size_t depth_ = 0;
  std::string pending_;  // the matrix line of the transform being applied
};

class ForeignClasses : public osg::NodeVisitor {
 public:
  ForeignClasses() : NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }
  void apply(osg::Node& node) override {
    check(node);
    traverse(node);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void check(const osg::Object& object) {
    const std::string name = std::string(object.libraryName()) + "::" + object.className();
    if ((!name.starts_with("osg::") && !name.starts_with("osgText::")) ||
        osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(name) == nullptr) {
      text_ += name + "\n";
    }
  }
  std::string text_;
};

}  // namespace

std::string dumpGraph(osg::Node& root) {
  Dump dump;
  root.accept(dump);
  return dump.text();
}

osg::ref_ptr<osg::Node> writtenAndRead(const osg::Node& root, GraphFile file) {
  auto* const plugin = osgDB::Registry::instance()->getReaderWriterForExtension("osgt");
  std::stringstream stream;
  if (plugin == nullptr || !plugin->writeNode(root, stream, exact(file)).success()) {
    return nullptr;
  }
  return plugin->readNode(stream, exact(file)).getNode();
}

std::string firstRealDifference(const std::string& one, const std::string& other) {
  std::istringstream words(one);
  std::istringstream other_words(other);
  std::string word;
  std::string other_word;
  while (words >> word) {
    if (!(other_words >> other_word)) {
      return word + " against the end";
    }
    if (word == other_word) {
      continue;
    }
    double value = 0.0;
    double other_value = 0.0;
    const bool are_numbers =
        std::from_chars(word.data(), word.data() + word.size(), value).ptr == word.data() + word.size() &&
        std::from_chars(other_word.data(), other_word.data() + other_word.size(), other_value).ptr ==
            other_word.data() + other_word.size();
    if (!are_numbers || std::abs(value - other_value) > 2e-15 * std::abs(value)) {
      return word + " against " + other_word;
    }
  }
  return other_words >> other_word ? "the end against " + other_word : "";
}

std::string foreignClasses(osg::Node& root) {
  ForeignClasses visitor;
  root.accept(visitor);
  return visitor.text();
}

}  // namespace stillframe::test
