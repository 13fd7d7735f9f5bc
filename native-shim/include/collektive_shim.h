/*
 * collektive_shim - a HotSpot JVM inside the caller's process, driven through pooled native memory.
 *
 * Introduction
 *   A process has at most one JVM; JNI allows no second one. clk_jvm_start makes it on an engine thread that the shim owns, and only that
 *   thread calls into Java. The caller's threads wait for it on a semaphore, with a time limit: they never enter Java, and Java threads
 *   never enter the caller. The JVM outlives the code that started it: a reloaded caller finds it with clk_jvm_state.
 *
 *   The *host* is the Java code that serves calls. A *frame* is what caller and host exchange: bytes that the shim passes on unread.
 *   A *slot* is native memory from a pool, wrapped as a direct ByteBuffer once. A *session* is a state that the host keeps between calls.
 *
 *   There are three kinds of call: open a session, step a session, and control, which needs no session. Each passes the request
 *   frame in the bytes [offset, offset + length) of a slot to the host, and returns where the answer frame lies, in a slot of the
 *   shim's. Nothing is copied.
 *
 * Threads
 *   Any thread may call any function. Calls that need the engine thread (start, check, open, step, close, control, stop) take turns.
 *   A caller waits for its turn within its own limit; when that passes, it gets CLK_TIMEOUT and nothing was done. A host that has not
 *   answered 10 s after the limit of its call loses the JVM: CLK_JVM_LOST. In a forked child process the JVM counts as lost.
 *
 * Errors
 *   Functions return CLK_OK or a negative code of CLK_ERRORS, unless said otherwise. clk_last_error then gives the calling thread's error
 *   text: what happened, to what, and what to do next.
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

/* Major << 16 | minor << 8 | patch. Another major version has another ABI. */
#define CLK_VERSION 0x000200

/* FRAME, SCHEMA, PROGRAM and SESSION_FAILED are answers of the host, with its error text. */
#define CLK_ERRORS(X)                                                                             \
    X(OK, 0, "success")                                                                           \
    X(ARGUMENT, -1, "an argument is out of range")                                                \
    X(MEMORY, -2, "out of native memory")                                                         \
    X(HANDLE, -3, "the handle is stale or was never given out")                                   \
    X(TIMEOUT, -4, "the time limit passed before the engine answered")                            \
    X(JVM_NOT_FOUND, -5, "no usable JVM at the given place")                                      \
    X(JVM_OPTIONS, -6, "the JVM refuses these options")                                           \
    X(JVM_START, -7, "the JVM could not be created")                                              \
    X(JVM_LOST, -8, "the JVM is lost; restart the process to get a new one")                      \
    X(JVM_NOT_RUNNING, -9, "no JVM is running")                                                   \
    X(JVM_RUNNING, -10, "a JVM runs already with other settings")                                 \
    X(HOST, -11, "the host classes are missing or do not fit this shim")                          \
    X(FRAME, -12, "the frame is damaged or breaks a rule; it changed nothing")                    \
    X(SCHEMA, -13, "the two sides were generated from different schemas")                         \
    X(PROGRAM, -14, "a program cannot be loaded")                                                 \
    X(SESSION_FAILED, -15, "the session ended after a round that did not finish; open a new one") \
    X(JAVA, -16, "the host threw an unexpected exception; the session goes on from its last good tick")

enum clk_error {
#define CLK_X(name, code, text) CLK_##name = (code),
    CLK_ERRORS(CLK_X)
#undef CLK_X
};

enum clk_jvm_state {
    CLK_STATE_NONE = 0,    /* never started in this process */
    CLK_STATE_RUNNING = 1, /* it serves calls */
    CLK_STATE_LOST = 2,    /* it exited, aborted or does not answer; this process gets no other */
    CLK_STATE_STOPPED = 3  /* ended by clk_jvm_stop; this process gets no other */
};

/* ---- Version and errors ---------------------------------------------------------------------------------------------- */

/* CLK_VERSION of the library that was loaded. */
CLK_API uint32_t clk_version(void);

/* The name of a code, such as "CLK_FRAME" for -12; "CLK_UNKNOWN" for any other number. Static storage. */
CLK_API const char *clk_error_name(int32_t code);

/* The text of a code in CLK_ERRORS. Static storage. */
CLK_API const char *clk_error_text(int32_t code);

/* Copies the text of the calling thread's last error to `buffer`, with NUL; a longer text is cut at a character. Returns the length of the
 * whole text in bytes, without NUL; 0 when there was no error. `buffer` may be NULL when `capacity` is 0. */
CLK_API int32_t clk_last_error(char *buffer, int32_t capacity);

/* ---- JVM ------------------------------------------------------------------------------------------------------------- */

/* What the JVM is started with. */
typedef struct clk_jvm_config {
    uint32_t size;
    int32_t option_count;       /* number of `options`, 0 or greater */
    const char *home;           /* root of a JRE or JDK: its lib/server/libjvm.so (bin/server/jvm.dll on Windows) is loaded */
    const char *class_path;     /* jars of the host, with the platform's separator */
    const char *const *options; /* JVM options, one string each, in order; may be NULL when option_count is 0 */
    int32_t start_limit_ms;     /* limit of the whole call; 1 or greater */
    int32_t check_options;      /* not 0: first try the options in a child process (recommended, as wrong ones can end the process) */
} clk_jvm_config;

/* Starts the JVM. If one runs already, returns CLK_OK for an equal configuration and CLK_JVM_RUNNING for another.
 * When the checks fail, nothing has happened and a later start may succeed; when JNI_CreateJavaVM or what follows fails, the state is
 * CLK_STATE_LOST. Options that endanger the process are refused. JAVA_TOOL_OPTIONS, _JAVA_OPTIONS and JDK_JAVA_OPTIONS are ignored. */
CLK_API int32_t clk_jvm_start(const clk_jvm_config *config);

/* Runs the checks of clk_jvm_start: files, refused options and, when check_options is not 0, all options in a child process (50 to 200 ms).
 * Does not touch the JVM, whatever its state. A start with the configuration that passed last skips the child process. */
CLK_API int32_t clk_jvm_check(const clk_jvm_config *config);

/* Returns one of enum clk_jvm_state. Does not wait. */
CLK_API int32_t clk_jvm_state(void);

/* Copies the description of the JVM that was started, "home\nversion\noption\noption...", and returns its length, both as
 * clk_last_error does. CLK_JVM_NOT_RUNNING when none was started. */
CLK_API int32_t clk_jvm_description(char *buffer, int32_t capacity);

/* Ends the JVM before the process ends; no JVM can follow. Closes all sessions, runs the JVM's shutdown hooks (which save flight
 * recordings) and destroys it. Java threads that do not end are halted where they are.
 *   CLK_OK        the JVM has ended, or none was ever started
 *   CLK_TIMEOUT   not all of this was done within the limit. If possible, the JVM's threads were halted, so that the process may exit; the
 *                 state is then CLK_STATE_STOPPED. Halting takes up to 10 s more: it waits for a garbage collection to end.
 *   CLK_JVM_LOST  the JVM was lost; if possible, its threads were halted */
CLK_API int32_t clk_jvm_stop(int32_t limit_ms);

/* ---- Slots ----------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_slot; /* 0 is never a slot; the upper half is the generation */

/* The memory of a slot, for its owner to read and write. It stays where it is until the slot grows or is released. */
typedef struct clk_memory {
    uint32_t size;
    int32_t capacity; /* bytes */
    uint8_t *address; /* aligned to 64 bytes */
} clk_memory;

/* Takes a slot of at least `capacity` bytes (1..2^30) from the pool. The caller owns it until clk_slot_release. Its content is undefined.
 * Needs no JVM, and may outlive it. */
CLK_API int32_t clk_slot_acquire(int32_t capacity, clk_slot *slot, clk_memory *memory);

/* Grows a slot that the caller owns to at least `capacity` bytes (1..2^30); a slot that is large enough stays as it is. Copies the
 * last `keep` bytes of the old memory to the end of the new, as frames may be written from the back. The old address is then
 * invalid. CLK_ARGUMENT while a call uses the slot. */
CLK_API int32_t clk_slot_grow(clk_slot slot, int32_t capacity, int32_t keep, clk_memory *memory);

/* Releases a slot. A call that uses it keeps the memory until it ends; then the pool reuses it. The pool keeps up to 64 MiB of unused
 * memory and returns the rest to the system. */
CLK_API int32_t clk_slot_release(clk_slot slot);

/* ---- Sessions -------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_session; /* 0 is never a session; the upper half is the generation */

/* Where an answer frame lies. The memory is the shim's, for reading only. It is valid until the next call of the same session or its close;
 * that of clk_control until the next clk_control; all until clk_jvm_stop. */
typedef struct clk_answer {
    uint32_t size;
    int32_t offset;   /* of the frame, in bytes from `address` */
    int32_t length;   /* of the frame, in bytes */
    int32_t capacity; /* of the slot, in bytes */
    uint8_t *address; /* of the slot's first byte; the frame begins at address + offset */
} clk_answer;

/* Opens a session, with the request frame in the caller's slot. On CLK_OK `session` and `answer` are set, otherwise there is no session.
 * At most 256 can be open: CLK_MEMORY. About errors see clk_step. */
CLK_API int32_t clk_session_open(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_session *session, clk_answer *answer);

/* Steps a session, with the request frame in the caller's slot. After an error the session is as it was before the call, except after
 * CLK_SESSION_FAILED and CLK_JVM_LOST. After these two, Java threads that did not end may still read the request, so its slot stays in
 * use for ever: release it and acquire another. */
CLK_API int32_t clk_step(clk_session session, clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* Closes a session and releases its answer. CLK_HANDLE when it is closed already. */
CLK_API int32_t clk_session_close(clk_session session, int32_t limit_ms);

/* ---- Control --------------------------------------------------------------------------------------------------------- */

/* Calls the host outside of any session, with the request frame in the caller's slot. */
CLK_API int32_t clk_control(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* ---- Logs and counters ----------------------------------------------------------------------------------------------- */

enum clk_log_level { CLK_LOG_DEBUG = 0, CLK_LOG_INFO = 1, CLK_LOG_WARNING = 2, CLK_LOG_ERROR = 3 };

/* Removes the oldest line from the log, copies it to `buffer`, with NUL, and returns the length of the copy; -1 when the log is
 * empty. A line longer than capacity - 1 bytes is cut at a character; none is longer than 8191. `level` (may be NULL) is set to one
 * of enum clk_log_level. With `buffer` NULL the line is lost and the result 0. The log holds 256 KiB; clk_stats counts lines that did
 * not fit. */
CLK_API int32_t clk_log_read(int32_t *level, char *buffer, int32_t capacity);

/* Counts since the process began, unless said otherwise. */
typedef struct clk_stats {
    uint32_t size;
    int32_t sessions;        /* open now */
    int32_t slots;           /* taken from the pool now, including those of answers */
    int32_t reserved;        /* always 0 */
    uint64_t steps;          /* calls of clk_step that reached the host */
    uint64_t slot_bytes;     /* memory of the pool, in use or not */
    uint64_t wrapped;        /* direct ByteBuffers made since the start */
    uint64_t logs_dropped;   /* log lines that did not fit */
    uint64_t signal_repairs; /* signal handlers of HotSpot that another library had replaced and the shim put back */
} clk_stats;

/* Fills `stats` up to its size. Does not wait for the engine thread. */
CLK_API int32_t clk_get_stats(clk_stats *stats);

#ifdef __cplusplus
}
#endif

#endif
