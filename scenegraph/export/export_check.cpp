#include "scenegraph/export/export_check.h"

#include <cmath>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Texture>
#include <osg/TextureBuffer>
#include <osg/UserDataContainer>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>
#include <string>
#include <typeinfo>
#include <unordered_set>

namespace stillframe::scenegraph {
namespace {

template <typename T>
bool allFinite(const T* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) {
      return false;
    }
  }
  return true;
}

bool isFinite(const osg::Array& array) {
  const std::size_t count = static_cast<std::size_t>(array.getNumElements()) * array.getDataSize();
  switch (array.getDataType()) {
    case GL_FLOAT:
      return allFinite(static_cast<const float*>(array.getDataPointer()), count);
    case GL_DOUBLE:
      return allFinite(static_cast<const double*>(array.getDataPointer()), count);
    default:
      return true;
  }
}

/// Walks the objects in the order they would be written and keeps the first failure.
class Checker {
 public:
  void node(const osg::Node* node);
  [[nodiscard]] std::expected<void, Status> result() const {
    return failed_ ? std::expected<void, Status>(std::unexpected(status_)) : std::expected<void, Status>();
  }

 private:
  /// False when the object needs no further look: absent, seen before, or a failure.
  bool enter(const osg::Object* object);
  void fail(const char* code, const osg::Object& object, const std::string& reason);
  void array(const osg::Array* array, const char* role);
  void geometry(const osg::Geometry& geometry);
  void stateSet(const osg::StateSet* state);
  void attribute(const osg::StateAttribute* attribute);
  void uniform(const osg::Uniform* uniform);
  void userData(const osg::Object& object);

  std::unordered_set<const osg::Object*> seen_;
  std::string place_;  // name of the innermost named node, for messages
  Status status_;
  bool failed_ = false;
};

void Checker::fail(const char* code, const osg::Object& object, const std::string& reason) {
  if (failed_) {
    return;
  }
  failed_ = true;
  const std::string name = object.getName().empty() ? "" : " '" + object.getName() + "'";
  const std::string place = place_.empty() ? "" : " beneath '" + place_ + "'";
  status_ = {StatusLevel::Error, code,
             std::string(object.libraryName()) + "::" + object.className() + name + place + " " + reason};
}

bool Checker::enter(const osg::Object* object) {
  if (failed_ || object == nullptr || !seen_.insert(object).second) {
    return false;
  }
  const std::string library = object->libraryName();
  osgDB::ObjectWrapper* wrapper =
      library.starts_with("osg")
          ? osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(library + "::" + object->className())
          : nullptr;
  if (wrapper == nullptr) {
    fail("NotExportable", *object, "cannot be written: stock OpenSceneGraph has no such class");
    return false;
  }
  // A subclass without a name of its own would be written as its base and lose what it adds.
  const osg::ref_ptr<osg::Object> stock = wrapper->createInstance();
  if (stock.valid() && typeid(*stock) != typeid(*object)) {
    fail("NotExportable", *object, std::string("cannot be written: it is really a ") + typeid(*object).name());
    return false;
  }
  userData(*object);
  return !failed_;
}

void Checker::userData(const osg::Object& object) {
  const osg::UserDataContainer* container = object.getUserDataContainer();
  if (container == nullptr) {
    return;
  }
  for (unsigned i = 0; i < container->getNumUserObjects(); ++i) {
    enter(container->getUserObject(i));
  }
}

void Checker::array(const osg::Array* array, const char* role) {
  if (enter(array) && !isFinite(*array)) {
    fail("NotFinite", *array, std::string("(") + role + ") holds NaN or infinity");
  }
}

void Checker::uniform(const osg::Uniform* uniform) {
  if (!enter(uniform)) {
    return;
  }
  enter(uniform->getUpdateCallback());
  enter(uniform->getEventCallback());
  const osg::FloatArray* floats = uniform->getFloatArray();
  const osg::DoubleArray* doubles = uniform->getDoubleArray();
  if ((floats != nullptr && !isFinite(*floats)) || (doubles != nullptr && !isFinite(*doubles))) {
    fail("NotFinite", *uniform, "holds NaN or infinity");
  }
}

void Checker::attribute(const osg::StateAttribute* attribute) {
  if (!enter(attribute)) {
    return;
  }
  enter(attribute->getUpdateCallback());
  enter(attribute->getEventCallback());
  if (const auto* program = dynamic_cast<const osg::Program*>(attribute)) {
    for (unsigned i = 0; i < program->getNumShaders(); ++i) {
      enter(program->getShader(i));
    }
  }
  if (const auto* buffer = dynamic_cast<const osg::TextureBuffer*>(attribute)) {
    if (buffer->getImage() != nullptr) {
      fail("NotExportable", *buffer, "keeps its texels in an Image, which OSG 3.6 loses on the way");
    }
    array(dynamic_cast<const osg::Array*>(buffer->getBufferData()), "texels");
  } else if (const auto* texture = dynamic_cast<const osg::Texture*>(attribute)) {
    for (unsigned i = 0; i < texture->getNumImages(); ++i) {
      enter(texture->getImage(i));
    }
  }
}

void Checker::stateSet(const osg::StateSet* state) {
  if (!enter(state)) {
    return;
  }
  enter(state->getUpdateCallback());
  enter(state->getEventCallback());
  for (const auto& [key, value] : state->getAttributeList()) {
    attribute(value.first);
  }
  for (const auto& unit : state->getTextureAttributeList()) {
    for (const auto& [key, value] : unit) {
      attribute(value.first);
    }
  }
  for (const auto& [name, value] : state->getUniformList()) {
    uniform(value.first);
  }
}

void Checker::geometry(const osg::Geometry& geometry) {
  array(geometry.getVertexArray(), "vertices");
  array(geometry.getNormalArray(), "normals");
  array(geometry.getColorArray(), "colours");
  array(geometry.getSecondaryColorArray(), "secondary colours");
  array(geometry.getFogCoordArray(), "fog coordinates");
  for (const auto& coordinates : geometry.getTexCoordArrayList()) {
    array(coordinates, "texture coordinates");
  }
  for (const auto& attributes : geometry.getVertexAttribArrayList()) {
    array(attributes, "vertex attributes");
  }
  for (const auto& primitives : geometry.getPrimitiveSetList()) {
    enter(primitives);
  }
}

void Checker::node(const osg::Node* node) {
  if (!enter(node)) {
    return;
  }
  const std::string outer = place_;
  if (!node->getName().empty()) {
    place_ = node->getName();
  }
  enter(node->getUpdateCallback());
  enter(node->getEventCallback());
  enter(node->getCullCallback());
  enter(node->getComputeBoundingSphereCallback());
  stateSet(node->getStateSet());
  if (const auto* transform = dynamic_cast<const osg::MatrixTransform*>(node)) {
    if (!allFinite(transform->getMatrix().ptr(), 16)) {
      fail("NotFinite", *transform, "has a matrix with NaN or infinity");
    }
  }
  if (const auto* drawable = node->asDrawable()) {
    enter(drawable->getDrawCallback());
    enter(drawable->getComputeBoundingBoxCallback());
    enter(drawable->getShape());
  }
  if (const auto* geometry_node = node->asGeometry()) {
    geometry(*geometry_node);
  }
  if (const auto* group = node->asGroup()) {
    for (unsigned i = 0; i < group->getNumChildren(); ++i) {
      if (group->getChild(i)->getNodeMask() != 0U) {
        this->node(group->getChild(i));
      }
    }
  }
  place_ = outer;
}

}  // namespace

std::expected<void, Status> checkExportable(const osg::Node& root) {
  Checker checker;
  checker.node(&root);
  return checker.result();
}

}  // namespace stillframe::scenegraph
