/*
 * Platform functions. Only the files prim_* contain code that depends on the operating system: prim_windows.c is for Windows, and prim_posix.c,
 * prim_semaphore_posix.c and prim_signals_posix.c are for Linux and macOS. Paths, names and texts are UTF-8 on all platforms.
 * Any thread may call these functions, unless stated otherwise.
 */
#ifndef COLLEKTIVE_PRIM_H
#define COLLEKTIVE_PRIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* PRIM_SYSTEM and PRIM_ARCHITECTURE are the values of OS_NAME and OS_ARCH in the file `release` of a JVM. PRIM_FOREIGN_TEXT is the error text for a
 * path that the JVM cannot decode. */
#if defined(_WIN32)
#define PRIM_PATH_SEPARATOR ';'
#define PRIM_LIBJVM "bin/server/jvm.dll"
#define PRIM_JAVA "bin/java.exe"
#define PRIM_NULL_FILE "NUL"
#define PRIM_SYSTEM "Windows"
#define PRIM_READ_ADVICE "check its permissions, and close programs that have it open"
#define PRIM_FOREIGN_TEXT "the Windows code page cannot encode %s; use an ASCII path"
typedef struct {
    void *lock;
} prim_mutex;
#define PRIM_MUTEX_INIT {0}
typedef void *prim_semaphore;
typedef struct {
    void *process, *job, *output;
} prim_child;
#else
#include <pthread.h>
#define PRIM_PATH_SEPARATOR ':'
#define PRIM_JAVA "bin/java"
#define PRIM_NULL_FILE "/dev/null"
#define PRIM_READ_ADVICE "check its permissions"
typedef struct {
    int process, life, output;
} prim_child;
#define PRIM_FOREIGN_TEXT "the locale of the process cannot encode %s; set LC_ALL=C.UTF-8 or use an ASCII path"
typedef pthread_mutex_t prim_mutex;
#define PRIM_MUTEX_INIT PTHREAD_MUTEX_INITIALIZER
#if defined(__APPLE__)
#define PRIM_LIBJVM "lib/server/libjvm.dylib"
#define PRIM_SYSTEM "Darwin"
#else
#define PRIM_LIBJVM "lib/server/libjvm.so"
#define PRIM_SYSTEM "Linux"
#endif
typedef struct {
    _Atomic uint32_t count, waiting;
} prim_semaphore;
#endif

#if defined(__aarch64__)
#define PRIM_ARCHITECTURE "aarch64"
#else
#define PRIM_ARCHITECTURE "x86_64"
#endif
#define PRIM_PLATFORM PRIM_SYSTEM " on " PRIM_ARCHITECTURE

/* ---- Time, and deadlines, in monotonic nanoseconds -------------------------------------------------------------------- */

#define PRIM_MILLI INT64_C(1000000)

int64_t prim_now(void);

/* ---- Locks and semaphores -------------------------------------------------------------------------------------------- */

void prim_lock(prim_mutex *mutex);
void prim_unlock(prim_mutex *mutex);

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count);
/* Initialises to 0 a semaphore in zeroed shared memory, which this process shares with a child. Call it again only after the child has ended. */
void prim_semaphore_share(prim_semaphore *semaphore);
void prim_semaphore_post(prim_semaphore *semaphore);
bool prim_semaphore_try(prim_semaphore *semaphore);
/* Waits without spinning. False if the deadline passes first; INT64_MAX means no deadline. */
bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline);
/* Spins for half a millisecond, then sleeps. */
void prim_semaphore_wait(prim_semaphore *semaphore);
/* Does the same until the deadline. False if it passes first. */
bool prim_semaphore_wait_until(prim_semaphore *semaphore, int64_t deadline);

/* ---- Threads --------------------------------------------------------------------------------------------------------- */

/* Starts a detached thread. `name` may have at most 15 bytes and must stay valid. False if the system cannot create the thread. */
bool prim_thread_start(void (*body)(void), const char *name, size_t stack_bytes);

/* Yields the processor to another thread. */
void prim_yield(void);

/* Blocks the calling thread for ever, with all signals masked. */
_Noreturn void prim_park(void);

/* Registers a function that is called in each process that is forked later, on its only thread. */
void prim_at_fork(void (*child)(void));

/* ---- Signal handlers -------------------------------------------------------------------------------------------------
 * In JNI_CreateJavaVM, HotSpot replaces the handlers of the process. It forwards the signals that it does not handle to them. On Windows, the only
 * handler is the filter of unhandled exceptions. Vectored handlers of other libraries remain, and must pass on exceptions that they do not know. */

/* Saves the handlers of the process. Call it before JNI_CreateJavaVM. */
void prim_signals_save(void);

/* Restores the handlers of the process after a failed start of the JVM. */
void prim_signals_restore(void);

/* Corrects the flags of HotSpot's handlers for this process, and saves the handlers. Call it after JNI_CreateJavaVM. */
void prim_signals_adopt(void);

/* Restores the handlers of HotSpot that another library has replaced, and returns their number. Call it only after prim_signals_adopt. */
int32_t prim_signals_repair(void);

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

/* Allocates memory that is aligned to 64 bytes, which the caller frees with prim_free. NULL if out of memory. `bytes` must be a multiple of 64. */
void *prim_allocate(size_t bytes);
void prim_free(void *memory);

/* The memory that this process shares with its child. It is one mapping without a name, in which only committed parts use memory. */
#if defined(_WIN32)
#define PRIM_SHARED_BYTES (UINT64_C(4) << 30) /* a reserved page costs 8 bytes */
#else
#define PRIM_SHARED_BYTES (UINT64_C(16) << 30)
#endif

/* Reserves the mapping, or returns the mapping of an earlier call. Only one thread at a time may call it. NULL on failure, with the reason in `why`. */
uint8_t *prim_shared_reserve(char *why, size_t why_size);
/* Commits a part of the mapping, or returns its memory to the system. Accesses to committed memory do not fail, and new memory is zero. False if out
 * of memory, or if the system cannot return memory, which then stays committed. Offset and size are multiples of 4096. */
bool prim_shared_commit(uint64_t offset, uint64_t bytes, bool committed);

/* ---- Files and libraries --------------------------------------------------------------------------------------------- */

enum prim_file { PRIM_MISSING, PRIM_UNREADABLE, PRIM_FILE, PRIM_DIRECTORY };
enum prim_file prim_file_kind(const char *path);
bool prim_executable(const char *path);

/* Returns the free bytes on the disk of a file; INT64_MAX if unknown. The file need not exist, but its folder must. */
int64_t prim_disk_free(const char *file);

/* Locks the folder of a file against other processes. Returns the lock, or a negative number if it is not available by the deadline. */
int prim_folder_lock(const char *file, int64_t deadline);
void prim_folder_unlock(int lock);

/* Opens a text file for reading. NULL if it cannot be opened. */
FILE *prim_file_read(const char *path);

/* Returns whether the JVM can decode a text. It decodes its options by the locale or the code page. */
bool prim_jvm_can_decode(const char *text);

/* Returns the text in the JVM's encoding; the caller frees it. NULL if out of memory. */
char *prim_jvm_text(const char *text);

/* Loads a library until the process ends. NULL on failure, with the reason in `why`. */
void *prim_library_open(const char *path, char *why, size_t why_size);
void *prim_library_symbol(void *library, const char *name);

/* Copies the path of this library. False if it is unknown or too long. */
bool prim_library_path(char *path, size_t size);

/* ---- Environment and processes --------------------------------------------------------------------------------------- */

/* Hides a variable from getenv and from child processes until prim_environment_show(hidden) is called. Meanwhile, other threads may read other
 * variables, but must not hide any. `name` may have at most 62 bytes. False if the variable is not set. */
bool prim_environment_hide(const char *name, char **hidden);
void prim_environment_show(char *hidden);

/* A child process has no input. With `shares`, it shares the memory of prim_shared_reserve, and ends when this process ends. It inherits only this
 * memory, its output and the means to detect the parent's end, so no other process can open them by a name. The thread that starts such a child must
 * not end before the child does, and only this thread may call prim_child_read and prim_child_reap. */

/* Starts a program and returns its process id. 0 on failure, with the reason in `why`. */
int32_t prim_child_start(char *const argv[], bool shares, prim_child *child, char *why, size_t why_size);
/* Waits for text on standard output or standard error, and reads it, NUL-terminated. False if the child has ended and everything was read, or if the
 * deadline passes first. */
bool prim_child_read(prim_child *child, int64_t deadline, char *buffer, size_t size);
/* Waits for the child to end, frees its resources, and sets `status` to its exit code, or to -signal. False if the deadline passes first. */
bool prim_child_reap(prim_child *child, int64_t deadline, int *status);
/* Kills the child and its children. Does nothing after prim_child_reap has freed the child. Do not call it during prim_child_reap. */
void prim_child_kill(prim_child *child);

/* Writes the argument with which the child finds the memory. */
void prim_child_token(char *text, size_t size);
/* Maps the memory in the child, and ends this process when the parent ends. NULL if this process is not such a child. */
uint8_t *prim_child_attach(const char *token);

#endif
