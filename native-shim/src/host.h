/*
 * The two Java classes of docs/boundary.md: calls of the host's entries, and the native methods that the host calls. Engine thread only,
 * unless stated otherwise. Functions that return int32_t set the last error when they fail.
 */
#ifndef COLLEKTIVE_HOST_H
#define COLLEKTIVE_HOST_H

#include <jni.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "slots.h"

/* The first three are calls with frames. HOST_STOP is not for host_run. */
enum host_entry { HOST_OPEN, HOST_STEP, HOST_CONTROL, HOST_CLOSE, HOST_STOP };
#define HOST_CALLS 3

/* One call of the host; for HOST_CLOSE only `session` is set. The caller pins `request` and `answer` before, and unpins all blocks
 * afterwards. */
struct host_call {
    enum host_entry entry;
    clk_session session;
    struct block *request;
    int32_t offset;
    int32_t length;
    clk_slot slot;         /* for the answer */
    struct block *answer;  /* the block of `slot`; Shim.grow exchanges it */
    struct block *retired; /* the blocks that it replaced, still pinned */
    int32_t limit_ms;
    int32_t answer_offset; /* result */
    int32_t answer_length;
    /* Exchanges `answer` for a block of at least `capacity` bytes. False on failure, with the last error set. */
    bool (*grow)(struct host_call *call, int32_t capacity);
};

/* Loads and binds the classes, makes System.exit and Runtime.halt throw SecurityException, if this JVM has their private methods, and copies
 * the version line of Host.start(). Call it before any other function. Errors: CLK_HOST. */
int32_t host_start(JNIEnv *environment, char *version, int32_t capacity);

/* Copies a Java string as UTF-8 without allocating, as the heap may be full. The JVM's other threads may call it too. */
void host_text(JNIEnv *environment, jstring string, char *buffer, int32_t capacity);

/* Runs the call and fills in its result. Errors: those of the host, CLK_HOST and CLK_JAVA. */
int32_t host_run(struct host_call *call);

/* Calls Host.stop(). False if DestroyJavaVM would wait for threads of programs. */
bool host_stop(int32_t limit_ms);

/* Runs the shutdown hooks, as DestroyJavaVM does after the last thread. False if this JVM lacks the private method. */
bool host_run_exit_hooks(void);

/* Returns whether a debugger is attached to the JVM, as Shim.debugger last reported. Any thread. */
bool host_is_debugged(void);

/* Returns the number of direct ByteBuffers created. Any thread. */
uint64_t host_wrapped(void);

/* Keeps both in memory of both processes. Before the start of the JVM. */
struct host_state {
    atomic_bool debugged;
    _Atomic uint64_t wrapped;
};
void host_share(struct host_state *shared);

#endif
