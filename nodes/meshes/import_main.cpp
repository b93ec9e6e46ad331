// stillframe-import-mesh: reads one mesh through assimp where that can take nothing else with it.
//
// Started by the mesh loader, see import_process.h: the mesh lies in descriptor 3, the result goes into 4
// (mesh_stream.h), a sentence on what is wrong into 5. Exit codes: 0 done, 1 not a mesh, 2 out of memory, 3 misuse.
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <string_view>

#include "nodes/meshes/import_protocol.h"
#include "nodes/meshes/import_sandbox.h"
#include "nodes/meshes/mesh_import.h"
#include "nodes/meshes/mesh_stream.h"

namespace {

using namespace stillframe::nodes;

[[noreturn]] void end(ImportExit code, std::string_view why) {
  why = why.substr(0, kMaxImportSentence);
  [[maybe_unused]] const auto written = write(kImportSentenceFd, why.data(), why.size());
  _exit(static_cast<int>(code));  // nothing of assimp is torn down: that may hang too
}

std::uint64_t number(const std::map<std::string, std::string>& arguments, const std::string& key) {
  const auto found = arguments.find(key);
  std::uint64_t value = 0;
  if (found == arguments.end() ||
      std::from_chars(found->second.data(), found->second.data() + found->second.size(), value).ec != std::errc()) {
    end(ImportExit::Misuse, "the number " + key + " is missing");
  }
  return value;
}

void put(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(kImportResultFd, bytes.data(), bytes.size());
    if (written <= 0) {
      end(ImportExit::OutOfMemory, "the mesh is larger than the limit of the result");
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void run(const std::map<std::string, std::string>& arguments) {
  confineProcess({.memory_bytes = number(arguments, "memory"),
                  .output_bytes = number(arguments, "output"),
                  .cpu_s = static_cast<std::uint32_t>(number(arguments, "cpu"))});
  struct stat status{};
  if (fstat(kImportMeshFd, &status) != 0 || status.st_size <= 0) {
    end(ImportExit::NotAMesh, "the file is empty");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  const void* const at = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, kImportMeshFd, 0);
  if (at == MAP_FAILED) {
    end(ImportExit::OutOfMemory, "the file does not fit into the memory that the import may use");
  }
  const auto text = [&](const std::string& key) {
    const auto found = arguments.find(key);
    return found == arguments.end() ? std::string() : found->second;
  };
  const auto mesh = importMesh({.bytes = {static_cast<const std::byte*>(at), size},
                                .format = text("format"),
                                .file = text("file"),
                                .within = text("within"),
                                .use_collada_up_axis = text("up_axis") == "file"});
  if (!mesh) {
    end(ImportExit::NotAMesh, mesh.error());
  }
  writeMesh(*mesh, put);
  _exit(static_cast<int>(ImportExit::Done));
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const auto equals = argument.find('=');
    if (equals == std::string_view::npos) {
      end(ImportExit::Misuse, "started by the mesh loader of Stillframe only");
    }
    arguments.emplace(argument.substr(0, equals), argument.substr(equals + 1));
  }
  try {
    run(arguments);
  } catch (const std::bad_alloc&) {
    end(ImportExit::OutOfMemory, "the import needs more memory than it may use");
  } catch (const std::exception& error) {
    end(ImportExit::NotAMesh, error.what());
  }
}
