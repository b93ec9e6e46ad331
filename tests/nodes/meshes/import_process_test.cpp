// What files do to the importer must not reach the program.
#include "nodes/meshes/import_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/nodes/meshes/mesh_files.h"

namespace stillframe::nodes {
namespace {

/// Puts a script in the importer's place.
class FakeImporter {
 public:
  explicit FakeImporter(const std::string& script) {
    const auto file = files_.add("importer", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    setenv("STILLFRAME_MESH_IMPORTER", file.c_str(), 1);
  }
  ~FakeImporter() { unsetenv("STILLFRAME_MESH_IMPORTER"); }
  FakeImporter(const FakeImporter&) = delete;
  FakeImporter& operator=(const FakeImporter&) = delete;

 private:
  test::FilesFolder files_;
};

std::string codeOf(ImportLimits limits = {}) {
  const auto mesh = importInProcess({.bytes = test::bytesOf(test::kStl), .format = "stl", .limits = limits});
  return mesh ? "Ok" : mesh.error().code;
}

TEST(ImportProcess, IsFoundBesideTheProgram) {
  const auto importer = findMeshImporter();
  ASSERT_TRUE(importer);
  EXPECT_EQ(importer->filename(), "stillframe-import-mesh");
  EXPECT_EQ(codeOf(), "Ok");
}

TEST(ImportProcess, CrashesAbortsAndHangsAreStatuses) {
  {
    const FakeImporter importer("kill -SEGV $$");
    EXPECT_EQ(codeOf(), "MeshImportCrashed");
  }
  {
    const FakeImporter importer("kill -ABRT $$");
    EXPECT_EQ(codeOf(), "MeshImportCrashed");
  }
  {
    const FakeImporter importer("exec sleep 60");
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(codeOf({.wall_s = 1}), "MeshImportHung");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  }
  {
    const FakeImporter importer("exec 5>&-; exec sleep 60");  // has closed its end, and goes on
    EXPECT_EQ(codeOf({.wall_s = 1}), "MeshImportHung");
  }
}

TEST(ImportProcess, ResultsThatAreNoMeshAreRefused) {
  {
    const FakeImporter importer("exit 0");
    EXPECT_EQ(codeOf(), "MeshImportGarbled");
  }
  {
    const FakeImporter importer("echo nonsense >&4; exit 0");
    EXPECT_EQ(codeOf(), "MeshImportGarbled");
  }
  {
    const FakeImporter importer("exit 77");
    EXPECT_EQ(codeOf(), "MeshImportGarbled");
  }
  {
    const FakeImporter importer("yes long | head -c 100000 >&5; exit 1");
    const auto mesh = importInProcess({.bytes = test::bytesOf(test::kStl), .format = "stl"});
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, "MeshUnreadable");
    EXPECT_LT(mesh.error().message.size(), 2000U);
  }
}

TEST(ImportProcess, AMissingImporterSaysSo) {
  setenv("STILLFRAME_MESH_IMPORTER", "/nonexistent/importer", 1);
  EXPECT_EQ(codeOf(), "NoMeshImporter");
  unsetenv("STILLFRAME_MESH_IMPORTER");
}

TEST(ImportProcess, ALittleMemoryIsAStatus) { EXPECT_EQ(codeOf({.output_bytes = 64}), "MeshTooLarge"); }

TEST(ImportSandbox, ReachesNoNetworkAndWritesNoFile) {
  EXPECT_EXIT(
      {
        if (!confineProcess({})) {
          _exit(0);  // no filter on this machine, or a sanitizer build
        }
        const bool has_network = socket(AF_INET, SOCK_STREAM, 0) >= 0 || errno != EPERM;
        const bool can_write = open("/dev/null", O_WRONLY) >= 0 || errno != EPERM;
        const bool can_read = open("/proc/self/status", O_RDONLY) >= 0;
        _exit(has_network ? 1 : can_write ? 2 : can_read ? 0 : 3);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace stillframe::nodes
