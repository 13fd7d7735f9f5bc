/*
 * Platform functions. Only the files prim_* depend on the operating system: prim_posix.c, prim_semaphore_posix.c and prim_signals_posix.c serve
 * Linux and macOS, prim_windows.c serves Windows. Paths, names and texts are UTF-8 on all platforms.
 * Any thread may call these functions, unless stated otherwise.
 */
#ifndef COLLEKTIVE_PRIM_H
#define COLLEKTIVE_PRIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* SYSTEM and ARCHITECTURE are OS_NAME and OS_ARCH in the file `release` of a JVM. FOREIGN_TEXT is the error text for an undecodable path. */
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

/* ---- Time: monotonic nanoseconds, also as deadlines ------------------------------------------------------------------ */

#define PRIM_MILLI INT64_C(1000000)

int64_t prim_now(void);

/* ---- Locks and semaphores -------------------------------------------------------------------------------------------- */

void prim_lock(prim_mutex *mutex);
void prim_unlock(prim_mutex *mutex);

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count);
/* Initialises with 0 a semaphore in zeroed shared memory that a child also uses. Call it again only after the child has ended. */
void prim_semaphore_share(prim_semaphore *semaphore);
void prim_semaphore_post(prim_semaphore *semaphore);
bool prim_semaphore_try(prim_semaphore *semaphore);
/* Sleeps without spinning. False if the deadline passed first; INT64_MAX means no deadline. */
bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline);
/* Both waits spin for half a millisecond before they sleep. */
void prim_semaphore_wait(prim_semaphore *semaphore);
/* False if the deadline passed first. */
bool prim_semaphore_wait_until(prim_semaphore *semaphore, int64_t deadline);

/* ---- Threads --------------------------------------------------------------------------------------------------------- */

/* Starts a detached thread. `name` has at most 15 bytes and must stay valid. False if the system cannot create the thread. */
bool prim_thread_start(void (*body)(void), const char *name, size_t stack_bytes);

/* Yields the processor to another thread. */
void prim_yield(void);

/* Blocks the calling thread for ever, with all signals masked. */
_Noreturn void prim_park(void);

/* Registers a function to be called in the only thread of each process that is forked later. */
void prim_at_fork(void (*child)(void));

/* ---- Signal handlers -------------------------------------------------------------------------------------------------
 * HotSpot replaces the process's handlers in JNI_CreateJavaVM, and forwards to them the signals that it does not handle. On Windows the handler
 * is the filter of unhandled exceptions; vectored handlers of other libraries stay and must pass on unknown exceptions. */

/* Remembers the process's handlers. Call it before JNI_CreateJavaVM. */
void prim_signals_save(void);

/* Restores the process's handlers after a failed start of the JVM. */
void prim_signals_restore(void);

/* Corrects HotSpot's handlers for this process and remembers them. Call it after JNI_CreateJavaVM. */
void prim_signals_adopt(void);

/* Restores HotSpot's handlers that another library has replaced and returns their number. Only after prim_signals_adopt. */
int32_t prim_signals_repair(void);

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

/* Allocates memory aligned to 64 bytes; the caller frees it with prim_free. NULL if out of memory. `bytes` must be a multiple of 64. */
void *prim_allocate(size_t bytes);
void prim_free(void *memory);

/* Memory that this process shares with its child: one mapping without a name, of which only the committed parts need memory. */
#if defined(_WIN32)
#define PRIM_SHARED_BYTES (UINT64_C(4) << 30) /* a reserved page costs 8 bytes */
#else
#define PRIM_SHARED_BYTES (UINT64_C(16) << 30)
#endif

/* Reserves the mapping, or returns the one of an earlier call. From one thread at a time. NULL on failure, with the reason in `why`. */
uint8_t *prim_shared_reserve(char *why, size_t why_size);
/* Commits memory, so that no later access fails; new memory is zero. Or returns it to the system until it is committed again. False if out of
 * memory, or if the system cannot return it: it stays committed. Offset and size are multiples of 4096. */
bool prim_shared_commit(uint64_t offset, uint64_t bytes, bool committed);

/* ---- Files and libraries --------------------------------------------------------------------------------------------- */

enum prim_file { PRIM_MISSING, PRIM_UNREADABLE, PRIM_FILE, PRIM_DIRECTORY };
enum prim_file prim_file_kind(const char *path);
bool prim_executable(const char *path);

/* Returns the free bytes on the disk of a file, which need not exist; INT64_MAX if unknown. */
int64_t prim_disk_free(const char *file);

/* Locks the folder of a file against other processes. Returns the lock, or a negative number if it is not available by the deadline. */
int prim_folder_lock(const char *file, int64_t deadline);
void prim_folder_unlock(int lock);

/* Opens a text file for reading. NULL if it cannot be opened. */
FILE *prim_file_read(const char *path);

/* Returns whether the JVM, which decodes its options by the locale or the code page, can decode a text. */
bool prim_jvm_can_decode(const char *text);

/* Returns the text in the JVM's encoding; the caller frees it. NULL if out of memory. */
char *prim_jvm_text(const char *text);

/* Loads a library until the process ends. NULL on failure, with the reason in `why`. */
void *prim_library_open(const char *path, char *why, size_t why_size);
void *prim_library_symbol(void *library, const char *name);

/* Copies the path of this library. False if it is unknown or too long. */
bool prim_library_path(char *path, size_t size);

/* ---- Environment and processes --------------------------------------------------------------------------------------- */

/* Hides a variable from getenv and child processes until prim_environment_show(hidden). Meanwhile other threads may read other variables, but
 * must not hide any. `name` has at most 62 bytes. False if it is not set. */
bool prim_environment_hide(const char *name, char **hidden);
void prim_environment_show(char *hidden);

/* A child process without input. It may share the memory of prim_shared_reserve, and then ends with this process. It inherits only that and its
 * output, neither of which has a name. The thread that starts such a child must not end before it. Only that thread calls prim_child_read and
 * prim_child_reap. */

/* Starts a program and returns its process id. 0 on failure, with the reason in `why`. */
int32_t prim_child_start(char *const argv[], bool shares, prim_child *child, char *why, size_t why_size);
/* Waits for output or errors and reads them, NUL-terminated. False if the child ended and all was read, or if the deadline passed first. */
bool prim_child_read(prim_child *child, int64_t deadline, char *buffer, size_t size);
/* Frees the child's resources if it ends by the deadline, and sets `status` to its exit code, or to -signal. False otherwise. */
bool prim_child_reap(prim_child *child, int64_t deadline, int *status);
/* Kills a child and its children. Does nothing if prim_child_reap has freed it. Do not call it during prim_child_reap. */
void prim_child_kill(prim_child *child);

/* The argument by which the child finds the memory. */
void prim_child_token(char *text, size_t size);
/* In the child: maps the memory, and ends this process when the parent ends. NULL if this process is not such a child. */
uint8_t *prim_child_attach(const char *token);

#endif
