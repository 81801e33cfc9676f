// SPDX-License-Identifier: GPL-3.0-or-later
// Library to preload, which lets chosen calls on files below a folder, or allocations, fail as the
// plan in SALEBRA_FAULTS says.
#include "fault_library.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

using namespace salebra::faults;

Plan* plan = nullptr;
std::array<char, 4096> working_folder;
std::array<std::atomic<bool>, 1024> below;  // descriptors of files below the folder
std::atomic<bool> in_main = false;

/// Where HDF5 and OpenMP lie in memory, and FFTW where no program can replace its end. None
/// survives a failed allocation of its own (docs/reliability.md).
struct Range {
  uintptr_t begin = 0, end = 0;
  bool holds(const void* place) const {
    const auto address = reinterpret_cast<uintptr_t>(place);
    return address >= begin && address < end;
  }
};
std::array<Range, 8> exempt;
// HDF5's functions in the program, where it was linked as an archive, in their order.
std::array<Range, 8192> hdf5_functions;
size_t hdf5_function_count = 0;
#ifdef FFTW_ENDS_PROCESS
constexpr bool fftw_ends_process = true;
#else
constexpr bool fftw_ends_process = false;
#endif

// From the table of symbols of the program, which is not stripped where it was built.
void find_hdf5_functions(uintptr_t base) {
  const long file = syscall(SYS_openat, AT_FDCWD, "/proc/self/exe", O_RDONLY | O_CLOEXEC);
  const off_t size = lseek(static_cast<int>(file), 0, SEEK_END);
  void* const mapped =
      mmap(nullptr, static_cast<size_t>(size), PROT_READ, MAP_PRIVATE, static_cast<int>(file), 0);
  syscall(SYS_close, file);
  if (mapped == MAP_FAILED) _exit(98);
  const char* const image = static_cast<const char*>(mapped);
  const auto* header = reinterpret_cast<const ElfW(Ehdr)*>(image);
  const auto* sections = reinterpret_cast<const ElfW(Shdr)*>(image + header->e_shoff);
  for (int i = 0; i < header->e_shnum; ++i) {
    if (sections[i].sh_type != SHT_SYMTAB) continue;
    const auto* symbols = reinterpret_cast<const ElfW(Sym)*>(image + sections[i].sh_offset);
    const char* names = image + sections[sections[i].sh_link].sh_offset;
    for (size_t k = 0; k < sections[i].sh_size / sizeof(ElfW(Sym)); ++k) {
      const auto& one = symbols[k];
      if ((one.st_info & 0xf) != STT_FUNC || one.st_shndx == SHN_UNDEF ||
          strncmp(names + one.st_name, "H5", 2) != 0)
        continue;
      if (hdf5_function_count == hdf5_functions.size()) _exit(98);
      hdf5_functions[hdf5_function_count++] = {base + one.st_value,
                                               base + one.st_value + one.st_size};
    }
  }
  munmap(mapped, static_cast<size_t>(size));
  std::sort(hdf5_functions.begin(), hdf5_functions.begin() + hdf5_function_count,
            [](const Range& a, const Range& b) { return a.begin < b.begin; });
}

bool in_hdf5(const void* place) {
  const auto end = hdf5_functions.begin() + hdf5_function_count;
  auto after =
      std::upper_bound(hdf5_functions.begin(), end, reinterpret_cast<uintptr_t>(place),
                       [](uintptr_t address, const Range& one) { return address < one.begin; });
  return after != hdf5_functions.begin() && (--after)->holds(place);
}

int find_exempt(dl_phdr_info* library, size_t, void*) {
  if (library->dlpi_name[0] == '\0' && hdf5_function_count == 0)
    find_hdf5_functions(library->dlpi_addr);
  const auto named = [&](const char* part) { return strstr(library->dlpi_name, part) != nullptr; };
  if (!named("libhdf5") && !named("libgomp") && !named("libomp") &&
      !(fftw_ends_process && named("libfftw3")))
    return 0;
  for (int i = 0; i < library->dlpi_phnum; ++i) {
    const auto& part = library->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    for (Range& range : exempt)
      if (range.end == 0) {
        range = {library->dlpi_addr + part.p_vaddr,
                 library->dlpi_addr + part.p_vaddr + part.p_memsz};
        break;
      }
  }
  return 0;
}

// Only the program itself is disturbed, not what it starts.
__attribute__((constructor)) void load_plan() {
  const char* file = getenv("SALEBRA_FAULTS");
  if (!file || strcmp(program_invocation_short_name, "salebra") != 0) return;
  const long descriptor = syscall(SYS_openat, AT_FDCWD, file, O_RDWR | O_CLOEXEC);
  if (descriptor < 0) _exit(98);
  void* mapped = mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE, MAP_SHARED,
                      static_cast<int>(descriptor), 0);
  syscall(SYS_close, descriptor);
  if (mapped == MAP_FAILED || !getcwd(working_folder.data(), working_folder.size())) _exit(98);
  dl_iterate_phdr(find_exempt, nullptr);
  plan = static_cast<Plan*>(mapped);
  pthread_atfork(nullptr, nullptr, [] { plan = nullptr; });
}

/// Counts the call; true where it has to fail, with errno set.
bool fails(Kind kind) {
  const long call = ++plan->calls[static_cast<size_t>(kind)];
  if (plan->first == 0 || kind != plan->kind || call < plan->first ||
      (call > plan->first && !plan->for_good))
    return false;
  ++plan->failed;
  if (plan->error == killed) kill(getpid(), SIGKILL);
  if (plan->error > 0) errno = plan->error;
  return true;
}

bool path_counts(const char* path) {
  if (!plan || !path) return false;
  const size_t length = strlen(plan->folder.data());
  const char* full = path[0] == '/' ? path : working_folder.data();
  return strncmp(full, plan->folder.data(), length) == 0 &&
         (full[length] == '\0' || full[length] == '/');
}

bool counts(int descriptor) {
  return plan && descriptor >= 0 && static_cast<size_t>(descriptor) < below.size() &&
         below[static_cast<size_t>(descriptor)];
}

void note(long descriptor, bool is_below) {
  if (descriptor >= 0 && static_cast<size_t>(descriptor) < below.size())
    below[static_cast<size_t>(descriptor)] = is_below;
}

int open_file(int folder, const char* path, int flags, mode_t mode) {
  const bool counted = path_counts(path);
  // The C++ library does not repeat the opening of a folder, which no signal interrupts on a local
  // disk.
  const bool folder_read = (flags & O_DIRECTORY) != 0 && plan && plan->error == EINTR;
  if (counted && !folder_read && fails(Kind::open)) return -1;
  const long descriptor = syscall(SYS_openat, folder, path, flags, mode);
  note(descriptor, counted);
  return static_cast<int>(descriptor);
}

/// Bytes of a write to let through; −1: it fails.
ssize_t granted(int descriptor, size_t size) {
  if (!counts(descriptor) || !fails(Kind::write)) return static_cast<ssize_t>(size);
  return plan->error == short_write ? static_cast<ssize_t>((size + 1) / 2) : -1;
}

bool allocation_fails(const void* caller) {
  if (!plan || !in_main) return false;
  for (const Range& range : exempt)
    if (range.holds(caller)) return false;
  if (in_hdf5(caller)) return false;
  if (!fails(Kind::memory)) return false;
  errno = ENOMEM;
  return true;
}

using Main = int (*)(int, char**, char**);
Main real_main;
int counted_main(int argc, char** argv, char** environment) {
  in_main = true;
  return real_main(argc, argv, environment);
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, Main init, void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  real_main = main;
  const auto real =
      reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return real(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}

// Dates are the same in every run.
time_t time(time_t* place) noexcept {
  constexpr time_t moment = 1750000000;
  if (place) *place = moment;
  return moment;
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_file(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) __attribute__((alias("open")));

int openat(int folder, const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_file(folder, path, flags, mode);
}
int openat64(int folder, const char* path, int flags, ...) __attribute__((alias("openat")));

FILE* fopen(const char* path, const char* mode) {
  const bool counted = path_counts(path);
  if (counted && fails(Kind::open)) return nullptr;
  static const auto real = reinterpret_cast<decltype(&fopen)>(dlsym(RTLD_NEXT, "fopen"));
  FILE* stream = real(path, mode);
  if (stream) note(fileno(stream), counted);
  return stream;
}
FILE* fopen64(const char* path, const char* mode) __attribute__((alias("fopen")));

int close(int descriptor) {
  const bool failed = counts(descriptor) && fails(Kind::close);
  const int error = errno;
  note(descriptor, false);
  const long status = syscall(SYS_close, descriptor);
  if (!failed) return static_cast<int>(status);
  errno = error;
  return -1;
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const ssize_t let = granted(descriptor, size);
  return let < 0 ? -1 : syscall(SYS_write, descriptor, bytes, let);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t place) {
  const ssize_t let = granted(descriptor, size);
  return let < 0 ? -1 : syscall(SYS_pwrite64, descriptor, bytes, let, place);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t place)
    __attribute__((alias("pwrite")));

ssize_t writev(int descriptor, const iovec* parts, int count) {
  const ssize_t let = granted(descriptor, count > 0 ? parts[0].iov_len : 0);
  if (let < 0) return -1;
  if (count > 0 && let < static_cast<ssize_t>(parts[0].iov_len))
    return syscall(SYS_write, descriptor, parts[0].iov_base, let);
  return syscall(SYS_writev, descriptor, parts, count);
}

ssize_t read(int descriptor, void* bytes, size_t size) {
  if (counts(descriptor) && fails(Kind::read)) return -1;
  return syscall(SYS_read, descriptor, bytes, size);
}

ssize_t pread(int descriptor, void* bytes, size_t size, off_t place) {
  if (counts(descriptor) && fails(Kind::read)) return -1;
  return syscall(SYS_pread64, descriptor, bytes, size, place);
}
ssize_t pread64(int descriptor, void* bytes, size_t size, off64_t place)
    __attribute__((alias("pread")));

int fsync(int descriptor) {
  if (counts(descriptor) && fails(Kind::sync)) return -1;
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

int fdatasync(int descriptor) {
  if (counts(descriptor) && fails(Kind::sync)) return -1;
  return static_cast<int>(syscall(SYS_fdatasync, descriptor));
}

int fallocate(int descriptor, int mode, off_t start, off_t size) {
  if (counts(descriptor) && fails(Kind::space)) return -1;
  return static_cast<int>(syscall(SYS_fallocate, descriptor, mode, start, size));
}

int posix_fallocate(int descriptor, off_t start, off_t size) {
  if (counts(descriptor) && fails(Kind::space)) return errno;
  return syscall(SYS_fallocate, descriptor, 0, start, size) == 0 ? 0 : errno;
}

int ftruncate(int descriptor, off_t size) noexcept {
  if (counts(descriptor) && fails(Kind::space)) return -1;
  return static_cast<int>(syscall(SYS_ftruncate, descriptor, size));
}

int rename(const char* from, const char* to) noexcept {
  if (path_counts(to) && fails(Kind::rename)) return -1;
  return static_cast<int>(syscall(SYS_rename, from, to));
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  if (path_counts(to) && fails(Kind::rename)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

int link(const char* from, const char* to) noexcept {
  if (path_counts(to) && fails(Kind::rename)) return -1;
  return static_cast<int>(syscall(SYS_link, from, to));
}

// Its first call, in which the C library allocates for it.
int H5open() {
  const bool before = in_main.exchange(false);
  static const auto real = reinterpret_cast<int (*)()>(dlsym(RTLD_NEXT, "H5open"));
  const int status = real();
  in_main = before;
  return status;
}

// The C library would allocate it in HDF5's place.
char* strdup(const char* text) noexcept {
  if (allocation_fails(__builtin_return_address(0))) return nullptr;
  const size_t size = strlen(text) + 1;
  return static_cast<char*>(memcpy(__libc_malloc(size), text, size));
}

void* malloc(size_t size) noexcept {
  return allocation_fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
}

void* calloc(size_t count, size_t size) noexcept {
  return allocation_fails(__builtin_return_address(0)) ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, size_t size) noexcept {
  return size > 0 && allocation_fails(__builtin_return_address(0)) ? nullptr
                                                                   : __libc_realloc(old, size);
}

void* memalign(size_t alignment, size_t size) noexcept {
  return allocation_fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(size_t alignment, size_t size) noexcept { return memalign(alignment, size); }

int posix_memalign(void** place, size_t alignment, size_t size) noexcept {
  void* bytes = memalign(alignment, size);
  if (!bytes) return ENOMEM;
  *place = bytes;
  return 0;
}

}  // extern "C"
