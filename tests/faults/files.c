// Calls that make, fill, name and remove files.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "plan.h"

static bool creates(int flags) { return (flags & O_CREAT) || (flags & O_TMPFILE) == O_TMPFILE; }

static bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY || creates(flags); }

static mode_t mode_of(int flags, va_list rest) { return creates(flags) ? va_arg(rest, mode_t) : 0; }

// Of what this process has written and nobody else has seen.
static bool is_own(const char* path) { return strstr(path, "strata-") || strstr(path, "/proc/self/fd/"); }

static int fault_of_opening(const char* path, int flags) {
    if (writes(flags)) return fault_of(kind_open, path);
    return is_own(path) && !(flags & (O_DIRECTORY | O_PATH)) ? fault_of(kind_read, path) : 0;
}

#define DEFINE_OPEN(name)                           \
    DECLARE_REAL(name)                              \
    int name(const char* path, int flags, ...) {    \
        va_list rest;                               \
        va_start(rest, flags);                      \
        const mode_t mode = mode_of(flags, rest);   \
        va_end(rest);                               \
        FAIL_IF(fault_of_opening(path, flags), -1); \
        return REAL(name)()(path, flags, mode);     \
    }

#define DEFINE_OPENAT(name)                                  \
    DECLARE_REAL(name)                                       \
    int name(int folder, const char* path, int flags, ...) { \
        va_list rest;                                        \
        va_start(rest, flags);                               \
        const mode_t mode = mode_of(flags, rest);            \
        va_end(rest);                                        \
        FAIL_IF(fault_of_opening(path, flags), -1);          \
        return REAL(name)()(folder, path, flags, mode);      \
    }

#define DEFINE_FOPEN(name)                                                        \
    DECLARE_REAL(name)                                                            \
    FILE* name(const char* path, const char* mode) {                              \
        FAIL_IF(fault_of_opening(path, strpbrk(mode, "wa+") ? O_RDWR : 0), NULL); \
        return REAL(name)()(path, mode);                                          \
    }

DEFINE_OPEN(open)
DEFINE_OPEN(open64)
DEFINE_OPENAT(openat)
DEFINE_OPENAT(openat64)
DEFINE_FOPEN(fopen)
DEFINE_FOPEN(fopen64)

DECLARE_REAL(mkstemp)
int mkstemp(char* pattern) {
    FAIL_IF(fault_of(kind_open, pattern), -1);
    return REAL(mkstemp)()(pattern);
}

static int fault_of_read(int descriptor) {
    char path[512];
    path_of(descriptor, path, sizeof path);
    return is_own(path) || strstr(path, "(deleted)") ? fault_of(kind_read, path) : 0;
}

DECLARE_REAL(read)
ssize_t read(int descriptor, void* bytes, size_t count) {
    FAIL_IF(fault_of_read(descriptor), -1);
    return REAL(read)()(descriptor, bytes, count);
}

#define DEFINE_PREAD(name, offset_type)                                       \
    DECLARE_REAL(name)                                                        \
    ssize_t name(int descriptor, void* bytes, size_t count, offset_type at) { \
        FAIL_IF(fault_of_read(descriptor), -1);                               \
        return REAL(name)()(descriptor, bytes, count, at);                    \
    }

DEFINE_PREAD(pread, off_t)
DEFINE_PREAD(pread64, off64_t)

// How many of the bytes are to be written. Standard streams tell what happened, and are left alone.
static int fault_of_write(int descriptor, size_t* count) {
    if (descriptor <= STDERR_FILENO) return 0;
    const int error = fault_of_descriptor(kind_write, descriptor);
    if (error == kShort && *count > 1) *count /= 2;
    return error;
}

DECLARE_REAL(write)
ssize_t write(int descriptor, const void* bytes, size_t count) {
    FAIL_IF(fault_of_write(descriptor, &count), -1);
    return REAL(write)()(descriptor, bytes, count);
}

#define DEFINE_PWRITE(name, offset_type)                                            \
    DECLARE_REAL(name)                                                              \
    ssize_t name(int descriptor, const void* bytes, size_t count, offset_type at) { \
        FAIL_IF(fault_of_write(descriptor, &count), -1);                            \
        return REAL(name)()(descriptor, bytes, count, at);                          \
    }

DEFINE_PWRITE(pwrite, off_t)
DEFINE_PWRITE(pwrite64, off64_t)

DECLARE_REAL(writev)
ssize_t writev(int descriptor, const struct iovec* parts, int count) {
    size_t all = 2;
    const int error = fault_of_write(descriptor, &all);
    FAIL_IF(error, -1);
    return REAL(writev)()(descriptor, parts, error == kShort ? 1 : count);
}

DECLARE_REAL(fwrite)
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* stream) {
    FAIL_IF(fault_of_write(fileno(stream), &count), 0);
    return REAL(fwrite)()(bytes, size, count, stream);
}

#define DEFINE_ON_DESCRIPTOR(name, kind)                    \
    DECLARE_REAL(name)                                      \
    int name(int descriptor) {                              \
        FAIL_IF(fault_of_descriptor(kind, descriptor), -1); \
        return REAL(name)()(descriptor);                    \
    }

#define DEFINE_SYNC(name)                                         \
    DECLARE_REAL(name)                                            \
    int name(int descriptor) {                                    \
        FAIL_IF(fault_of_descriptor(kind_fsync, descriptor), -1); \
        const int result = REAL(name)()(descriptor);              \
        if (result == 0) note_synced(descriptor);                 \
        return result;                                            \
    }

DEFINE_SYNC(fsync)
DEFINE_SYNC(fdatasync)

#define DEFINE_TRUNCATE(name, offset_type)                           \
    DECLARE_REAL(name)                                               \
    int name(int descriptor, offset_type length) {                   \
        FAIL_IF(fault_of_descriptor(kind_truncate, descriptor), -1); \
        return REAL(name)()(descriptor, length);                     \
    }

#define DEFINE_ALLOCATE(name, offset_type)                                       \
    DECLARE_REAL(name)                                                           \
    int name(int descriptor, int mode, offset_type offset, offset_type length) { \
        FAIL_IF(fault_of_descriptor(kind_truncate, descriptor), -1);             \
        return REAL(name)()(descriptor, mode, offset, length);                   \
    }

// These return what others put into errno.
#define DEFINE_POSIX_ALLOCATE(name, offset_type)                             \
    DECLARE_REAL(name)                                                       \
    int name(int descriptor, offset_type offset, offset_type length) {       \
        const int error = fault_of_descriptor(kind_truncate, descriptor);    \
        return error > 0 ? error : REAL(name)()(descriptor, offset, length); \
    }

DEFINE_TRUNCATE(ftruncate, off_t)
DEFINE_TRUNCATE(ftruncate64, off64_t)
DEFINE_ALLOCATE(fallocate, off_t)
DEFINE_ALLOCATE(fallocate64, off64_t)
DEFINE_POSIX_ALLOCATE(posix_fallocate, off_t)
DEFINE_POSIX_ALLOCATE(posix_fallocate64, off64_t)

static bool is_written_file(int descriptor) {
    const int interrupted_errno = errno;
    struct stat status;
    const int flags = fcntl(descriptor, F_GETFL);
    const bool is_one =
        flags >= 0 && writes(flags & O_ACCMODE) && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    errno = interrupted_errno;
    return is_one;
}

// Closed all the same, as by the kernel.
DECLARE_REAL(close)
int close(int descriptor) {
    const int error = is_written_file(descriptor) ? fault_of_descriptor(kind_close, descriptor) : 0;
    const int result = REAL(close)()(descriptor);
    FAIL_IF(error, -1);
    return result;
}

DECLARE_REAL(fclose)
int fclose(FILE* stream) {
    const int descriptor = fileno(stream);
    const int error = is_written_file(descriptor) ? fault_of_descriptor(kind_close, descriptor) : 0;
    const int result = REAL(fclose)()(stream);
    FAIL_IF(error, EOF);
    return result;
}

#define DEFINE_ON_PATH(name, kind)         \
    DECLARE_REAL(name)                     \
    int name(const char* path) {           \
        FAIL_IF(fault_of(kind, path), -1); \
        return REAL(name)()(path);         \
    }

#define DEFINE_ON_TWO_PATHS(name, kind)          \
    DECLARE_REAL(name)                           \
    int name(const char* from, const char* to) { \
        FAIL_IF(fault_of(kind, to), -1);         \
        return REAL(name)()(from, to);           \
    }

DEFINE_ON_PATH(unlink, kind_unlink)
DEFINE_ON_PATH(rmdir, kind_unlink)
DEFINE_ON_PATH(remove, kind_unlink)
DEFINE_ON_TWO_PATHS(rename, kind_rename)
DEFINE_ON_TWO_PATHS(link, kind_link)
DEFINE_ON_TWO_PATHS(symlink, kind_link)

DECLARE_REAL(unlinkat)
int unlinkat(int folder, const char* path, int flags) {
    FAIL_IF(fault_of(kind_unlink, path), -1);
    return REAL(unlinkat)()(folder, path, flags);
}

DECLARE_REAL(renameat)
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
    FAIL_IF(fault_of(kind_rename, to), -1);
    return REAL(renameat)()(from_folder, from, to_folder, to);
}

DECLARE_REAL(renameat2)
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    FAIL_IF(fault_of(kind_rename, to), -1);
    return REAL(renameat2)()(from_folder, from, to_folder, to, flags);
}

DECLARE_REAL(linkat)
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    FAIL_IF(fault_of(kind_link, to), -1);
    return REAL(linkat)()(from_folder, from, to_folder, to, flags);
}

DECLARE_REAL(mkdir)
int mkdir(const char* path, mode_t mode) {
    FAIL_IF(fault_of(kind_mkdir, path), -1);
    return REAL(mkdir)()(path, mode);
}

DECLARE_REAL(mkdirat)
int mkdirat(int folder, const char* path, mode_t mode) {
    FAIL_IF(fault_of(kind_mkdir, path), -1);
    return REAL(mkdirat)()(folder, path, mode);
}

DECLARE_REAL(mkdtemp)
char* mkdtemp(char* pattern) {
    FAIL_IF(fault_of(kind_mkdir, pattern), NULL);
    return REAL(mkdtemp)()(pattern);
}
