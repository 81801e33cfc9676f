// SPDX-License-Identifier: GPL-3.0-or-later
// Filter of system calls for the child that reads a file.
#include "system_calls.hpp"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace salebra::confinement {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t processor = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t processor = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t processor = 0;
#endif

constexpr std::uint32_t allow = SECCOMP_RET_ALLOW, deny = SECCOMP_RET_ERRNO | EPERM;

class Filter {
 public:
  Filter() {
    // Numbers of calls mean others in programs for another processor.
    load(offsetof(seccomp_data, arch));
    jump(BPF_JEQ, processor, 1, 0);
    end(deny);
  }

  /// Allows a call whatever its arguments.
  void call(long number) {
    load(offsetof(seccomp_data, nr));
    jump(BPF_JEQ, std::uint32_t(number), 0, 1);
    end(allow);
  }
  /// Allows a call with that value, of 32 bits, as its first argument.
  void call_with(long number, std::uint32_t first) { call_if(number, 0, BPF_JEQ, first, true); }
  /// Allows a call that has none of those bits in an argument.
  void call_without(long number, unsigned argument, std::uint32_t bits) {
    call_if(number, argument, BPF_JSET, bits, false);
  }

  std::vector<sock_filter> finished() && {
    end(deny);
    return std::move(program_);
  }

 private:
  void load(std::size_t offset) {
    program_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, std::uint32_t(offset)));
  }
  void end(std::uint32_t answer) { program_.push_back(BPF_STMT(BPF_RET | BPF_K, answer)); }
  /// Leaves out so many instructions, depending on the test of what was loaded.
  void jump(unsigned test, std::uint32_t value, unsigned if_true, unsigned if_false) {
    program_.push_back(BPF_JUMP(std::uint16_t(BPF_JMP | test | BPF_K), value, std::uint8_t(if_true),
                                std::uint8_t(if_false)));
  }
  void call_if(long number, unsigned argument, unsigned test, std::uint32_t value, bool wanted) {
    // The low half of an argument is its first.
    static_assert(std::endian::native == std::endian::little);
    load(offsetof(seccomp_data, nr));
    jump(BPF_JEQ, std::uint32_t(number), 0, 3);
    load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t));
    jump(test, value, wanted ? 0 : 1, wanted ? 1 : 0);
    end(allow);
  }

  std::vector<sock_filter> program_;
};

}  // namespace

bool restrict_system_calls(int input, int output) {
  if (processor == 0) return false;
  Filter filter;
  filter.call_with(SYS_pread64, std::uint32_t(input));
  filter.call_with(SYS_fstat, std::uint32_t(input));
#if defined(SYS_newfstatat)
  // fstat() of some C libraries; the empty name that it passes means the descriptor.
  filter.call_with(SYS_newfstatat, std::uint32_t(input));
#endif
  filter.call_with(SYS_write, std::uint32_t(output));
  filter.call_without(SYS_mmap, 2, PROT_EXEC);
  filter.call_without(SYS_mprotect, 2, PROT_EXEC);
  for (const long number :
       {SYS_munmap, SYS_mremap, SYS_brk, SYS_madvise, SYS_futex, SYS_sched_yield, SYS_exit,
        SYS_exit_group, SYS_rt_sigreturn, SYS_rt_sigprocmask, SYS_restart_syscall,
        SYS_clock_gettime, SYS_gettimeofday})
    filter.call(number);
  std::vector<sock_filter> program = std::move(filter).finished();
  sock_fprog description{static_cast<unsigned short>(program.size()), program.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &description) == 0;
}

}  // namespace salebra::confinement
