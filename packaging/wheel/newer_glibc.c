// SPDX-License-Identifier: GPL-3.0-or-later
// What salebra and the static C++ library of Debian 12 take from a C library newer than 2.27. Hidden, so that nobody else gets it here.
#include <stdint.h>
#include <stdlib.h>
#include <sys/random.h>
#include <sys/syscall.h>
#include <unistd.h>

#pragma GCC visibility push(hidden)

// glibc 2.32: false makes reference counts atomic, which is always right.
char __libc_single_threaded = 0;

// glibc 2.36, for std::random_device.
uint32_t arc4random(void) {
  uint32_t number;
  if (getrandom(&number, sizeof number, 0) != sizeof number) {
    abort();
  }
  return number;
}

// glibc 2.28.
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  return (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, flags);
}
