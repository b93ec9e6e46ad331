#pragma once

#include <assimp/IOSystem.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace stillframe::nodes {

/// The files an importer may open: the mesh, which is in memory, and regular files beneath one folder.
///
/// Names are taken relative to the mesh's folder. An absolute name, and one that leads out of the folder, stands for
/// the file of that name beside the mesh, if there is one: exporters write paths of the machine that they ran on.
class ContainedFiles final : public Assimp::IOSystem {
 public:
  ContainedFiles(std::span<const std::byte> mesh, std::filesystem::path mesh_name, std::filesystem::path folder,
                 const std::filesystem::path& within);

  /// Bytes of a file beside the mesh; nullopt when there is none that may be read.
  [[nodiscard]] std::optional<std::vector<std::byte>> read(const std::string& name) const;

  bool Exists(const char* name) const override;
  [[nodiscard]] char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  [[nodiscard]] bool isMesh(const std::filesystem::path& name) const { return name == mesh_name_; }
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name) const;

  std::span<const std::byte> mesh_;
  std::filesystem::path mesh_name_;
  std::filesystem::path folder_;
  std::filesystem::path within_;
};

}  // namespace stillframe::nodes
