/*
 * The two Java classes of docs/boundary.md: `Host`, whose methods the shim calls, and `Shim`, whose native methods the host calls. Only the engine
 * thread may call these functions, unless stated otherwise. Functions that return int32_t set the last error when they fail.
 */
#ifndef COLLEKTIVE_HOST_H
#define COLLEKTIVE_HOST_H

#include <jni.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "slots.h"

/* The methods of the host. The first three are calls with frames. Do not pass HOST_STOP to host_run; use host_stop. */
enum host_entry { HOST_OPEN, HOST_STEP, HOST_CONTROL, HOST_CLOSE, HOST_STOP };
#define HOST_CALLS 3

/* One call of the host. HOST_CLOSE uses only `session`. The caller pins `request` and `answer` before the call, and unpins all blocks after it. */
struct host_call {
    enum host_entry entry;
    clk_session session;
    struct block *request;
    int32_t offset;
    int32_t length;
    clk_slot slot;         /* slot of the answer */
    struct block *answer;  /* the block of `slot`; Shim.grow exchanges it */
    struct block *retired; /* blocks that Shim.grow replaced, still pinned */
    int32_t limit_ms;
    int32_t answer_offset; /* result */
    int32_t answer_length;
    /* Exchanges `answer` for a block of at least `capacity` bytes. On failure, sets the last error and returns false. */
    bool (*grow)(struct host_call *call, int32_t capacity);
};

/* Loads the two classes, calls Host.start() and copies the version line that it returns. Also makes System.exit and Runtime.halt throw
 * SecurityException, if this JVM has their private methods. Call this function before the others. Error: CLK_HOST. */
int32_t host_start(JNIEnv *environment, char *version, int32_t capacity);

/* Copies a Java string as UTF-8. Does not allocate, because the heap may be full. The JVM's other threads may also call this function. */
void host_text(JNIEnv *environment, jstring string, char *buffer, int32_t capacity);

/* Runs the call and fills in its result. Errors: those of the host, CLK_HOST and CLK_JAVA. */
int32_t host_run(struct host_call *call);

/* Calls Host.stop(). Returns false if threads of programs are still running, for which DestroyJavaVM would wait. */
bool host_stop(int32_t limit_ms);

/* Runs the shutdown hooks without waiting for other threads, for which DestroyJavaVM would wait. False if this JVM lacks the private method. */
bool host_run_exit_hooks(void);

/* Returns whether a debugger is attached to the JVM, as Shim.debugger last reported. Any thread. */
bool host_is_debugged(void);

/* Returns the number of direct ByteBuffers created. Any thread. */
uint64_t host_wrapped(void);

/* The two values above. host_share moves them to memory that both processes share; call it before the JVM starts. */
struct host_state {
    atomic_bool debugged;
    _Atomic uint64_t wrapped;
};
void host_share(struct host_state *shared);

#endif
