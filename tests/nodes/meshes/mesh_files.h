#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace stillframe::test {

/// A folder of files, gone at the end.
class FilesFolder {
 public:
  FilesFolder() {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) / ("stillframe_" + std::string(test->test_suite_name()) + "_" +
                                                           test->name() + "_" + std::to_string(getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~FilesFolder() { std::filesystem::remove_all(path_); }
  FilesFolder(const FilesFolder&) = delete;
  FilesFolder& operator=(const FilesFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file beneath it; the path of the file.
  std::filesystem::path add(const std::filesystem::path& name, std::string_view text) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

/// One triangle (0,0,0) (1,0,0) (0,2,3) in each format.
inline constexpr std::string_view kStl =
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 3\nendloop\nendfacet\nendsolid "
    "t\n";
inline constexpr std::string_view kObj = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 3\nusemtl red\nf 1 2 3\n";
inline constexpr std::string_view kMtl = "newmtl red\nKd 1 0 0.2\nd 0.5\n";
inline constexpr std::string_view kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
    "red\n"
    "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255 0 0\n1 0 0 0 255 0\n0 2 3 0 0 128\n3 0 1 2\n";
/// Buffer: three float positions, three 16-bit indices.
inline constexpr std::string_view kGltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.2140411,0,1,0.25]}}],
"buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAEBAAAABAAIA"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";

/// A Collada file in that unit, whose one node is placed by `matrix`.
inline std::string collada(std::string_view meter, std::string_view up_axis,
                           std::string_view matrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter=")" +
         std::string(meter) + R"(" name="u"/><up_axis>)" + std::string(up_axis) +
         R"(</up_axis></asset><library_effects><effect id="e"><profile_COMMON><technique sid="c"><lambert><diffuse>
<color>0.5 0.25 1 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects><library_materials>
<material id="m" name="blue"><instance_effect url="#e"/></material></library_materials><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 2 3</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices><triangles count="1" material="s"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="s0"><node id="n"><matrix>)" +
         std::string(matrix) + R"(</matrix>
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="s" target="#m"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes><scene>
<instance_visual_scene url="#s0"/></scene></COLLADA>)";
}

}  // namespace stillframe::test
