// diptych: a process that starts no other program
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/no_programs.h"

#include <cerrno>
#include <cstddef>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace diptych::continuum
{
#if defined(__x86_64__) || defined(__aarch64__)
  namespace
  {
#if defined(__x86_64__)
    constexpr unsigned int this_architecture = AUDIT_ARCH_X86_64;
#else
    constexpr unsigned int this_architecture = AUDIT_ARCH_AARCH64;
#endif
    constexpr unsigned int x32_calls = 0x40000000; // the second table of calls of x86_64 begins here

    const std::vector<unsigned int> forbidden_calls = {
      SYS_execve,   SYS_execveat, SYS_unlinkat, SYS_renameat, SYS_renameat2, SYS_mkdirat, SYS_linkat, SYS_symlinkat,
      SYS_truncate, SYS_mknodat,  SYS_socket,
#if defined(__x86_64__) // aarch64 has only those above
      SYS_unlink,   SYS_rmdir,    SYS_rename,   SYS_mkdir,    SYS_link,      SYS_symlink, SYS_mknod,  SYS_creat,
#endif
    };

    // A program of the kernel's filter: of another architecture, of x32 and of the list: EPERM; all else passes.
    std::vector<sock_filter> filter_of_calls()
    {
      const auto load = [](const std::size_t offset) {
        return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned int>(offset));
      };
      const sock_filter        refuse = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
      std::vector<sock_filter> filter{
        load(offsetof(seccomp_data, arch)), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, this_architecture, 1, 0), refuse,
        load(offsetof(seccomp_data, nr)),   BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, x32_calls, 0, 1),         refuse};
      for (const unsigned int call : forbidden_calls)
        {
          filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
          filter.push_back(refuse);
        }
      filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
      return filter;
    }
  } // namespace

  bool forbid_programs()
  {
    auto             filter  = filter_of_calls();
    const sock_fprog program = {static_cast<unsigned short>(filter.size()), filter.data()};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }
#else
  bool forbid_programs()
  {
    return false;
  }
#endif
} // namespace diptych::continuum
