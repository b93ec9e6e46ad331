// robot_seeds OUT: writes what the fuzzers of robots and meshes start from: OUT/urdf and OUT/mesh.
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

#include "nodes/meshes/mesh_stream.h"

using namespace stillframe;

namespace {

constexpr std::string_view kRobot =
    R"(<?xml version="1.0"?><robot name="r"><material name="blue"><color rgba="0 0 1 0.5"/></material>
<link name="base"><visual><origin xyz="0 0 1" rpy="0 0.1 0"/><geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
<collision><geometry><capsule radius="0.2" length="1"/></geometry></collision></link>
<link name="arm"><visual><geometry><mesh filename="package://p/arm.dae" scale="1 -1 0.001"/></geometry></visual></link>
<link name="tip"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<joint name="a" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="b" type="prismatic"><parent link="arm"/><child link="tip"/><limit lower="0" upper="1" effort="1" velocity="1"/>
<mimic joint="a" multiplier="2" offset="0.1"/></joint></robot>)";

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  const std::filesystem::path out = argv[1];
  std::filesystem::create_directories(out / "urdf");
  std::filesystem::create_directories(out / "mesh");
  std::ofstream(out / "urdf/robot.urdf", std::ios::binary) << kRobot;
  nodes::MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 3}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.uvs.assign(3, {0, 0});
  mesh.colors.assign(3, {1, 2, 3, 4});
  mesh.indices = {0, 1, 2};
  mesh.materials = {{.name = "m", .color = {1, 1, 1, 1}, .texture = 0}};
  mesh.submeshes = {{0, 3, 0}};
  mesh.textures = {{1, 1, {1, 2, 3, 4}}};
  std::ofstream file(out / "mesh/triangle", std::ios::binary);
  nodes::writeMesh(mesh, [&](std::span<const std::byte> piece) {
    file.write(reinterpret_cast<const char*>(piece.data()), static_cast<std::streamsize>(piece.size()));
  });
  return file ? 0 : 1;
}
