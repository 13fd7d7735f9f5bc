#define _GNU_SOURCE      /* pthread_setname_np, pipe2 */
#define _DARWIN_C_SOURCE /* the same on macOS */
#include "prim.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <langinfo.h>
#include <locale.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#if defined(__APPLE__)
#include <crt_externs.h>
#include <xlocale.h>
#define CLOSE_ON_EXEC 0 /* macOS sets it in move_up; a process that another thread spawns before that delays the end of the output */
#define make_pipe(ends) pipe(ends)
#define environ (*_NSGetEnviron())
#else
#include <linux/memfd.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#define CLOSE_ON_EXEC SOCK_CLOEXEC
#define make_pipe(ends) pipe2(ends, O_CLOEXEC)
extern char **environ;
#endif

/* ---- Time ------------------------------------------------------------------------------------------------------------ */

#define NANOS_PER_SECOND INT64_C(1000000000)

int64_t prim_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * NANOS_PER_SECOND + now.tv_nsec;
}

/* ---- Locks ----------------------------------------------------------------------------------------------------------- */

void prim_lock(prim_mutex *mutex) { pthread_mutex_lock(mutex); }

void prim_unlock(prim_mutex *mutex) { pthread_mutex_unlock(mutex); }

/* ---- Threads --------------------------------------------------------------------------------------------------------- */

struct thread_start {
    void (*body)(void);
    const char *name;
};

static void *thread_main(void *argument) {
    struct thread_start start = *(struct thread_start *)argument;
    free(argument);
#if defined(__APPLE__)
    pthread_setname_np(start.name);
#else
    pthread_setname_np(pthread_self(), start.name);
#endif
    start.body();
    return NULL;
}

bool prim_thread_start(void (*body)(void), const char *name, size_t stack_bytes) {
    struct thread_start *start = malloc(sizeof *start);
    pthread_attr_t attributes;
    pthread_t thread;
    bool started = false;
    if (start == NULL) return false;
    *start = (struct thread_start){body, name};
    if (pthread_attr_init(&attributes) == 0) {
        started = pthread_attr_setstacksize(&attributes, stack_bytes) == 0 &&
                  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED) == 0 &&
                  pthread_create(&thread, &attributes, thread_main, start) == 0;
        pthread_attr_destroy(&attributes);
    }
    if (!started) free(start);
    return started;
}

void prim_yield(void) { sched_yield(); }

_Noreturn void prim_park(void) {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, NULL);
    for (;;) pause();
}

void prim_at_fork(void (*child)(void)) { pthread_atfork(NULL, NULL, child); }

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

void *prim_allocate(size_t bytes) {
    void *memory;
    return posix_memalign(&memory, 64, bytes) == 0 ? memory : NULL;
}

void prim_free(void *memory) { free(memory); }

/* The smallest number of descriptors that a child receives. The child receives them as 1 to 4, so with smaller numbers one could overwrite another. */
#define FIRST_DESCRIPTOR 10

static int move_up(int descriptor) {
    int moved = descriptor < 0 ? -1 : fcntl(descriptor, F_DUPFD_CLOEXEC, FIRST_DESCRIPTOR);
    if (descriptor >= 0) close(descriptor);
    return moved;
}

static int shared = -1; /* the memory that children map */

static uint8_t *map_shared(int memory) {
    void *address = mmap(NULL, PRIM_SHARED_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, memory, 0);
    return address == MAP_FAILED ? NULL : address;
}

static int make_shared(void) {
#if defined(__APPLE__)
    char name[32]; /* exists until shm_unlink; only this user may open it */
    snprintf(name, sizeof name, "/clk-%d-%llx", getpid(), (unsigned long long)prim_now());
    int memory = shm_open(name, O_RDWR | O_CREAT | O_EXCL, 0600);
    if (memory >= 0) shm_unlink(name);
    return move_up(memory);
#else
    return move_up((int)syscall(SYS_memfd_create, "collektive", MFD_CLOEXEC)); /* glibc before 2.27 lacks memfd_create() */
#endif
}

uint8_t *prim_shared_reserve(char *why, size_t why_size) {
    static uint8_t *address;
    struct rlimit limit;
    if (address != NULL) return address;
    shared = make_shared();
    /* If the size exceeded this limit, ftruncate would end the process by SIGXFSZ. */
    if (shared >= 0 && getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < PRIM_SHARED_BYTES) {
        errno = EFBIG;
    } else if (shared >= 0 && ftruncate(shared, (off_t)PRIM_SHARED_BYTES) == 0) {
        address = map_shared(shared);
    }
    if (address != NULL) return address;
    snprintf(why, why_size, "%s", strerror(errno));
    if (shared >= 0) close(shared);
    shared = -1;
    return NULL;
}

/* macOS commits a page at its first access and cannot return it. */
bool prim_shared_commit(uint64_t offset, uint64_t bytes, bool committed) {
#if defined(__APPLE__)
    return committed && offset + bytes <= PRIM_SHARED_BYTES;
#else
    return fallocate(shared, committed ? 0 : FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, (off_t)offset, (off_t)bytes) == 0;
#endif
}

/* ---- Files and libraries --------------------------------------------------------------------------------------------- */

enum prim_file prim_file_kind(const char *path) {
    struct stat status;
    if (stat(path, &status) != 0) return errno == EACCES ? PRIM_UNREADABLE : PRIM_MISSING;
    if (access(path, R_OK) != 0) return PRIM_UNREADABLE;
    return S_ISDIR(status.st_mode) ? PRIM_DIRECTORY : PRIM_FILE;
}

bool prim_executable(const char *path) { return prim_file_kind(path) == PRIM_FILE && access(path, X_OK) == 0; }

#define LOCK_POLL_MS 5

/* Copies the folder of a path, with a slash. False if the path has no folder or is too long. */
static bool folder_of(const char *file, char *folder, size_t size) {
    const char *end = strrchr(file, '/');
    if (end == NULL || (size_t)(end - file) + 2 > size) return false;
    snprintf(folder, size, "%.*s/", (int)(end - file), file);
    return true;
}

int64_t prim_disk_free(const char *file) {
    char folder[4096];
    struct statvfs disk;
    if (!folder_of(file, folder, sizeof folder) || statvfs(folder, &disk) != 0) return INT64_MAX;
    return (int64_t)disk.f_bavail * (int64_t)disk.f_frsize;
}

int prim_folder_lock(const char *file, int64_t deadline) {
    char folder[4096];
    if (!folder_of(file, folder, sizeof folder)) return -1;
    int lock = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock < 0) return -1;
    while (flock(lock, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK || prim_now() >= deadline) {
            close(lock);
            return -1;
        }
        poll(NULL, 0, LOCK_POLL_MS);
    }
    return lock;
}

void prim_folder_unlock(int lock) { close(lock); }

FILE *prim_file_read(const char *path) { return fopen(path, "r"); }

/* On macOS the JVM always uses UTF-8. */
static bool locale_is_utf8(void) {
#if defined(__APPLE__)
    return true;
#else
    locale_t locale = newlocale(LC_CTYPE_MASK, "", (locale_t)0);
    if (locale == (locale_t)0) return false;
    bool is_utf8 = strcmp(nl_langinfo_l(CODESET, locale), "UTF-8") == 0;
    freelocale(locale);
    return is_utf8;
#endif
}

bool prim_jvm_can_decode(const char *text) {
    for (const char *at = text; *at != '\0'; at++) {
        if ((unsigned char)*at >= 0x80) return locale_is_utf8();
    }
    return true;
}

char *prim_jvm_text(const char *text) { return strdup(text); }

void *prim_library_open(const char *path, char *why, size_t why_size) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        const char *reason = dlerror();
        snprintf(why, why_size, "%s", reason != NULL ? reason : "no reason given");
    }
    return library;
}

void *prim_library_symbol(void *library, const char *name) { return dlsym(library, name); }

bool prim_library_path(char *path, size_t size) {
    Dl_info info;
    char full[4096];
    if (dladdr(&shared, &info) == 0 || realpath(info.dli_fname, full) == NULL) return false;
    return (size_t)snprintf(path, size, "%s", full) < size;
}

/* ---- Environment and processes --------------------------------------------------------------------------------------- */

/* A hidden variable is replaced by this entry. unsetenv and setenv are not used, because they could move or free the array while other threads read
 * it. */
static char hidden_entry[] = "COLLEKTIVE_HIDDEN=";

static bool swap_environment(const char *from, size_t from_length, char *to, char **previous) {
    for (char **entry = environ; entry != NULL && *entry != NULL; entry++) {
        if (strncmp(*entry, from, from_length) == 0) {
            *previous = *entry;
            *entry = to;
            return true;
        }
    }
    return false;
}

bool prim_environment_hide(const char *name, char **hidden) {
    char prefix[64];
    int length = snprintf(prefix, sizeof prefix, "%s=", name);
    return swap_environment(prefix, (size_t)length, hidden_entry, hidden);
}

void prim_environment_show(char *hidden) {
    char *placeholder;
    swap_environment(hidden_entry, sizeof hidden_entry - 1, hidden, &placeholder);
}

/* Milliseconds until the deadline, rounded up, for poll. */
static int poll_limit(int64_t deadline) {
    int64_t left = (deadline - prim_now() + PRIM_MILLI - 1) / PRIM_MILLI;
    return left < 0 ? 0 : left > INT32_MAX ? INT32_MAX : (int)left;
}

#if defined(__APPLE__)
#define ONLY_LISTED POSIX_SPAWN_CLOEXEC_DEFAULT
static bool close_others(posix_spawn_file_actions_t *actions, int first) {
    (void)actions;
    (void)first;
    return true;
}
#else
#define ONLY_LISTED 0
/* Closes the other descriptors in the child. With glibc before 2.34, the child inherits those that another library opened without O_CLOEXEC. */
static bool close_others(posix_spawn_file_actions_t *actions, int first) {
    int (*close_from)(posix_spawn_file_actions_t *, int);
    *(void **)&close_from = dlsym(RTLD_DEFAULT, "posix_spawn_file_actions_addclosefrom_np");
    return close_from == NULL || close_from(actions, first) == 0;
}
#endif

/* Starts a program that inherits only these descriptors, as 1, 2 and so on. Returns 0, or an error number. */
static int spawn(char *const argv[], const int descriptors[], int count, pid_t *child) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, defaults;
    if (posix_spawn_file_actions_init(&actions) != 0) return ENOMEM;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return ENOMEM;
    }
    sigemptyset(&none);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGCHLD);
    /* The child gets its own process group, so that kill() also reaches its children. */
    const short flags = POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | ONLY_LISTED;
    bool good = posix_spawnattr_setpgroup(&attributes, 0) == 0 && posix_spawnattr_setsigmask(&attributes, &none) == 0 &&
                posix_spawnattr_setsigdefault(&attributes, &defaults) == 0 && posix_spawnattr_setflags(&attributes, flags) == 0 &&
                posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0) == 0;
    for (int i = 0; good && i < count; i++) good = posix_spawn_file_actions_adddup2(&actions, descriptors[i], i + 1) == 0;
    good = good && close_others(&actions, count + 1);
    int error = good ? posix_spawn(child, argv[0], &actions, &attributes, argv, environ) : ENOMEM;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/* Descriptors of the child, in addition to its two outputs. CHILD_LIFE is its end of the connection `life`, on which each process detects when the
 * other one ends. */
enum { CHILD_LIFE = 3, CHILD_MEMORY = 4 };

/* Creates a pipe, or a connection on which each end detects when the other end closes. */
static bool make_ends(int ends[2], bool is_pipe) {
    if ((is_pipe ? make_pipe(ends) : socketpair(AF_UNIX, SOCK_STREAM | CLOSE_ON_EXEC, 0, ends)) != 0) return false;
    ends[0] = move_up(ends[0]);
    ends[1] = move_up(ends[1]);
    return ends[0] >= 0 && ends[1] >= 0;
}

static void close_all(const int descriptors[], int count) {
    for (int i = 0; i < count; i++) {
        if (descriptors[i] >= 0) close(descriptors[i]);
    }
}

int32_t prim_child_start(char *const argv[], bool shares, prim_child *child, char *why, size_t why_size) {
    int life[2] = {-1, -1}, output[2] = {-1, -1};
    pid_t process = 0;
    int failure = make_ends(output, true) && make_ends(life, false) ? 0 : errno;
    if (failure == 0)
        failure = spawn(argv, (const int[]){output[1], output[1], life[1], shared}, shares ? CHILD_MEMORY : CHILD_LIFE, &process);
    close_all((const int[]){output[1], life[1]}, 2);
    *child = (prim_child){.process = process, .life = life[0], .output = output[0]};
    if (failure == 0) return process;
    close_all((const int[]){output[0], life[0]}, 2);
    snprintf(why, why_size, "%s", strerror(failure));
    return 0;
}

bool prim_child_read(prim_child *child, int64_t deadline, char *buffer, size_t size) {
    for (bool ended = false;;) {
        struct pollfd waits[] = {{.fd = child->output, .events = POLLIN}, {.fd = ended ? -1 : child->life, .events = POLLIN}};
        /* After the child has ended, a process that it started may keep the output open. Then only the available data is read. */
        int ready = poll(waits, 2, ended ? 0 : poll_limit(deadline));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0 && !ended && prim_now() < deadline) continue; /* the limit of poll is lower than some deadlines */
        if (ready <= 0) return false;
        ssize_t count = waits[0].revents != 0 ? read(child->output, buffer, size - 1) : -1;
        if (count > 0) {
            buffer[count] = '\0';
            return true;
        }
        if (count == 0) { /* the child has closed its output but may still be running */
            close(child->output);
            child->output = -1;
        }
        ended = ended || waits[1].revents != 0;
    }
}

/* If this process ignores SIGCHLD or reaps every child, the status is unknown, and `status` is set to 0. */
bool prim_child_reap(prim_child *child, int64_t deadline, int *status) {
    int state = 0;
    for (pid_t reaped; (reaped = waitpid(child->process, &state, WNOHANG)) != child->process;) {
        if (reaped < 0 && errno != EINTR) break;
        if (prim_now() >= deadline) return false;
        nanosleep(&(struct timespec){.tv_nsec = 500000}, NULL);
    }
    *status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
    close_all((const int[]){child->output, child->life}, 2);
    child->process = 0;
    return true;
}

void prim_child_kill(prim_child *child) {
    if (child->process > 0) kill(-child->process, SIGKILL);
}

void prim_child_token(char *text, size_t size) { snprintf(text, size, "inherited"); }

static void end_with_parent(void) {
    char byte;
    while (read(CHILD_LIFE, &byte, 1) < 0 && errno == EINTR) {
    }
    _exit(1);
}

/* Two mechanisms end the child. The death signal also ends a suspended child. The connection also ends a child whose parent ended before the signal
 * was requested. */
uint8_t *prim_child_attach(const char *token) {
    struct stat memory;
    if (strcmp(token, "inherited") != 0 || fstat(CHILD_MEMORY, &memory) != 0 || (uint64_t)memory.st_size != PRIM_SHARED_BYTES) return NULL;
    uint8_t *address = map_shared(CHILD_MEMORY);
    if (address == NULL || fcntl(CHILD_LIFE, F_SETFD, FD_CLOEXEC) != 0) return NULL;
    close(CHILD_MEMORY);
#if !defined(__APPLE__)
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    return prim_thread_start(end_with_parent, "collektive-life", (size_t)256 * 1024) ? address : NULL;
}
