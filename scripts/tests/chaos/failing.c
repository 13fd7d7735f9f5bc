/*
 * Lets one call fail that creates, writes, renames, deletes or syncs a file, or that starts a program. LD_PRELOAD loads this library into a command and all
 * of its processes.
 *
 * The environment variable FAILING_CALLS names a file of 8 bytes, which counts these calls in all processes. The call with the number FAILING_AT fails with
 * EIO, or with EAGAIN if it is a fork. Calls on files count only below FAILING_BELOW, which is a list of absolute paths with ':' between them.
 *
 * If FAILING_SYNCS names a file, the path of each synced file or folder is appended to it.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

static _Atomic long *count;
static long failing;
static const char *below;

__attribute__((constructor)) static void start(void)
{
    const char *path = getenv("FAILING_CALLS"), *at = getenv("FAILING_AT");
    below = getenv("FAILING_BELOW");
    int file = path != NULL && at != NULL && below != NULL ? open(path, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0)
        return;
    void *memory = mmap(NULL, sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (memory == MAP_FAILED)
        return;
    failing = atol(at);
    count = memory;
}

/* Counts this call, and returns whether it fails. If so, sets errno. */
static bool fails(int error)
{
    if (count == NULL || atomic_fetch_add(count, 1) + 1 != failing)
        return false;
    errno = error;
    return true;
}

static bool is_below(const char *path)
{
    for (const char *root = below; root != NULL && *root != 0; root += root[0] == ':') {
        size_t length = strcspn(root, ":");
        if (strncmp(path, root, length) == 0 && (path[length] == '/' || path[length] == 0))
            return true;
        root += length;
    }
    return false;
}

static bool fails_of(int descriptor)
{
    char link[32], path[PATH_MAX];
    if (count == NULL)
        return false;
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0)
        return false;
    path[length] = 0;
    return is_below(path) && fails(EIO);
}

static bool sync_fails(int descriptor)
{
    char link[32], path[PATH_MAX];
    const char *log = getenv("FAILING_SYNCS");
    /* These system calls are direct, because calls of libc may fail here and count. */
    int file = log != NULL ? (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_APPEND | O_CLOEXEC) : -1;
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    ssize_t length = file >= 0 ? readlink(link, path, sizeof path - 1) : -1;
    if (length > 0) {
        path[length] = '\n';
        syscall(SYS_write, file, path, (size_t)length + 1);
    }
    if (file >= 0)
        close(file);
    return fails_of(descriptor);
}

static bool fails_at(int folder, const char *name)
{
    char link[32], path[2 * PATH_MAX];
    if (count == NULL)
        return false;
    if (name[0] == '/')
        return is_below(name) && fails(EIO);
    snprintf(link, sizeof link, folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/%d", folder);
    ssize_t length = readlink(link, path, PATH_MAX);
    if (length < 0)
        return false;
    snprintf(path + length, sizeof path - (size_t)length, "/%s", name);
    return is_below(path) && fails(EIO);
}

/* The function of libc that is called if the call does not fail. */
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define FILE_CALL(type, name, parameters, arguments, condition)                                                                                        \
    type name parameters                                                                                                                               \
    {                                                                                                                                                  \
        return (condition) ? -1 : NEXT(name) arguments;                                                                                                \
    }

FILE_CALL(ssize_t, write, (int file, const void *data, size_t size), (file, data, size), fails_of(file))
FILE_CALL(ssize_t, pwrite, (int file, const void *data, size_t size, off_t at), (file, data, size, at), fails_of(file))
FILE_CALL(ssize_t, pwrite64, (int file, const void *data, size_t size, off64_t at), (file, data, size, at), fails_of(file))
FILE_CALL(ssize_t, sendfile, (int to, int from, off_t *at, size_t size), (to, from, at, size), fails_of(to))
FILE_CALL(ssize_t, sendfile64, (int to, int from, off64_t *at, size_t size), (to, from, at, size), fails_of(to))
FILE_CALL(int, fsync, (int file), (file), sync_fails(file))
FILE_CALL(int, fdatasync, (int file), (file), fails_of(file))
FILE_CALL(int, ftruncate, (int file, off_t size), (file, size), fails_of(file))
FILE_CALL(int, ftruncate64, (int file, off64_t size), (file, size), fails_of(file))
FILE_CALL(int, rename, (const char *from, const char *to), (from, to), fails_at(AT_FDCWD, to))
FILE_CALL(int, renameat, (int in, const char *from, int out, const char *to), (in, from, out, to), fails_at(out, to))
FILE_CALL(int, mkdir, (const char *path, mode_t mode), (path, mode), fails_at(AT_FDCWD, path))
FILE_CALL(int, rmdir, (const char *path), (path), fails_at(AT_FDCWD, path))
FILE_CALL(int, unlink, (const char *path), (path), fails_at(AT_FDCWD, path))
FILE_CALL(int, unlinkat, (int folder, const char *path, int flags), (folder, path, flags), fails_at(folder, path))
FILE_CALL(int, symlink, (const char *target, const char *path), (target, path), fails_at(AT_FDCWD, path))

/* Mono looks up the functions of Mono.Unix.Native.Syscall in libc itself, which would bypass this library. */
void *dlsym(void *handle, const char *name)
{
    static void *(*next)(void *, const char *);
    if (next == NULL)
        next = (__typeof__(next))dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.34");
    if (handle != RTLD_NEXT && strcmp(name, "fsync") == 0)
        return (void *)fsync;
    if (handle != RTLD_NEXT && strcmp(name, "renameat") == 0)
        return (void *)renameat;
    return next(handle, name);
}

#define WRITES (O_WRONLY | O_RDWR | O_CREAT)
#define OPEN_CALL(name, parameters, folder, before)                                                                                                    \
    int name parameters                                                                                                                                \
    {                                                                                                                                                  \
        va_list rest;                                                                                                                                  \
        va_start(rest, flags);                                                                                                                         \
        mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;                                                                 \
        va_end(rest);                                                                                                                                  \
        return (flags & WRITES) != 0 && fails_at(folder, path) ? -1 : NEXT(name)(before path, flags, mode);                                            \
    }
#define NOTHING
#define FOLDER folder,

OPEN_CALL(open, (const char *path, int flags, ...), AT_FDCWD, NOTHING)
OPEN_CALL(open64, (const char *path, int flags, ...), AT_FDCWD, NOTHING)
OPEN_CALL(openat, (int folder, const char *path, int flags, ...), folder, FOLDER)
OPEN_CALL(openat64, (int folder, const char *path, int flags, ...), folder, FOLDER)

FILE *fopen(const char *path, const char *mode)
{
    return mode[0] != 'r' && fails_at(AT_FDCWD, path) ? NULL : NEXT(fopen)(path, mode);
}

FILE *fopen64(const char *path, const char *mode)
{
    return mode[0] != 'r' && fails_at(AT_FDCWD, path) ? NULL : NEXT(fopen64)(path, mode);
}

pid_t fork(void)
{
    return fails(EAGAIN) ? -1 : NEXT(fork)();
}

/* Python calls this for each folder of PATH. Only the call for the folder that contains the program counts. */
int execve(const char *path, char *const *words, char *const *environment)
{
    return access(path, X_OK) == 0 && fails(EIO) ? -1 : NEXT(execve)(path, words, environment);
}

int posix_spawn(pid_t *child, const char *path, const posix_spawn_file_actions_t *actions, const posix_spawnattr_t *attributes, char *const *words,
                char *const *environment)
{
    return fails(EIO) ? errno : NEXT(posix_spawn)(child, path, actions, attributes, words, environment);
}

int posix_spawnp(pid_t *child, const char *path, const posix_spawn_file_actions_t *actions, const posix_spawnattr_t *attributes, char *const *words,
                 char *const *environment)
{
    return fails(EIO) ? errno : NEXT(posix_spawnp)(child, path, actions, attributes, words, environment);
}
