/* What the shim needs from the platform: the only place, besides signals.c, that knows the operating system. */
#ifndef COLLEKTIVE_PRIM_H
#define COLLEKTIVE_PRIM_H

#include <pthread.h>
#include <semaphore.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdnoreturn.h>

#define PRIM_PATH_SEPARATOR ':'
#define PRIM_LIBJVM "lib/server/libjvm.so"
#define PRIM_JAVA "bin/java"
#define PRIM_NULL_FILE "/dev/null"

/* ---- Time: monotonic nanoseconds, also as deadlines ------------------------------------------------------------------ */

#define PRIM_MILLI INT64_C(1000000)

int64_t prim_now(void);

/* ---- Locks and semaphores -------------------------------------------------------------------------------------------- */

typedef pthread_mutex_t prim_mutex;
#define PRIM_MUTEX_INIT PTHREAD_MUTEX_INITIALIZER
void prim_lock(prim_mutex *mutex);
void prim_unlock(prim_mutex *mutex);

typedef sem_t prim_semaphore;
void prim_semaphore_init(prim_semaphore *semaphore, unsigned count);
void prim_semaphore_post(prim_semaphore *semaphore);
/* Neither wait sleeps for the first half of a millisecond, but lets other threads run. */
void prim_semaphore_wait(prim_semaphore *semaphore);
/* False when the deadline passed first. */
bool prim_semaphore_wait_until(prim_semaphore *semaphore, int64_t deadline);

/* Runs `init` once per process. */
typedef pthread_once_t prim_once;
#define PRIM_ONCE_INIT PTHREAD_ONCE_INIT
void prim_run_once(prim_once *once, void (*init)(void));

/* ---- Threads --------------------------------------------------------------------------------------------------------- */

/* Starts a thread that is never joined. False when the system gives none. */
bool prim_thread_start(void (*body)(void), const char *name, size_t stack_bytes);

/* Takes the calling thread out of service for ever, deaf to signals. */
noreturn void prim_park(void);

/* Calls `child` in every forked child process. */
void prim_at_fork(void (*child)(void));

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

/* Memory aligned to 64 bytes, given back by prim_free; NULL when there is none. `bytes` is a multiple of 64. */
void *prim_allocate(size_t bytes);
void prim_free(void *memory);

/* ---- Files and libraries --------------------------------------------------------------------------------------------- */

enum prim_file { PRIM_MISSING, PRIM_UNREADABLE, PRIM_FILE, PRIM_DIRECTORY };
enum prim_file prim_file_kind(const char *path);
bool prim_executable(const char *path);

/* Whether other programs, by the locale of the environment, read paths as UTF-8. */
bool prim_locale_is_utf8(void);

/* Loads a library for the rest of the process. NULL on failure with the reason in `why`. */
void *prim_library_open(const char *path, char *why, size_t why_size);
void *prim_library_symbol(void *library, const char *name);

/* ---- Environment and processes --------------------------------------------------------------------------------------- */

/* Takes a variable out of the environment until prim_environment_show: getenv and child processes do not see it. Other
 * threads may read the environment meanwhile. False when it is not set. */
bool prim_environment_hide(const char *name, char **hidden);
void prim_environment_show(char *hidden);

/* Runs a program and collects what it writes (standard output and error, NUL-ended, at least the last half of its size) into `output`.
 * Standard input is empty. PRIM_EXITED fills `status` with the exit code, or 128 + signal. A program that is not done by
 * the deadline is killed. */
enum prim_run { PRIM_EXITED, PRIM_NOT_STARTED, PRIM_TIMED_OUT };
enum prim_run prim_process_run(char *const argv[], int64_t deadline, char *output, size_t output_size, int *status);

#endif
