// Every mesh of public projects, good and bad: each gives a mesh or says why not, and none takes this program with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <string>

#include "nodes/meshes/mesh_loader.h"

namespace stillframe::nodes {
namespace {

namespace fs = std::filesystem;

class RecordedMeshes : public ::testing::Test {
 protected:
  std::map<std::string, std::size_t> countCodes(const fs::path& folder) {
    const std::set<std::string> endings{".stl", ".dae", ".obj", ".ply", ".gltf", ".glb", ".3ds", ".x", ".zae"};
    std::map<std::string, std::size_t> codes;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      std::string ending = entry.path().extension().string();
      std::ranges::transform(ending, ending.begin(),
                             [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (entry.is_regular_file() && endings.contains(ending)) {
        const auto mesh = loader_.load(entry.path().string());
        ++codes[mesh ? "Ok" : mesh.error().code];
        EXPECT_TRUE(mesh || mesh.error().message.find(entry.path().string()) != std::string::npos);
      }
    }
    return codes;
  }
  scenegraph::ObjectCache cache_;
  scenegraph::Resources resources_;
  MeshLoader loader_{cache_, resources_};
  const fs::path data_ = fs::path(STILLFRAME_TEST_DATA).lexically_normal();
};

TEST_F(RecordedMeshes, AllOfTheRobotsAreRead) {
  const auto codes = countCodes(data_ / "urdf");
  EXPECT_EQ(codes.size(), 1U);
  EXPECT_GE(codes.at("Ok"), 70U);
}

TEST_F(RecordedMeshes, GoodAndBadFilesEndInAMeshOrAReason) {
  const auto codes = countCodes(data_ / "meshes");
  for (const auto& [code, count] : codes) {
    EXPECT_TRUE(code == "Ok" || code == "MeshUnreadable" || code == "MeshImportCrashed" || code == "MeshImportHung" ||
                code == "MeshTooLarge")
        << code;
  }
  EXPECT_GE(codes.at("Ok"), 75U);
  EXPECT_GE(codes.at("MeshImportCrashed"), 1U);  // assimp 5.2.5 does
}

TEST_F(RecordedMeshes, VisualAndCollisionMeshesOfOneLinkCoverOneAnother) {
  const fs::path panda = data_ / "urdf/moveit_resources/panda_description/meshes";
  for (const char* const link :
       {"link0", "link1", "link2", "link3", "link4", "link5", "link6", "link7", "hand", "finger"}) {
    const auto visual = loader_.load((panda / "visual" / (std::string(link) + ".dae")).string());
    const auto collision = loader_.load((panda / "collision" / (std::string(link) + ".stl")).string());
    ASSERT_TRUE(visual && collision) << link;
    EXPECT_LT(glm::length((*visual)->low - (*collision)->low), 0.01F) << link;
    EXPECT_LT(glm::length((*visual)->high - (*collision)->high), 0.01F) << link;
  }
}

}  // namespace
}  // namespace stillframe::nodes
