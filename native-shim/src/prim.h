/*
 * What the shim needs from the platform. Only the files prim_* know the operating system: prim_posix.c and prim_signals_posix.c serve Linux and
 * macOS, which have semaphores of their own, prim_windows.c serves Windows. Paths, names and texts are UTF-8 everywhere.
 * Any thread may call these functions, unless said otherwise.
 */
#ifndef COLLEKTIVE_PRIM_H
#define COLLEKTIVE_PRIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* SYSTEM and ARCHITECTURE are OS_NAME and OS_ARCH in the file `release` of a JVM. FOREIGN_TEXT says why a JVM does not read a text, and what to do. */
#if defined(_WIN32)
#define PRIM_PATH_SEPARATOR ';'
#define PRIM_LIBJVM "bin/server/jvm.dll"
#define PRIM_JAVA "bin/java.exe"
#define PRIM_NULL_FILE "NUL"
#define PRIM_SYSTEM "Windows"
#define PRIM_READ_ADVICE "check its permissions, and close the program that keeps it open"
#define PRIM_FOREIGN_TEXT "the code page of Windows cannot express %s; use a path of plain ASCII"
typedef struct {
    void *lock;
} prim_mutex;
#define PRIM_MUTEX_INIT {0}
typedef void *prim_semaphore;
typedef union {
    void *once;
} prim_once;
#define PRIM_ONCE_INIT {0}
#else
#include <pthread.h>
#define PRIM_PATH_SEPARATOR ':'
#define PRIM_JAVA "bin/java"
#define PRIM_NULL_FILE "/dev/null"
#define PRIM_READ_ADVICE "check its permissions"
#define PRIM_FOREIGN_TEXT "the locale of the process cannot express %s; set LC_ALL=C.UTF-8 or use a path of plain ASCII"
typedef pthread_mutex_t prim_mutex;
#define PRIM_MUTEX_INIT PTHREAD_MUTEX_INITIALIZER
typedef pthread_once_t prim_once;
#define PRIM_ONCE_INIT PTHREAD_ONCE_INIT
#if defined(__APPLE__)
#define PRIM_LIBJVM "lib/server/libjvm.dylib"
#define PRIM_SYSTEM "Darwin"
typedef void *prim_semaphore;
#else
#define PRIM_LIBJVM "lib/server/libjvm.so"
#define PRIM_SYSTEM "Linux"
typedef struct {
    _Atomic uint32_t count, waiting;
} prim_semaphore;
#endif
#endif

#if defined(__aarch64__)
#define PRIM_ARCHITECTURE "aarch64"
#else
#define PRIM_ARCHITECTURE "x86_64"
#endif
#define PRIM_PLATFORM PRIM_SYSTEM " on " PRIM_ARCHITECTURE

/* ---- Time: monotonic nanoseconds, also as deadlines ------------------------------------------------------------------ */

#define PRIM_MILLI INT64_C(1000000)

int64_t prim_now(void);

/* ---- Locks and semaphores -------------------------------------------------------------------------------------------- */

void prim_lock(prim_mutex *mutex);
void prim_unlock(prim_mutex *mutex);

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count);
void prim_semaphore_post(prim_semaphore *semaphore);
bool prim_semaphore_try(prim_semaphore *semaphore);
/* Sleeps at once. False when the deadline passed first; INT64_MAX is none. */
bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline);
/* Both waits spin for half a millisecond before they sleep. */
void prim_semaphore_wait(prim_semaphore *semaphore);
/* False when the deadline passed first. */
bool prim_semaphore_wait_until(prim_semaphore *semaphore, int64_t deadline);

/* Runs `init` once per process. */
void prim_run_once(prim_once *once, void (*init)(void));

/* ---- Threads --------------------------------------------------------------------------------------------------------- */

/* Starts a detached thread. `name` has at most 15 bytes and is never freed. False when there is no memory for it. */
bool prim_thread_start(void (*body)(void), const char *name, size_t stack_bytes);

/* Lets another thread run. */
void prim_yield(void);

/* Blocks the calling thread for ever, with all signals masked. */
_Noreturn void prim_park(void);

/* Calls `child` in each process forked from now on, in the only thread that it has. */
void prim_at_fork(void (*child)(void));

/* ---- Signal handlers -------------------------------------------------------------------------------------------------
 * HotSpot replaces the process's handlers in JNI_CreateJavaVM, and passes on to them the signals that are not its own. On Windows the handler is
 * the filter of unhandled exceptions; vectored handlers of others live on beside HotSpot and must pass on what they do not know. */

/* Remembers the process's handlers. Call it before JNI_CreateJavaVM. */
void prim_signals_save(void);

/* Puts these back, after a JVM did not come up. */
void prim_signals_restore(void);

/* Corrects HotSpot's handlers for this process and remembers them. Call it after JNI_CreateJavaVM. */
void prim_signals_adopt(void);

/* Puts HotSpot's handlers back where another library has replaced them; returns how many. Only after prim_signals_adopt. */
int32_t prim_signals_repair(void);

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

/* Allocates memory aligned to 64 bytes; the caller frees it with prim_free. NULL when there is none. `bytes` is a multiple of 64. */
void *prim_allocate(size_t bytes);
void prim_free(void *memory);

/* ---- Files and libraries --------------------------------------------------------------------------------------------- */

enum prim_file { PRIM_MISSING, PRIM_UNREADABLE, PRIM_FILE, PRIM_DIRECTORY };
enum prim_file prim_file_kind(const char *path);
bool prim_executable(const char *path);

/* Bytes that this process may still write to the disk of a file, which need not be there; the most when that is not known. */
int64_t prim_room(const char *file);

/* Takes the lock of the folder of a file, which other processes may hold until the deadline. Returns the lock; negative when it cannot be had. */
int prim_folder_lock(const char *file, int64_t deadline);
void prim_folder_unlock(int lock);

/* Opens a file to read its text; NULL when it cannot be opened. */
FILE *prim_file_read(const char *path);

/* Whether the JVM, which decodes its options by the locale or the code page, reads all characters of a text. */
bool prim_jvm_reads(const char *text);

/* The text in the JVM's encoding; the caller frees it. NULL when there is no memory. */
char *prim_jvm_text(const char *text);

/* Loads a library for the rest of the process. NULL on failure, with the reason in `why`. */
void *prim_library_open(const char *path, char *why, size_t why_size);
void *prim_library_symbol(void *library, const char *name);

/* ---- Environment and processes --------------------------------------------------------------------------------------- */

/* Hides a variable from getenv and child processes until prim_environment_show(hidden). Other threads may read other variables
 * meanwhile, and no two threads may hide at once. `name` has at most 62 bytes. False when it is not set. */
bool prim_environment_hide(const char *name, char **hidden);
void prim_environment_show(char *hidden);

/* Runs a program without input. `output` gets what it writes to standard output and error, NUL-ended; of more than fits, at least the last
 * half of output_size. PRIM_EXITED sets `status` to the exit code, or 128 + signal. At the deadline the program is killed. */
enum prim_run { PRIM_EXITED, PRIM_NOT_STARTED, PRIM_TIMED_OUT };
enum prim_run prim_process_run(char *const argv[], int64_t deadline, char *output, size_t output_size, int *status);

#endif
