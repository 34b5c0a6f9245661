/* Simulates a disk whose nth call fails: replaces file functions of the C library in a program (LD_PRELOAD).

   MOTIONRACK_BAD_FOLDER  only calls on files in this folder are counted and can fail
   MOTIONRACK_BAD_CALL    "fail 12", "tear 12", "drop 12": fault of the 12th call; without it no call fails
   MOTIONRACK_BAD_WHILE   while this file exists, every call that changes files fails: a full disk
   MOTIONRACK_BAD_COUNT   file that receives the number of calls when the program ends

   Calls: open for writing, write, writev, pwrite, read, pread, ftruncate, fsync, fdatasync, rename. `fail`: the call
   does nothing and returns an error. `tear`: a write stores half of the bytes and returns an error; a read returns half
   of the requested bytes without an error. `drop`: a call that changes files does nothing and returns success. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum fault { none, fail, tear, drop };

static atomic_long calls;
static enum fault fault = none;
static long nth;
static const char *folder, *full;

__attribute__((constructor)) static void begin(void) {
    const char* plan = getenv("MOTIONRACK_BAD_CALL");
    folder = getenv("MOTIONRACK_BAD_FOLDER");
    full = getenv("MOTIONRACK_BAD_WHILE");
    if (plan == NULL || strlen(plan) < 6) return;
    fault = strncmp(plan, "fail", 4) == 0 ? fail : strncmp(plan, "tear", 4) == 0 ? tear : drop;
    nth = atol(plan + 5);
}

__attribute__((destructor)) static void end(void) {
    const char* path = getenv("MOTIONRACK_BAD_COUNT");
    if (path == NULL) return;
    char text[32];
    const int size = snprintf(text, sizeof text, "%ld\n", (long)calls);
    const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0) return;
    syscall(SYS_write, file, text, (size_t)size);
    close(file);
}

static int is_meant(const char* path) {
    return folder != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static enum fault next_call(int changes) {
    if (changes && full != NULL && syscall(SYS_faccessat, AT_FDCWD, full, F_OK) == 0) return fail;
    return atomic_fetch_add(&calls, 1) + 1 == nth ? fault : none;
}

/* Returns the fault of a call on an open file, and counts the call. */
static enum fault on_file(int file, int changes) {
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t size = readlink(link, path, sizeof path - 1);
    if (size <= 0) return none;
    path[size] = '\0';
    if (!is_meant(path)) return none;
    const enum fault what = next_call(changes);
    /* The -shm file of a journal is memory shared by processes, so a disk cannot lose its content. */
    return what == drop && size > 4 && strcmp(path + size - 4, "-shm") == 0 ? none : what;
}

ssize_t write(int file, const void* bytes, size_t count) {
    switch (on_file(file, 1)) {
        case none:
            return syscall(SYS_write, file, bytes, count);
        case drop:
            return (ssize_t)count;
        case tear:
            syscall(SYS_write, file, bytes, count / 2);
            break;
        case fail:
            break;
    }
    errno = ENOSPC;
    return -1;
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
    switch (on_file(file, 1)) {
        case none:
            return syscall(SYS_pwrite64, file, bytes, count, at);
        case drop:
            return (ssize_t)count;
        case tear:
            syscall(SYS_pwrite64, file, bytes, count / 2, at);
            break;
        case fail:
            break;
    }
    errno = ENOSPC;
    return -1;
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
    return pwrite64(file, bytes, count, at);
}

/* The C++ library uses writev to write a long text together with its buffer. */
ssize_t writev(int file, const struct iovec* parts, int count) {
    size_t size = 0;
    for (int i = 0; i < count; ++i) size += parts[i].iov_len;
    switch (on_file(file, 1)) {
        case none:
            return syscall(SYS_writev, file, parts, count);
        case drop:
            return (ssize_t)size;
        case tear:
            syscall(SYS_writev, file, parts, count / 2);
            break;
        case fail:
            break;
    }
    errno = ENOSPC;
    return -1;
}

/* Returns the number of bytes to read: half of `count` for `tear`. A short read is not an error. */
static size_t less(enum fault what, size_t count) {
    return what == tear && count > 1 ? count / 2 : count;
}

ssize_t read(int file, void* bytes, size_t count) {
    const enum fault what = on_file(file, 0);
    if (what != fail) return syscall(SYS_read, file, bytes, less(what, count));
    errno = EIO;
    return -1;
}

ssize_t pread64(int file, void* bytes, size_t count, off64_t at) {
    const enum fault what = on_file(file, 0);
    if (what != fail) return syscall(SYS_pread64, file, bytes, less(what, count), at);
    errno = EIO;
    return -1;
}
ssize_t pread(int file, void* bytes, size_t count, off_t at) {
    return pread64(file, bytes, count, at);
}

static int open_file(const char* path, int flags, mode_t mode) {
    char whole[4096], cut[4096];
    if ((flags & O_ACCMODE) != O_RDONLY && strlen(path) < sizeof cut) {
        /* The file may not exist yet, so the path of its folder is resolved. */
        strcpy(cut, path);
        char* const slash = strrchr(cut, '/');
        if (slash != NULL) *slash = '\0';
        const char* const parent = realpath(slash == NULL ? "." : cut, whole);
        const size_t size = parent == NULL ? 0 : strlen(parent);
        if (parent != NULL && size + 2 < sizeof whole) {
            strcpy(whole + size, "/");
            const enum fault what = is_meant(whole) ? next_call(1) : none;
            if (what == fail || what == tear) {
                errno = ENOSPC;
                return -1;
            }
        }
    }
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_file(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_file(path, flags | O_LARGEFILE, mode);
}

/* Executes a call that cannot be done in part: `tear` acts as `fail`. */
static int instead(enum fault what, long number, long first, long second) {
    if (what == none) return (int)syscall(number, first, second);
    if (what == drop) return 0;
    errno = EIO;
    return -1;
}

int ftruncate64(int file, off64_t size) {
    return instead(on_file(file, 1), SYS_ftruncate, file, size);
}
int ftruncate(int file, off_t size) {
    return ftruncate64(file, size);
}
/* Returns success without a sync of the real disk, which would be slow; these tests simulate no power loss. */
int fsync(int file) {
    const enum fault what = on_file(file, 1);
    if (what == none || what == drop) return 0;
    errno = EIO;
    return -1;
}
int fdatasync(int file) {
    return fsync(file);
}
int rename(const char* from, const char* to) {
    char whole[4096];
    const char* path = realpath(from, whole);
    return instead(path != NULL && is_meant(path) ? next_call(1) : none, SYS_rename, (long)from, (long)to);
}
