/*
 * collektive_shim - a HotSpot JVM inside the host process, driven through pooled native memory.
 *
 * Introduction
 *   One JVM per process (JNI allows no more), started on an engine thread of the shim's own. Every call into Java is made
 *   by that thread; the caller waits on a semaphore with a time limit. Callers' threads never enter Java, Java threads
 *   never enter the caller. The JVM outlives its users: a fresh C# domain finds it with clk_jvm_state().
 *
 *   A *slot* is native memory from a pool, wrapped as a direct ByteBuffer once. A *session* is one simulation on the JVM;
 *   it owns one slot for its answers. A step hands the bytes [offset, offset + length) of a request slot to the host
 *   (org.collektive.host.Host) and returns where in the session's answer slot the answer lies. Nothing is copied.
 *
 * Threads
 *   All functions may be called from any thread. Calls that need the engine (start, open, step, close, control, stop) are served
 *   one at a time; a second caller waits its turn within its own limit, and gets CLK_TIMEOUT with nothing done when that
 *   passes. A call whose host does not come back within its limit and 10 s more loses the JVM: CLK_JVM_LOST. In a forked
 *   child process the JVM counts as lost.
 *
 * Errors
 *   Functions return CLK_OK or a negative code of CLK_ERRORS. clk_last_error() gives the whole text of the calling
 *   thread's last failure: what happened, to what, and what to do next.
 *
 * Structs of the caller
 *   Each begins with `size`, set by the caller to sizeof(struct): later versions append fields. Smaller ones than this
 *   header's are CLK_ARGUMENT, but for clk_stats; fields of a larger clk_jvm_config must be 0.
 *
 * Strings are UTF-8 and ended by NUL. Pointers passed in are only read during the call.
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
#define CLK_VERSION 0x000100

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
    CLK_STATE_NONE = 0, /* never started in this process */
    CLK_STATE_RUNNING = 1,
    CLK_STATE_LOST = 2,   /* exited, aborted or does not answer: every later call of the JVM returns CLK_JVM_LOST */
    CLK_STATE_STOPPED = 3 /* destroyed in order; cannot be started again in this process */
};

/* ---- Version and errors ---------------------------------------------------------------------------------------------- */

/* CLK_VERSION of the library that was loaded. */
CLK_API uint32_t clk_version(void);

/* "CLK_FRAME" for -12; "CLK_UNKNOWN" for a code that is none. Static storage. */
CLK_API const char *clk_error_name(int32_t code);

/* The general text of a code. Static storage. */
CLK_API const char *clk_error_text(int32_t code);

/* Copies the calling thread's last error text to `buffer` (NUL-ended, cut at a character if need be) and returns the length of
 * the whole text without NUL. `buffer` may be NULL when `capacity` is 0. */
CLK_API int32_t clk_last_error(char *buffer, int32_t capacity);

/* ---- JVM ------------------------------------------------------------------------------------------------------------- */

typedef struct clk_jvm_config {
    uint32_t size;
    int32_t option_count;
    const char *home;           /* root of a JRE or JDK: its lib/server/libjvm.so (bin/server/jvm.dll on Windows) is loaded */
    const char *class_path;     /* jars of the host, separated as the platform does */
    const char *const *options; /* JVM options, each one word, in order; may be NULL when option_count is 0 */
    int32_t start_limit_ms;     /* for the whole start; 1 or greater */
    int32_t check_options;      /* not 0: try the options in a child process first (recommended: some end the process) */
} clk_jvm_config;

/* Starts the JVM; CLK_OK too when one runs with an equal configuration, CLK_JVM_RUNNING when its configuration differs.
 * A start that fails before JNI_CreateJavaVM may be tried again; after it the state is CLK_STATE_LOST.
 * Refused are options that endanger the process. JAVA_TOOL_OPTIONS, _JAVA_OPTIONS and JDK_JAVA_OPTIONS are ignored. */
CLK_API int32_t clk_jvm_start(const clk_jvm_config *config);

/* Tries what clk_jvm_start would do before it makes the JVM: files, refused options, and (when check_options is not 0) the
 * options in a child process, some 50 to 200 ms. Whatever JVM runs is left alone. A configuration found good is not tried again
 * at the start. */
CLK_API int32_t clk_jvm_check(const clk_jvm_config *config);

/* One of enum clk_jvm_state. Never waits. */
CLK_API int32_t clk_jvm_state(void);

/* Copies the description of the JVM that was started, "home\nversion\noption\noption...", like clk_last_error does. Without
 * one CLK_JVM_NOT_RUNNING. */
CLK_API int32_t clk_jvm_description(char *buffer, int32_t capacity);

/* Closes all sessions, saves flight recordings and destroys the JVM on the engine thread. For the end of the process only: no JVM
 * can follow. Programs' threads that do not end are halted where they are. With CLK_TIMEOUT not all of that was done in time; the
 * JVM's threads are then halted if possible (the state tells), so that the process may exit; that may take 10 s more, until a
 * collection has ended. A lost JVM is halted so too, where it can be. CLK_OK when none was ever started. */
CLK_API int32_t clk_jvm_stop(int32_t limit_ms);

/* ---- Slots ----------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_slot; /* 0 is never a slot; the upper half is the generation */

typedef struct clk_memory {
    uint32_t size;
    int32_t capacity; /* bytes */
    uint8_t *address; /* aligned to 64 bytes */
} clk_memory;

/* Takes a slot of at least `capacity` bytes (1..2^30) from the pool. The caller owns it until clk_slot_release.
 * Needs no JVM. */
CLK_API int32_t clk_slot_acquire(int32_t capacity, clk_slot *slot, clk_memory *memory);

/* Makes an own slot at least `capacity` bytes large; one that is large enough stays as it is. The last `keep` bytes of the
 * old memory become the last bytes of the new (FlatBuffers are built from the back). The old address is invalid afterwards.
 * CLK_ARGUMENT while a call uses the slot. */
CLK_API int32_t clk_slot_grow(clk_slot slot, int32_t capacity, int32_t keep, clk_memory *memory);

/* Gives a slot back. Its memory stays in the pool for the next one who asks (up to 64 MiB unused, the rest goes back to the
 * system). A call that uses it at this moment keeps the memory until it ends. */
CLK_API int32_t clk_slot_release(clk_slot slot);

/* ---- Sessions -------------------------------------------------------------------------------------------------------- */

typedef uint64_t clk_session; /* 0 is never a session; the upper half is the generation */

/* Where an answer lies. Valid until the session's next call or its close. */
typedef struct clk_answer {
    uint32_t size;
    int32_t offset;
    int32_t length;
    int32_t capacity;
    uint8_t *address; /* of the slot's first byte: the answer begins at address + offset */
} clk_answer;

/* Opens a session with the OpenRequest in the slot; the answer holds an OpenResponse. At most 256 are open at a time. */
CLK_API int32_t clk_session_open(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_session *session, clk_answer *answer);

/* Runs one tick with the StepRequest in the slot; the answer holds a StepResponse. After any error but CLK_SESSION_FAILED and
 * CLK_JVM_LOST the session is as before the call. After these two the slot counts as in use for ever, as a round that does not
 * end may read it: release it and acquire another. */
CLK_API int32_t clk_step(clk_session session, clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* Closes a session and gives its answer slot back. CLK_HANDLE when it is closed already. */
CLK_API int32_t clk_session_close(clk_session session, int32_t limit_ms);

/* ---- Control --------------------------------------------------------------------------------------------------------- */

/* Asks about the JVM itself, or starts and stops its recording: the slot holds a ControlRequest, the answer a ControlResponse,
 * valid until the next control. Needs no session; what takes long goes on in the background, so that no step waits for it. */
CLK_API int32_t clk_control(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer);

/* ---- Logs and counters ----------------------------------------------------------------------------------------------- */

enum clk_log_level { CLK_LOG_DEBUG = 0, CLK_LOG_INFO = 1, CLK_LOG_WARNING = 2, CLK_LOG_ERROR = 3 };

/* Takes the oldest log line from the ring: copies it to `buffer` (cut to capacity - 1) and returns its length there, or -1
 * when there is none. `level` (may be NULL) gets one of enum clk_log_level. A line has at most 8191 bytes. The ring holds
 * 256 KiB; lines that did not fit are counted in clk_stats. */
CLK_API int32_t clk_log_read(int32_t *level, char *buffer, int32_t capacity);

typedef struct clk_stats {
    uint32_t size;
    int32_t sessions;    /* open now */
    int32_t slots;       /* taken from the pool now, the sessions' own included */
    int32_t reserved;    /* always 0 */
    uint64_t steps;      /* calls of clk_step that reached the host */
    uint64_t slot_bytes; /* memory that the pool holds */
    uint64_t wrapped;    /* direct ByteBuffers made since the start */
    uint64_t logs_dropped;
    uint64_t signal_repairs; /* times that HotSpot's signal handlers had to be put back */
} clk_stats;

/* Fills `stats` up to its size. Never waits. */
CLK_API int32_t clk_get_stats(clk_stats *stats);

#ifdef __cplusplus
}
#endif

#endif
