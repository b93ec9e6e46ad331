#include "nodes/meshes/import_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "nodes/meshes/import_protocol.h"
#include "nodes/meshes/mesh_stream.h"

namespace stillframe::nodes {
namespace {

using Clock = std::chrono::steady_clock;
using scenegraph::failure;
using scenegraph::Status;
using scenegraph::StatusLevel;

constexpr const char* kProgram = "stillframe-import-mesh";
constexpr int kFirstOwnFd = 10;  // above those that the child finds its own under

/// A file descriptor that is closed at the end, and in children.
class Fd {
 public:
  explicit Fd(int fd = -1) : fd_(fd) {
    if (fd_ >= 0 && fd_ < kFirstOwnFd) {
      const int higher = fcntl(fd_, F_DUPFD_CLOEXEC, kFirstOwnFd);
      close(fd_);
      fd_ = higher;
    }
  }
  ~Fd() { reset(); }
  Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Fd& operator=(Fd&&) = delete;
  Fd(const Fd&) = delete;
  Fd& operator=(const Fd&) = delete;
  void reset() {
    if (fd_ >= 0) {
      close(std::exchange(fd_, -1));
    }
  }
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool isOpen() const { return fd_ >= 0; }

 private:
  int fd_;
};

/// The bytes as a file in memory.
Fd memoryFile(std::span<const std::byte> bytes) {
  Fd fd(memfd_create("stillframe-mesh", MFD_CLOEXEC));
  while (fd.isOpen() && !bytes.empty()) {
    const ssize_t written = write(fd.get(), bytes.data(), bytes.size());
    if (written <= 0 && errno != EINTR) {
      return Fd();
    }
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return fd;
}

/// How a child ended.
struct Ending {
  bool is_late = false;  ///< killed by us
  int status = 0;        ///< of waitpid
  std::string sentence;
};

/// Reads the child's sentence until it closes the pipe, kills it at the deadline, and takes its status.
Ending awaitEnd(pid_t child, const Fd& pipe, Clock::time_point deadline) {
  Ending ending;
  std::array<char, 512> buffer{};
  bool is_open = true;
  while (is_open && !ending.is_late) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd entry{.fd = pipe.get(), .events = POLLIN, .revents = 0};
    const int ready = left <= 0 ? 0 : poll(&entry, 1, static_cast<int>(std::min<std::int64_t>(left, 60'000)));
    if (ready > 0) {
      const ssize_t got = read(pipe.get(), buffer.data(), buffer.size());
      is_open = got > 0 || (got < 0 && errno == EINTR);
      const std::size_t room = kMaxImportSentence - std::min(ending.sentence.size(), kMaxImportSentence);
      ending.sentence.append(buffer.data(), std::min(room, static_cast<std::size_t>(std::max<ssize_t>(got, 0))));
    }
    ending.is_late = is_open && Clock::now() >= deadline;
  }
  while (true) {
    if (ending.is_late) {
      (void)kill(child, SIGKILL);
    }
    const pid_t ended = waitpid(child, &ending.status, ending.is_late ? 0 : WNOHANG);
    if (ended == child) {
      return ending;
    }
    if (ended < 0 && errno != EINTR) {  // somebody else in this program has waited for it
      ending.status = -1;
      return ending;
    }
    ending.is_late = ending.is_late || Clock::now() >= deadline;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

std::expected<pid_t, Status> spawn(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                   const Fd& mesh, const Fd& result, const Fd& sentence) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int fd : {0, 1, 2}) {
    posix_spawn_file_actions_addopen(&actions, fd, "/dev/null", O_RDWR, 0);
  }
  posix_spawn_file_actions_adddup2(&actions, mesh.get(), kImportMeshFd);
  posix_spawn_file_actions_adddup2(&actions, result.get(), kImportResultFd);
  posix_spawn_file_actions_adddup2(&actions, sentence.get(), kImportSentenceFd);
  posix_spawn_file_actions_addclosefrom_np(&actions, kImportSentenceFd + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<char*> argv{const_cast<char*>(kProgram)};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  std::vector<std::string> environment{"LC_ALL=C"};
  for (const char* const name : {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"}) {
    if (const char* const value = std::getenv(name)) {
      environment.push_back(std::string(name) + "=" + value);
    }
  }
  std::vector<char*> envp;
  for (std::string& variable : environment) {
    envp.push_back(variable.data());
  }
  envp.push_back(nullptr);
  pid_t child = -1;
  const int error = posix_spawn(&child, program.c_str(), &actions, &attributes, argv.data(), envp.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) {
    return failure("NoMeshImporter", "'" + program.string() + "' cannot be started: " + std::strerror(error));
  }
  return child;
}

std::expected<MeshData, Status> readResult(const Fd& result, std::uint64_t most) {
  struct stat status{};
  if (fstat(result.get(), &status) != 0 || status.st_size <= 0 || static_cast<std::uint64_t>(status.st_size) > most) {
    return failure("MeshImportGarbled", "the importer ended without a result");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const at = mmap(nullptr, size, PROT_READ, MAP_SHARED, result.get(), 0);
  if (at == MAP_FAILED) {
    return failure("MeshTooLarge", "there is no memory for the " + std::to_string(size) + " bytes of the mesh");
  }
  auto mesh = readMesh({static_cast<const std::byte*>(at), size});
  munmap(at, size);
  if (!mesh) {
    return failure("MeshImportGarbled", "the importer's result is not a mesh that can be drawn (" +
                                            std::string(toString(mesh.error())) + ")");
  }
  return std::move(*mesh);
}

Status statusOf(const Ending& ending, const ImportLimits& limits) {
  const auto error = [](std::string code, std::string message) {
    return Status{StatusLevel::Error, std::move(code), std::move(message)};
  };
  const bool is_signal = ending.status >= 0 && WIFSIGNALED(ending.status);
  if (ending.is_late || (is_signal && WTERMSIG(ending.status) == SIGXCPU)) {
    return error("MeshImportHung", "the importer was ended: it did not finish within " + std::to_string(limits.cpu_s) +
                                       " s of computing and " + std::to_string(limits.wall_s) + " s in all");
  }
  if (is_signal) {
    return error("MeshImportCrashed",
                 "the importer crashed on it (" + std::string(strsignal(WTERMSIG(ending.status))) + ")");
  }
  const int code = ending.status >= 0 && WIFEXITED(ending.status) ? WEXITSTATUS(ending.status) : -1;
  if (code == static_cast<int>(ImportExit::OutOfMemory)) {
    return error("MeshTooLarge", ending.sentence);
  }
  if (code == static_cast<int>(ImportExit::NotAMesh)) {
    return error("MeshUnreadable", "it cannot be read: " + ending.sentence);
  }
  return error("MeshImportGarbled", "the importer ended with code " + std::to_string(code) +
                                        (ending.sentence.empty() ? "" : ": " + ending.sentence));
}

/// The folder of the file that this code was loaded from: the program, or a host's plugin.
std::filesystem::path ownFolder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&findMeshImporter), &info) == 0 || info.dli_fname == nullptr) {
    return {};
  }
  std::error_code error;
  const auto file = std::filesystem::canonical(info.dli_fname, error);
  return error ? std::filesystem::path() : file.parent_path();
}

}  // namespace

std::optional<std::filesystem::path> findMeshImporter() {
  if (const char* const named = std::getenv("STILLFRAME_MESH_IMPORTER"); named != nullptr && *named != '\0') {
    return access(named, X_OK) == 0 ? std::optional<std::filesystem::path>(named) : std::nullopt;
  }
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<std::filesystem::path> folders;
  for (const auto& base : {program, ownFolder()}) {
    for (const char* const from : {".", "../libexec/stillframe", "../bin"}) {
      if (!base.empty()) {
        folders.push_back(base / from);
      }
    }
  }
  folders.emplace_back(STILLFRAME_LIBEXEC_DIR);
  for (const auto& folder : folders) {
    auto file = (folder / kProgram).lexically_normal();
    if (access(file.c_str(), X_OK) == 0) {
      return file;
    }
  }
  return std::nullopt;
}

ImportLimits importLimits(std::size_t file_bytes) noexcept {
  constexpr std::size_t kBytesPerSecond = std::size_t{4} << 20U;
  constexpr std::size_t kMostSeconds = 300;
  ImportLimits limits;
  limits.cpu_s += static_cast<std::uint32_t>(std::min(file_bytes / kBytesPerSecond, kMostSeconds));
  limits.wall_s = 5 + 2 * limits.cpu_s;
  limits.memory_bytes += 12 * static_cast<std::uint64_t>(std::min(file_bytes, std::size_t{1} << 32U));
  return limits;
}

std::expected<MeshData, Status> importInProcess(const ImportRequest& request) {
  if (request.bytes.empty()) {
    return failure("MeshUnreadable", "it cannot be read: the file is empty");
  }
  const auto program = findMeshImporter();
  if (!program) {
    return failure("NoMeshImporter", "the program '" + std::string(kProgram) +
                                         "', which reads meshes, is not there; STILLFRAME_MESH_IMPORTER may name it");
  }
  const Fd mesh = memoryFile(request.bytes);
  const Fd result(memfd_create("stillframe-result", MFD_CLOEXEC));
  std::array<int, 2> ends{-1, -1};
  if (!mesh.isOpen() || !result.isOpen() || pipe2(ends.data(), O_CLOEXEC) != 0) {
    return failure("MeshTooLarge", std::string("there is no memory to import it: ") + std::strerror(errno));
  }
  const Fd sentence(ends[0]);
  Fd childs_sentence(ends[1]);
  std::vector<std::string> arguments{
      "format=" + request.format, "memory=" + std::to_string(request.limits.memory_bytes),
      "output=" + std::to_string(request.limits.output_bytes), "cpu=" + std::to_string(request.limits.cpu_s),
      request.use_collada_up_axis ? "up_axis=file" : "up_axis=ignored"};
  if (!request.file.empty()) {
    arguments.push_back("file=" + request.file.string());
    arguments.push_back("within=" + request.within.string());
  }
  const auto child = spawn(*program, arguments, mesh, result, childs_sentence);
  if (!child) {
    return std::unexpected(child.error());
  }
  childs_sentence.reset();
  const auto deadline = Clock::now() + std::chrono::seconds(request.limits.wall_s);
  const Ending ending = awaitEnd(*child, sentence, deadline);
  const bool is_done = ending.status == 0 || (ending.status == -1 && ending.sentence.empty());
  return is_done ? readResult(result, request.limits.output_bytes) : std::unexpected(statusOf(ending, request.limits));
}

}  // namespace stillframe::nodes
