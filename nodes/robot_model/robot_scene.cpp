#include "nodes/robot_model/robot_scene.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "nodes/images/jpeg_reader.h"
#include "nodes/images/png_reader.h"
#include "nodes/osg_math.h"
#include "nodes/robots/urdf_reader.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Status;

constexpr double kLeastPlaceholder = 0.02;  // m, an edge
constexpr double kLonePlaceholder = 0.1;    // m, an edge, where nothing tells a size
constexpr std::size_t kMaxRemarks = 500;

osg::BoundingBoxd turned(const osg::BoundingBoxd& box, const osg::Matrixd& target_from_box) {
  osg::BoundingBoxd result;
  for (unsigned corner = 0; box.valid() && corner < 8; ++corner) {
    result.expandBy(box.corner(corner) * target_from_box);
  }
  return result;
}

osg::Matrixd scaled(const RobotShape& shape, const glm::dvec3& scale) {
  return osg::Matrixd::scale(scale.x, scale.y, scale.z) * toOsg(shape.link_from_shape);
}

std::optional<MeshTexture> decodeTexture(std::span<const std::byte> bytes) {
  if (isPng(bytes)) {
    auto png = readRgbaPng(bytes);
    return png ? std::optional(MeshTexture{png->width, png->height, std::move(png->rgba)}) : std::nullopt;
  }
  auto jpeg = readJpeg(bytes);
  return jpeg ? std::optional(MeshTexture{jpeg->width, jpeg->height, std::move(jpeg->rgba)}) : std::nullopt;
}

}  // namespace

/// Brings shapes to pieces, each mesh once.
class RobotSceneBuilder {
 public:
  RobotSceneBuilder(const MeshLoader& loader, std::filesystem::path file, RobotScene::Options options)
      : loader_(loader), file_(std::move(file)), options_(options) {}

  RobotScene run(Robot robot) {
    scene_.robot_ = std::move(robot);
    scene_.remarks_ = scene_.robot_.remarks;
    loadMeshes();
    for (std::size_t i = 0; i < scene_.robot_.links.size(); ++i) {
      const RobotLink& from = scene_.robot_.links[i];
      RobotScene::Link link;
      if (options_.has_visuals) {
        addPieces(i, from.visuals, from.collisions, link.visuals, link.visual_box);
      }
      if (options_.has_collisions) {
        addPieces(i, from.collisions, from.visuals, link.collisions, link.collision_box);
      }
      scene_.links_.push_back(std::move(link));
    }
    scene_.bytes_ = sizeof(scene_) + scene_.robot_.byteSize();
    std::set<const MeshArrays*> counted;
    for (const RobotScene::Link& link : scene_.links_) {
      for (const auto* pieces : {&link.visuals, &link.collisions}) {
        for (const RobotPiece& piece : *pieces) {
          scene_.bytes_ += sizeof(piece) + (counted.insert(piece.mesh.get()).second ? piece.mesh->byteSize() : 0);
        }
      }
    }
    return std::move(scene_);
  }

 private:
  void loadMeshes() {
    std::set<std::string> names;
    for (const RobotLink& link : scene_.robot_.links) {
      for (const auto& [shapes, is_wanted] :
           {std::pair{&link.visuals, options_.has_visuals}, std::pair{&link.collisions, options_.has_collisions}}) {
        for (const RobotShape& shape : *shapes) {
          if (shape.kind == RobotShapeKind::Mesh && is_wanted) {
            names.insert(shape.mesh_uri);
          }
        }
      }
    }
    const std::vector<std::string> uris(names.begin(), names.end());
    const auto loaded = loader_.loadAll(uris, file_, options_.meshes);
    for (std::size_t i = 0; i < uris.size(); ++i) {
      take(uris[i], loaded[i]);
    }
    scene_.mesh_count_ = uris.size();
  }

  void take(const std::string& uri, const MeshLoader::Loaded& loaded) {
    if (!loaded) {
      faults_.emplace(uri, loaded.error());
      return;
    }
    meshes_.emplace(uri, std::make_shared<const MeshArrays>(**loaded));
    if (!(*loaded)->remarks.empty()) {
      remark("'" + uri + "': " + (*loaded)->remarks);
    }
  }

  void remark(const std::string& what) {
    if (scene_.remarks_.size() < kMaxRemarks) {
      scene_.remarks_ += (scene_.remarks_.empty() ? "" : "; ") + what;
    }
  }

  void addPieces(std::size_t link, const std::vector<RobotShape>& shapes, const std::vector<RobotShape>& twins,
                 std::vector<RobotPiece>& pieces, osg::BoundingBoxd& box) {
    for (const RobotShape& shape : shapes) {
      auto piece = makePiece(shape);
      if (!piece) {
        piece = makePlaceholder(link, shape, twins);
        scene_.faults_.push_back({scene_.robot_.links[link].name, faults_.at(shape.mesh_uri)});
      }
      box.expandBy(turned(piece->mesh->box(), piece->link_from_mesh));
      pieces.push_back(std::move(*piece));
    }
  }

  std::optional<RobotPiece> makePiece(const RobotShape& shape) {
    RobotPiece piece;
    piece.color = shape.color;
    piece.link_from_mesh = scaled(shape, shape.size);
    switch (shape.kind) {
      case RobotShapeKind::Box:
        piece.mesh = unitMesh("box", [] { return boxMesh(); });
        break;
      case RobotShapeKind::Sphere:
        piece.mesh = unitMesh("sphere", [] { return sphereMesh(32); });
        break;
      case RobotShapeKind::Cylinder:
        piece.mesh = unitMesh("cylinder", [] { return frustumMesh(0.5F, 0.5F, 32); });
        break;
      case RobotShapeKind::Capsule: {
        // The ends stay round: its own proportions, scaled evenly.
        const double proportion = shape.size.z / shape.size.x;
        piece.mesh = unitMesh("capsule " + std::to_string(proportion),
                              [&] { return capsuleMesh(0.5F, static_cast<float>(proportion), 32); });
        piece.link_from_mesh = scaled(shape, glm::dvec3(shape.size.x));
        break;
      }
      case RobotShapeKind::Mesh: {
        const auto found = meshes_.find(shape.mesh_uri);
        if (found == meshes_.end()) {
          return std::nullopt;
        }
        piece.mesh = shape.texture_uri.empty() ? found->second : texturedMesh(shape, found->second);
        break;
      }
    }
    return piece;
  }

  /// The mesh with the description's texture on those of its parts that have no material of their own.
  std::shared_ptr<const MeshArrays> texturedMesh(const RobotShape& shape,
                                                 const std::shared_ptr<const MeshArrays>& plain) {
    const auto [known, is_new] = textured_.try_emplace({shape.mesh_uri, shape.texture_uri}, plain);
    const auto data = is_new ? loader_.load(shape.mesh_uri, file_, options_.meshes) : MeshLoader::Loaded();
    if (!is_new || !data || (*data)->uvs.empty()) {
      return known->second;
    }
    const auto bytes = loader_.read(shape.texture_uri, file_);
    const auto texture = bytes ? decodeTexture(*bytes) : std::nullopt;
    if (!texture) {
      remark("texture '" + shape.texture_uri + "' cannot be shown" + (bytes ? "" : ": " + bytes.error().message));
      return known->second;
    }
    MeshData mesh = **data;
    for (MeshMaterial& material : mesh.materials) {
      if (!material.is_from_file) {
        material.texture = static_cast<std::int32_t>(mesh.textures.size());
      }
    }
    mesh.textures.push_back(*texture);
    known->second = std::make_shared<const MeshArrays>(mesh);
    return known->second;
  }

  template <typename Make>
  std::shared_ptr<const MeshArrays> unitMesh(const std::string& name, Make make) {
    auto& mesh = units_[name];
    if (mesh == nullptr) {
      mesh = std::make_shared<const MeshArrays>(make());
    }
    return mesh;
  }

  /// A box where the mesh would be: that of the link's other shapes, else one that reaches to the joints on the link.
  RobotPiece makePlaceholder(std::size_t link, const RobotShape& shape, const std::vector<RobotShape>& twins) {
    osg::BoundingBoxd box;
    for (const RobotShape& twin : twins) {
      if (twin.kind == RobotShapeKind::Mesh && !meshes_.contains(twin.mesh_uri) && !faults_.contains(twin.mesh_uri)) {
        take(twin.mesh_uri, loader_.load(twin.mesh_uri, file_, options_.meshes));
      }
      if (const auto piece = makePiece(twin)) {
        box.expandBy(turned(piece->mesh->box(), piece->link_from_mesh));
      }
    }
    if (!box.valid()) {
      box.expandBy(0.0, 0.0, 0.0);
      box.expandBy(toOsg(shape.link_from_shape.translation));
      for (const RobotJoint& joint : scene_.robot_.joints) {
        if (joint.parent_link == link) {
          box.expandBy(toOsg(joint.parent_from_joint.translation));
        }
      }
    }
    const double longest = std::max({box.xMax() - box.xMin(), box.yMax() - box.yMin(), box.zMax() - box.zMin()});
    const double least = longest < kLeastPlaceholder ? kLonePlaceholder : std::max(0.2 * longest, kLeastPlaceholder);
    const auto edge = [&](double low, double high) { return std::max(high - low, least); };
    RobotPiece piece;
    piece.is_placeholder = true;
    piece.mesh = unitMesh("box", [] { return boxMesh(); });
    const osg::Vec3d center = box.center();
    piece.link_from_mesh =
        osg::Matrixd::scale(edge(box.xMin(), box.xMax()), edge(box.yMin(), box.yMax()), edge(box.zMin(), box.zMax())) *
        osg::Matrixd::translate(center);
    return piece;
  }

  const MeshLoader& loader_;
  std::filesystem::path file_;
  RobotScene::Options options_;
  std::map<std::string, std::shared_ptr<const MeshArrays>> meshes_;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const MeshArrays>> textured_;  // by mesh and texture
  std::map<std::string, Status> faults_;
  std::map<std::string, std::shared_ptr<const MeshArrays>> units_;
  RobotScene scene_;
};

std::expected<RobotScene, Status> RobotScene::make(const scenegraph::RobotDescription& description,
                                                   const MeshLoader& loader, const Options& options) {
  auto robot = readUrdf(description.text);
  if (!robot) {
    return std::unexpected(robot.error());
  }
  return RobotSceneBuilder(loader, description.file, options).run(std::move(*robot));
}

void RobotScene::releaseGlObjects() const {
  for (const Link& link : links_) {
    for (const auto* pieces : {&link.visuals, &link.collisions}) {
      for (const RobotPiece& piece : *pieces) {
        piece.mesh->releaseGlObjects();
      }
    }
  }
}

}  // namespace stillframe::nodes
