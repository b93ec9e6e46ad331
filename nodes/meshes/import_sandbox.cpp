#include "nodes/meshes/import_sandbox.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <vector>

namespace stillframe::nodes {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif
#else
constexpr bool kIsSanitized = false;
#endif

/// `grace`: what the hard limit lies above, so that the signal of the soft one tells the reason.
void limit(decltype(RLIMIT_AS) what, std::uint64_t most, std::uint64_t grace = 0) {
  rlimit both{};
  (void)getrlimit(what, &both);
  both.rlim_max = both.rlim_max == RLIM_INFINITY ? most + grace : std::min<rlim_t>(both.rlim_max, most + grace);
  both.rlim_cur = std::min<rlim_t>(both.rlim_max, most);
  (void)setrlimit(what, &both);
}

sock_filter load(std::size_t offset) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)}; }
/// Skips as many instructions when the loaded word is that, or is not.
sock_filter jumpIfEqual(std::uint32_t value, std::uint8_t then, std::uint8_t otherwise) {
  return {BPF_JMP | BPF_JEQ | BPF_K, then, otherwise, value};
}
sock_filter answer(std::uint32_t what) { return {BPF_RET | BPF_K, 0, 0, what}; }

/// Each system call that could reach beyond the process fails with EPERM.
std::vector<sock_filter> systemCallFilter() {
  const std::uint32_t refuse = SECCOMP_RET_ERRNO | EPERM;
  std::vector<sock_filter> filter{load(offsetof(seccomp_data, arch)), jumpIfEqual(kArchitecture, 1, 0), answer(refuse),
                                  load(offsetof(seccomp_data, nr))};
  for (const long call : {
#ifdef SYS_fork
           SYS_fork,
           SYS_vfork,
           SYS_open,
           SYS_creat,
           SYS_unlink,
           SYS_rename,
           SYS_mkdir,
           SYS_rmdir,
           SYS_chmod,
           SYS_link,
           SYS_symlink,
#endif
           SYS_socket,
           SYS_socketpair,
           SYS_connect,
           SYS_bind,
           SYS_sendto,
           SYS_sendmsg,
           SYS_execve,
           SYS_execveat,
           SYS_ptrace,
           SYS_process_vm_readv,
           SYS_process_vm_writev,
           SYS_kill,
           SYS_clone,
           SYS_clone3,
           SYS_unlinkat,
           SYS_renameat,
           SYS_renameat2,
           SYS_mkdirat,
           SYS_linkat,
           SYS_symlinkat,
           SYS_fchmodat,
           SYS_fchownat,
           SYS_truncate,
           SYS_mount,
           SYS_io_uring_setup,
           SYS_bpf,
           SYS_perf_event_open,
           SYS_openat2,
           SYS_setsid,
           SYS_prlimit64}) {
    filter.push_back(jumpIfEqual(static_cast<std::uint32_t>(call), 0, 1));
    filter.push_back(answer(refuse));
  }
  // tgkill: itself, which is how abort() ends.
  filter.push_back(jumpIfEqual(SYS_tgkill, 0, 4));
  filter.push_back(load(offsetof(seccomp_data, args)));
  filter.push_back(jumpIfEqual(static_cast<std::uint32_t>(getpid()), 0, 1));
  filter.push_back(answer(SECCOMP_RET_ALLOW));
  filter.push_back(answer(refuse));
  // openat: reading only.
  filter.push_back(jumpIfEqual(SYS_openat, 0, 3));
  filter.push_back(load(offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t)));
  filter.push_back({BPF_JMP | BPF_JSET | BPF_K, 0, 1, O_WRONLY | O_RDWR | O_CREAT | O_TRUNC});
  filter.push_back(answer(refuse));
  filter.push_back(answer(SECCOMP_RET_ALLOW));
  return filter;
}

}  // namespace

bool confineProcess(const ImportLimits& limits) {
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  (void)prctl(PR_SET_DUMPABLE, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_s, 2);
  limit(RLIMIT_FSIZE, limits.output_bytes);
  limit(RLIMIT_NOFILE, 64);
  if (!kIsSanitized) {
    limit(RLIMIT_AS, limits.memory_bytes);  // sanitizers reserve terabytes
  }
  (void)std::signal(SIGXFSZ, SIG_IGN);  // writes fail instead
  if (kArchitecture == 0 || kIsSanitized || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) {
    return false;
  }
  std::vector<sock_filter> filter = systemCallFilter();
  const sock_fprog program{.len = static_cast<unsigned short>(filter.size()), .filter = filter.data()};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace stillframe::nodes
