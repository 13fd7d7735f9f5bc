/*
 * collektive_shim - a HotSpot JVM inside the caller's process, driven through pooled native memory.
 *
 * Introduction
 *   JNI allows one JVM per process. clk_jvm_start creates it, or starts another process for it (CLK_OWN_PROCESS); calls and frames are the same.
 *   In this process, an engine thread that the shim owns creates it, and only that thread calls into Java.
 *   The caller's threads wait for it on a semaphore, with a time limit. They never enter Java, and Java threads never enter the caller. The
 *   JVM outlives the code that started it: a reloaded caller finds it with clk_jvm_state.
 *
 *   The *host* is the Java code that serves calls. A *frame* is a message between caller and host, which the shim does not interpret.
 *   A *slot* is native memory from a pool, wrapped as a direct ByteBuffer once. A *session* is state that the host keeps between calls.
 *
 *   There are three kinds of call: open a session, step a session, and control, which needs no session. Each passes the request
 *   frame in the bytes [offset, offset + length) of a slot to the host, and returns the location of the answer frame, in a slot that the
 *   shim owns. The call copies no data.
 *
 * Threads
 *   Any thread may call any function. Calls that need the engine thread (start, check, open, step, close, control, stop) take turns.
 *   A caller that does not get its turn within its limit receives CLK_TIMEOUT; nothing was done. If the host has not answered 10 s after the
 *   limit of a call, the shim gives up on the JVM and returns CLK_JVM_LOST. In a forked child process the JVM counts as lost.
 *
 * Errors
 *   Functions return CLK_OK or a negative code of CLK_ERRORS, unless stated otherwise. After a negative code, clk_last_error returns the
 *   calling thread's error text: what happened, to what, and what to do next.
 *
 * Structs
 *   Each begins with `size`, which the caller sets to sizeof(struct); later versions append fields. A struct smaller than in this header is
 *   CLK_ARGUMENT, except clk_stats. Fields of a larger clk_jvm_config must be 0.
 *
 * Strings are UTF-8 and end with NUL. The shim reads strings and structs only during the call.
 */
#ifndef COLLEKTIVE_SHIM_H
#define COLLEKTIVE_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define CLK_API __declspec(dllexport)
#else
#define CLK_API __attribute__((visibility("default")))
#endif

/* Major << 16 | minor << 8 | patch. The ABI is compatible within a major version. */
#define CLK_VERSION 0x000200

/* FRAME, SCHEMA, PROGRAM and SESSION_FAILED come from the host, with its error text. */
#define CLK_ERRORS(X)                                                                             \
    X(OK, 0, "success")                                                                           \
    X(ARGUMENT, -1, "an argument is out of range")                                                \
    X(MEMORY, -2, "out of native memory")                                                         \
    X(HANDLE, -3, "the handle is stale or was never issued")                                      \
    X(TIMEOUT, -4, "the time limit passed before the engine answered")                            \
    X(JVM_NOT_FOUND, -5, "no usable JVM at the given path")                                       \
    X(JVM_OPTIONS, -6, "the JVM options are invalid or not allowed")                              \
    X(JVM_START, -7, "the JVM could not be created")                                              \
    X(JVM_LOST, -8, "the JVM has crashed or stopped responding")                                  \
    X(JVM_NOT_RUNNING, -9, "no JVM is running")                                                   \
    X(JVM_RUNNING, -10, "a JVM is already running with other settings")                           \
    X(HOST, -11, "the host classes are missing or of another version than the shim")              \
    X(FRAME, -12, "the frame is corrupt or invalid; it changed nothing")                          \
    X(SCHEMA, -13, "the two sides were generated from different schemas")                         \
    X(PROGRAM, -14, "a program cannot be loaded")                                                 \
    X(SESSION_FAILED, -15, "the session ended after a round that did not finish; open a new one") \
    X(JAVA, -16, "the host threw an unexpected exception; the session continues from its last successful tick")

enum clk_error {
#define CLK_X(name, code, text) CLK_##name = (code),
    CLK_ERRORS(CLK_X)
#undef CLK_X
};

/* Returned instead of an error by clk_session_open, clk_step and clk_session_wait: the call has not ended. */
#define CLK_PENDING 1

enum clk_jvm_state {
    CLK_STATE_NONE = 0,    /* never started in this process */
    CLK_STATE_RUNNING = 1, /* serves calls */
    CLK_STATE_LOST = 2,    /* exited, aborted or not responding; another can start only if it had its own process */
    CLK_STATE_STOPPED = 3  /* ended by clk_jvm_stop; another can start only if it had its own process */
};

/* ---- Version and errors ---------------------------------------------------------------------------------------------- */

/* Returns the CLK_VERSION that the loaded library was built with. */
CLK_API uint32_t clk_version(void);

/* Returns the name of a code, such as "CLK_FRAME" for -12, or "CLK_UNKNOWN" for any other number. Static storage. */
CLK_API const char *clk_error_name(int32_t code);

/* Returns the text of a code in CLK_ERRORS. Static storage. */
CLK_API const char *clk_error_text(int32_t code);

/* Copies the text of the calling thread's last error to `buffer`, NUL-terminated; a longer text is truncated after a whole character. Returns
 * the length of the whole text in bytes, without NUL, or 0 without an error. `buffer` may be NULL when `capacity` is 0. */
CLK_API int32_t clk_last_error(char *buffer, int32_t capacity);

/* ---- JVM ------------------------------------------------------------------------------------------------------------- */

enum clk_placement {
    CLK_IN_PROCESS = 0, /* on a thread of this process */
    CLK_OWN_PROCESS = 1 /* in a child process, which `home`/bin/java runs and which ends with this process */
};

/* Configuration of the JVM. */
typedef struct clk_jvm_config {
    uint32_t size;
    int32_t option_count;       /* number of `options`, 0 or greater */
    const char *home;           /* root of a JRE or JDK, whose lib/server/libjvm.so (bin/server/jvm.dll on Windows) is loaded */
    const char *class_path;     /* jars of the host, with the platform's separator */
    const char *const *options; /* JVM options, one string each, in order; may be NULL when option_count is 0 */
    int32_t start_limit_ms;     /* limit of the whole call; 1 or greater */
    int32_t check_options;      /* not 0: try the options in a child process first (recommended: invalid options can end the process) */
    int32_t placement;          /* one of enum clk_placement */
    int32_t reserved;           /* 0 */
} clk_jvm_config;

/* Starts the JVM. If one is already running, returns CLK_OK for an equal configuration and CLK_JVM_RUNNING for any other.
 * If a check fails, nothing has changed and a later start may succeed. If JNI_CreateJavaVM or a later step fails, the state becomes
 * CLK_STATE_LOST.
 *
 * With CLK_OWN_PROCESS, a start may follow after an error, a loss and a stop. A start with another configuration replaces a JVM without open
 * sessions. Slots that were acquired before the first such start cannot be used in calls (CLK_ARGUMENT). The process must not start another
 * JVM itself before that, but may do so afterwards.
 *
 * Options that endanger the process are rejected. JAVA_TOOL_OPTIONS, _JAVA_OPTIONS and JDK_JAVA_OPTIONS are ignored. */
CLK_API int32_t clk_jvm_start(const clk_jvm_config *config);

/* Runs the checks of clk_jvm_start: files, forbidden options and, if check_options is not 0, all options in a child process (50 to 200 ms).
 * Does not affect a running JVM. A start with the configuration that passed last skips the child process. */
CLK_API int32_t clk_jvm_check(const clk_jvm_config *config);

/* Returns one of enum clk_jvm_state. Does not wait. */
CLK_API int32_t clk_jvm_state(void);

/* Copies the description of the JVM that was started, "home\nversion\noption\noption...", and returns its length, both as
 * clk_last_error does. Returns CLK_JVM_NOT_RUNNING if none was started. */
CLK_API int32_t clk_jvm_description(char *buffer, int32_t capacity);

/* Ends the JVM before the process ends; another can follow only if it had its own process. Closes all sessions, runs the JVM's shutdown hooks
 * (which save flight recordings) and destroys it. Java threads that do not end are halted where they are.
 *   CLK_OK        the JVM has ended, or none was ever started
 *   CLK_TIMEOUT   the JVM did not end within the limit. If possible, its threads were halted so that the process can exit; the state is then
 *                 CLK_STATE_STOPPED. Halting takes up to 10 s more because it waits for a garbage collection to end. A separate process is
 *                 killed.
 *   CLK_JVM_LOST  the JVM had crashed or stopped responding; if possible, its threads were halted */
CLK_API int32_t clk_jvm_stop(int32_t limit_ms);

/* ---- Slots ----------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_slot; /* 0 is never a slot; the upper half is the generation */

/* The memory of a slot, which its owner may read and write. Its address is stable until the slot grows or is released. */
typedef struct clk_memory {
    uint32_t size;
    int32_t capacity; /* bytes */
    uint8_t *address; /* aligned to 64 bytes */
} clk_memory;

/* Acquires a slot of at least `capacity` bytes (1..2^30) from the pool. The caller owns it until clk_slot_release. Its content is undefined.
 * Does not need a JVM; the slot may outlive it. */
CLK_API int32_t clk_slot_acquire(int32_t capacity, clk_slot *slot, clk_memory *memory);

/* Grows a slot that the caller owns to at least `capacity` bytes (1..2^30). A slot that is large enough keeps its memory. Otherwise copies the
 * last `keep` bytes to the end of the new memory, because frames are written from the back, and the old address becomes invalid. Returns
 * CLK_ARGUMENT while a call uses the slot. */
CLK_API int32_t clk_slot_grow(clk_slot slot, int32_t capacity, int32_t keep, clk_memory *memory);

/* Releases a slot. Its memory stays valid for a running call and returns to the pool afterwards. The pool keeps up to 64 MiB of unused memory
 * and returns the rest to the system. */
CLK_API int32_t clk_slot_release(clk_slot slot);

/* ---- Sessions -------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_session; /* 0 is never a session; the upper half is the generation */

/* Location of an answer frame, in read-only memory that the shim owns. It is valid until the next call of the same session or its close; the
 * answer of clk_control until the next clk_control. clk_jvm_stop invalidates all answers. */
typedef struct clk_answer {
    uint32_t size;
    int32_t offset;   /* of the frame, in bytes from `address` */
    int32_t length;   /* of the frame, in bytes */
    int32_t capacity; /* of the slot, in bytes */
    uint8_t *address; /* of the slot's first byte; the frame begins at address + offset */
} clk_answer;

/* Opens a session, with the request frame in the caller's slot. Sets `session` and `answer` on CLK_OK; otherwise no session was opened.
 * Returns CLK_MEMORY when 256 sessions are open, and CLK_PENDING, with `session` set, if a debugger stops the JVM. See clk_step for other
 * errors. */
CLK_API int32_t clk_session_open(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_session *session, clk_answer *answer);

/* Steps a session, with the request frame in the caller's slot. After an error the session is as it was before the call, except after
 * CLK_SESSION_FAILED and CLK_JVM_LOST. After these two, Java threads that did not end may still read the request, so the memory of its slot
 * is never reused: release the slot and acquire another. */
CLK_API int32_t clk_step(clk_session session, clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* Waits at most wait_ms, which may be 0, for an open or step that is pending, and returns its result or CLK_PENDING.
 *
 * Limits exclude the time while a debugger is attached to the JVM. An open or step that takes 100 ms then returns CLK_PENDING, so that the
 * caller is not blocked while the debugger stops the JVM. Until it has ended, its slot stays in use, and all calls that need the engine thread
 * return CLK_TIMEOUT, except this one, clk_session_close and clk_jvm_stop. clk_control waits for the debugger for 1 s. */
CLK_API int32_t clk_session_wait(clk_session session, int32_t wait_ms, clk_answer *answer);

/* Closes a session and releases its answer. If a debugger stops the JVM, the host closes the session later. Returns CLK_HANDLE if it is already
 * closed. */
CLK_API int32_t clk_session_close(clk_session session, int32_t limit_ms);

/* ---- Control --------------------------------------------------------------------------------------------------------- */

/* Calls the host outside any session, with the request frame in the caller's slot. */
CLK_API int32_t clk_control(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* ---- Logs and counters ----------------------------------------------------------------------------------------------- */

enum clk_log_level { CLK_LOG_DEBUG = 0, CLK_LOG_INFO = 1, CLK_LOG_WARNING = 2, CLK_LOG_ERROR = 3 };

/* Removes the oldest line from the log, copies it to `buffer`, NUL-terminated, and returns the length of the copy, or -1 if the log is empty.
 * A line longer than capacity - 1 bytes is truncated after a whole character; no line is longer than 8191 bytes. `level` (may be NULL) is set
 * to one of enum clk_log_level. If `buffer` is NULL, the line is discarded and the result is 0. The log holds 256 KiB; clk_stats counts the
 * lines that did not fit. */
CLK_API int32_t clk_log_read(int32_t *level, char *buffer, int32_t capacity);

/* Counts since the process started, unless stated otherwise. */
typedef struct clk_stats {
    uint32_t size;
    int32_t sessions;        /* open now */
    int32_t slots;           /* acquired now, including those of answers */
    int32_t process;         /* id of the JVM's own process, running or not; 0 if it runs in this process */
    uint64_t steps;          /* calls of clk_step that reached the host */
    uint64_t slot_bytes;     /* memory of the pool, in use or not */
    uint64_t wrapped;        /* direct ByteBuffers created */
    uint64_t logs_dropped;   /* log lines that did not fit */
    uint64_t signal_repairs; /* signal handlers of HotSpot that another library replaced and the shim restored */
} clk_stats;

/* Fills in `stats`, up to its size. Does not wait for the engine thread. */
CLK_API int32_t clk_get_stats(clk_stats *stats);

#ifdef __cplusplus
}
#endif

#endif
