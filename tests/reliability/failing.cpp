// A library that makes calls of a program fail, for tests/reliability/failures (LD_PRELOAD):
//   FAIL_KIND=write|open|sync|rename|memory  FAIL_AT=N (from 1; 0: none)  FAIL_ALL=1 (and all after it)
//   FAIL_UNDER=FOLDER  FAIL_COUNT=FILE
// Files: only those below FAIL_UNDER; errno is ENOSPC. Memory: malloc and its kin, from where main calls mallopt:
// nobody can catch what fails before main. At the end, the number of calls of the kind goes into FAIL_COUNT.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> count;
long at;
bool all_after, ready, settled;
char kind, under[PATH_MAX];

long number(const char* name) {
  const char* const text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

[[gnu::constructor]] void begin() {
  if (const char* const text = std::getenv("FAIL_KIND")) kind = text[0];
  if (const char* const folder = std::getenv("FAIL_UNDER")) std::snprintf(under, sizeof under, "%s", folder);
  at = number("FAIL_AT"), all_after = number("FAIL_ALL") != 0;
  ready = true;
}

[[gnu::destructor]] void end() {
  ready = false;
  const char* const name = std::getenv("FAIL_COUNT");
  const int file = name ? open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
  if (file >= 0) dprintf(file, "%ld\n", count.load());
  if (file >= 0) close(file);
}

/// Is this call the one that fails?
bool fails(char of) {
  if (!ready || kind != of) return false;
  const long which = ++count;
  return at > 0 && (which == at || (all_after && which > at));
}

bool below(const char* path) {
  return ready && under[0] && path && std::strncmp(path, under, std::strlen(under)) == 0;
}

bool below(int file) {
  char link[64], path[PATH_MAX];
  if (!ready || !under[0]) return false;
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const auto length = readlink(link, path, sizeof path - 1);
  if (length < 0) return false;
  path[length] = 0;
  return below(path);
}

int no_space() {
  errno = ENOSPC;
  return -1;
}

void* no_memory() {
  errno = ENOMEM;
  return nullptr;
}

bool no_more_memory() {
  return settled && fails('m');
}

/// The function of this name in the library that has it.
template <typename Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#define NEXT(name) static const auto real = next(&name, #name)

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
  NEXT(write);
  return below(file) && fails('w') ? no_space() : real(file, data, size);
}
ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  NEXT(pwrite);
  return below(file) && fails('w') ? no_space() : real(file, data, size, offset);
}
ssize_t pwrite64(int file, const void* data, size_t size, off64_t offset) {
  NEXT(pwrite64);
  return below(file) && fails('w') ? no_space() : real(file, data, size, offset);
}
ssize_t writev(int file, const iovec* parts, int many) {
  NEXT(writev);
  return below(file) && fails('w') ? no_space() : real(file, parts, many);
}
int ftruncate64(int file, off64_t length) noexcept {
  NEXT(ftruncate64);
  return below(file) && fails('w') ? no_space() : real(file, length);
}
int fsync(int file) {
  NEXT(fsync);
  return below(file) && fails('s') ? no_space() : real(file);
}
int rename(const char* from, const char* to) noexcept {
  NEXT(rename);
  return below(to) && fails('r') ? no_space() : real(from, to);
}

#define OPENS(name)                                                                    \
  int name(const char* path, int flags, ...) {                                         \
    NEXT(name);                                                                        \
    va_list rest;                                                                      \
    va_start(rest, flags);                                                             \
    const int mode = va_arg(rest, int);                                                \
    va_end(rest);                                                                      \
    const bool writes = (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;                  \
    return writes && below(path) && fails('o') ? no_space() : real(path, flags, mode); \
  }
OPENS(open)
OPENS(open64)

#define FILE_OPENS(name)                                                        \
  FILE* name(const char* path, const char* mode) {                              \
    NEXT(name);                                                                 \
    if (mode[0] == 'r' || !below(path) || !fails('o')) return real(path, mode); \
    no_space();                                                                 \
    return nullptr;                                                             \
  }
FILE_OPENS(fopen)
FILE_OPENS(fopen64)

int mallopt(int parameter, int value) noexcept {
  static const auto real = reinterpret_cast<int (*)(int, int)>(dlsym(RTLD_NEXT, "mallopt"));
  settled = true;
  return real(parameter, value);
}

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void* malloc(size_t size) noexcept {
  return no_more_memory() ? no_memory() : __libc_malloc(size);
}
void* calloc(size_t many, size_t size) noexcept {
  return no_more_memory() ? no_memory() : __libc_calloc(many, size);
}
void* realloc(void* old, size_t size) noexcept {
  return no_more_memory() ? no_memory() : __libc_realloc(old, size);
}
void* aligned_alloc(size_t alignment, size_t size) noexcept {
  return no_more_memory() ? no_memory() : __libc_memalign(alignment, size);
}
int posix_memalign(void** where, size_t alignment, size_t size) noexcept {
  *where = no_more_memory() ? nullptr : __libc_memalign(alignment, size);
  return *where ? 0 : ENOMEM;
}
}
