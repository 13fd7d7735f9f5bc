/*
 * collektive_shim - runs a HotSpot JVM, and exchanges messages with it through pooled native memory.
 *
 * Introduction
 *   The Java code that serves calls is the *host*. A *frame* is a message between caller and host, which the shim does not interpret. A *slot* is
 *   native memory from a pool, which the shim wraps only once as a direct ByteBuffer. A *session* is state that the host keeps between calls.
 *
 *   There are three kinds of call: open a session, step a session, and control, which needs no session. Each call passes a request frame to the
 *   host, the bytes [offset, offset + length) of a slot. It returns the location of the answer frame, which is in a slot of the shim. The call
 *   does not copy frames.
 *
 *   clk_jvm_start creates the JVM in this process or, with CLK_OWN_PROCESS, in a child process. Calls and frames are the same in both cases. In this
 *   process, the shim creates one thread, the engine thread, on which it creates the JVM and calls Java. The caller's threads wait for it on a
 *   semaphore, with a time limit. They never run Java code, and Java threads never run code of the caller.
 *
 *   JNI allows only one JVM per process. The JVM outlives the code that started it, so a caller that was reloaded can find it with clk_jvm_state.
 *
 * Threads
 *   Any thread may call any function. Calls that need the engine thread (start, check, open, step, close, control, stop) take turns. A call whose
 *   turn does not come within its limit returns CLK_TIMEOUT and has done nothing. If the host has not answered 10 s after the limit of a call,
 *   the shim gives up on the JVM and returns CLK_JVM_LOST. In a forked child process, the JVM counts as lost.
 *
 * Errors
 *   Unless stated otherwise, functions return CLK_OK or a negative code of CLK_ERRORS. After a negative code, clk_last_error returns the error text of
 *   the calling thread, which explains the problem and what to do about it.
 *
 * Structs
 *   Each struct begins with `size`, which the caller sets to sizeof(struct). Later versions append fields. If a struct is smaller than in this
 *   header, the result is CLK_ARGUMENT, except for clk_stats. If a clk_jvm_config is larger, its additional fields must be 0.
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

/* major << 16 | minor << 8 | patch. The ABI is compatible within a major version. */
#define CLK_VERSION 0x000200

/* The host returns FRAME, SCHEMA, PROGRAM and SESSION_FAILED, and also the error text for them. */
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

/* Result of clk_session_open, clk_step and clk_session_wait when a debugger stops the JVM: the call has not ended yet. */
#define CLK_PENDING 1

enum clk_jvm_state {
    CLK_STATE_NONE = 0,    /* no JVM has been started */
    CLK_STATE_RUNNING = 1, /* the JVM serves calls */
    CLK_STATE_LOST = 2,    /* the JVM has exited, aborted or stopped responding; another can start only if it had its own process */
    CLK_STATE_STOPPED = 3  /* clk_jvm_stop has ended the JVM; another can start only if it had its own process */
};

/* ---- Version and errors ---------------------------------------------------------------------------------------------- */

/* Returns the CLK_VERSION that the loaded library was built with. */
CLK_API uint32_t clk_version(void);

/* Returns the name of a code, such as "CLK_FRAME" for -12, or "CLK_UNKNOWN" if the number is not a code. The text is static. */
CLK_API const char *clk_error_name(int32_t code);

/* Returns the text of a code in CLK_ERRORS. The text is static. */
CLK_API const char *clk_error_text(int32_t code);

/* Copies the text of the calling thread's last error to `buffer`, NUL-terminated. If the text is longer than the buffer, it is truncated after a
 * whole character. Returns the length of the whole text in bytes, without NUL, or 0 if the thread had no error. `buffer` may be NULL if `capacity`
 * is 0. */
CLK_API int32_t clk_last_error(char *buffer, int32_t capacity);

/* ---- JVM ------------------------------------------------------------------------------------------------------------- */

enum clk_placement {
    CLK_IN_PROCESS = 0, /* the JVM runs in this process, on the engine thread */
    CLK_OWN_PROCESS = 1 /* the JVM runs in a child process, `home`/bin/java, which ends with this process */
};

/* Configuration of the JVM. */
typedef struct clk_jvm_config {
    uint32_t size;
    int32_t option_count;       /* number of `options`, 0 or greater */
    const char *home;           /* root of a JRE or JDK, whose lib/server/libjvm.so (bin/server/jvm.dll on Windows) is loaded */
    const char *class_path;     /* jars of the host, with the platform's separator */
    const char *const *options; /* JVM options, one string each, in order; may be NULL when option_count is 0 */
    int32_t start_limit_ms;     /* limit of the whole call; 1 or greater */
    int32_t check_options;      /* not 0: try the options in a child process first, because invalid options can end this one */
    int32_t placement;          /* one of enum clk_placement */
    int32_t reserved;           /* 0 */
} clk_jvm_config;

/* Starts the JVM. If a JVM is already running, returns CLK_OK if its configuration is equal, and CLK_JVM_RUNNING otherwise.
 * If a check of the configuration fails, nothing has changed, and a later start may succeed. If JNI_CreateJavaVM or a later part of the start
 * fails, the state becomes CLK_STATE_LOST.
 *
 * With CLK_OWN_PROCESS, the JVM can be started again after an error, a loss or a stop. A start with another configuration replaces a running JVM
 * that has no open sessions. Slots that were acquired before the first start with CLK_OWN_PROCESS cannot be used in its calls (CLK_ARGUMENT). Once a
 * JVM was started in this process, CLK_OWN_PROCESS is no longer possible. The reverse order is possible.
 *
 * Options that endanger the process are rejected. JAVA_TOOL_OPTIONS, _JAVA_OPTIONS and JDK_JAVA_OPTIONS are ignored. */
CLK_API int32_t clk_jvm_start(const clk_jvm_config *config);

/* Runs the checks of clk_jvm_start: of the files, of forbidden options and, if check_options is not 0, of all options in a child process (50 to
 * 200 ms). Does not affect a running JVM. If the last configuration that passed is equal, a check or start skips the child process. */
CLK_API int32_t clk_jvm_check(const clk_jvm_config *config);

/* Returns one of enum clk_jvm_state. Does not wait. */
CLK_API int32_t clk_jvm_state(void);

/* Copies the description of the JVM that was started last, "home\nversion\noption\noption...". Truncates the text and returns its length as
 * clk_last_error does. Returns CLK_JVM_NOT_RUNNING if no JVM was started. */
CLK_API int32_t clk_jvm_description(char *buffer, int32_t capacity);

/* Ends the JVM. Call this function before the process ends. Afterwards, another JVM can be started only if this one had its own process. Closes all
 * sessions, runs the JVM's shutdown hooks, which save flight recordings, and destroys the JVM. Java threads that do not end are halted.
 *   CLK_OK        the JVM has ended, or no JVM was ever started
 *   CLK_TIMEOUT   the JVM did not end within the limit. A separate process was killed. In this process, the JVM's threads were halted if possible,
 *                 so that the process can exit, and the state is then CLK_STATE_STOPPED. Halting waits for a garbage collection to end, which
 *                 can take up to 10 s more.
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

/* Acquires a slot of at least `capacity` bytes (1..2^30) from the pool. Its content is undefined. The caller owns the slot until it calls
 * clk_slot_release. No JVM needs to be running, and the slot may outlive one. */
CLK_API int32_t clk_slot_acquire(int32_t capacity, clk_slot *slot, clk_memory *memory);

/* Grows a slot that the caller owns to at least `capacity` bytes (1..2^30). A slot that is large enough keeps its memory. Otherwise, the slot gets new
 * memory, and the old address becomes invalid. The last `keep` bytes are copied to the end of the new memory, because frames are written from back
 * to front. Returns CLK_ARGUMENT while a call uses the slot. */
CLK_API int32_t clk_slot_grow(clk_slot slot, int32_t capacity, int32_t keep, clk_memory *memory);

/* Releases a slot. If a call is using its memory, the memory stays valid until the call ends. Then it returns to the pool, which keeps up to 64 MiB of
 * unused memory and returns the rest to the system. */
CLK_API int32_t clk_slot_release(clk_slot slot);

/* ---- Sessions -------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_session; /* 0 is never a session; the upper half is the generation */

/* Location of an answer frame in memory of the shim, which the caller may only read. The answer is valid until the next call for the same session, or
 * until the session is closed. The answer of clk_control is valid until the next clk_control. clk_jvm_stop invalidates all answers. */
typedef struct clk_answer {
    uint32_t size;
    int32_t offset;   /* bytes from `address` to the frame */
    int32_t length;   /* length of the frame in bytes */
    int32_t capacity; /* size of the slot in bytes */
    uint8_t *address; /* first byte of the slot; the frame begins at address + offset */
} clk_answer;

/* Opens a session, with the request frame in the caller's slot. On CLK_OK, `session` and `answer` are set. Returns CLK_MEMORY if 256 sessions are
 * already open. If a debugger stops the JVM, returns CLK_PENDING with `session` set, and clk_session_wait returns the result later. For the
 * other errors, see clk_step. After an error, no session was opened. */
CLK_API int32_t clk_session_open(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_session *session, clk_answer *answer);

/* Steps a session, with the request frame in the caller's slot. After an error, the session is in the same state as before the call, except after
 * CLK_SESSION_FAILED and CLK_JVM_LOST. After these two, Java threads that did not end may still read the request, so the memory of its slot is never
 * reused. Release this slot and acquire another. */
CLK_API int32_t clk_step(clk_session session, clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* Waits at most wait_ms, which may be 0, for a pending open or step. Returns its result, or CLK_PENDING if it has not ended.
 *
 * The time while a debugger is attached to the JVM does not count towards time limits. An open or step then returns CLK_PENDING if it takes longer than
 * 100 ms, so that the caller is not blocked while the debugger stops the JVM. Until the open or step has ended, its slot stays in use, and all other
 * calls that need the engine thread return CLK_TIMEOUT, except clk_session_close and clk_jvm_stop. A clk_control that a debugger stops returns
 * CLK_TIMEOUT after 1 s. */
CLK_API int32_t clk_session_wait(clk_session session, int32_t wait_ms, clk_answer *answer);

/* Closes a session and releases its answer. If a debugger stops the JVM, the host closes the session later. Returns CLK_HANDLE if the session was
 * already closed. */
CLK_API int32_t clk_session_close(clk_session session, int32_t limit_ms);

/* ---- Control --------------------------------------------------------------------------------------------------------- */

/* Calls the host outside any session, with the request frame in the caller's slot. */
CLK_API int32_t clk_control(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* ---- Logs and counters ----------------------------------------------------------------------------------------------- */

enum clk_log_level { CLK_LOG_DEBUG = 0, CLK_LOG_INFO = 1, CLK_LOG_WARNING = 2, CLK_LOG_ERROR = 3 };

/* Removes the oldest line from the log and copies it to `buffer`, NUL-terminated. Returns the length of the copy, or -1 if the log is empty. A line
 * that is longer than capacity - 1 bytes is truncated after a whole character. No line is longer than 8191 bytes. If `level` is not NULL, it is set to
 * one of enum clk_log_level. If `buffer` is NULL, the line is discarded and the result is 0. The log has room for 256 KiB, and clk_stats counts
 * the lines that did not fit. */
CLK_API int32_t clk_log_read(int32_t *level, char *buffer, int32_t capacity);

/* Counters, which start at 0 with the process unless stated otherwise. */
typedef struct clk_stats {
    uint32_t size;
    int32_t sessions;        /* number of sessions that are open now */
    int32_t slots;           /* number of slots that are acquired now, including those of answers */
    int32_t process;         /* id of the JVM's own process, even after its end; 0 if the JVM runs in this process */
    uint64_t steps;          /* calls of clk_step that reached the host */
    uint64_t slot_bytes;     /* size of the pool now, in use or not */
    uint64_t wrapped;        /* direct ByteBuffers that were created */
    uint64_t logs_dropped;   /* log lines that did not fit */
    uint64_t signal_repairs; /* signal handlers of HotSpot that another library replaced and the shim restored */
} clk_stats;

/* Fills in the fields of `stats` that fit in its size. Does not wait for the engine thread. */
CLK_API int32_t clk_get_stats(clk_stats *stats);

#ifdef __cplusplus
}
#endif

#endif
