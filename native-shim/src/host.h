/*
 * The two Java classes of docs/boundary.md: calls of the host's entries, and the native methods that the host calls. Engine thread only,
 * unless stated otherwise. Functions that return int32_t set the last error when they fail.
 */
#ifndef COLLEKTIVE_HOST_H
#define COLLEKTIVE_HOST_H

#include <jni.h>
#include <stdbool.h>
#include <stdint.h>
#include "slots.h"

enum host_entry { HOST_OPEN, HOST_STEP, HOST_CONTROL, HOST_ENTRIES };

/* One call of Host.open, Host.step or Host.control. The caller pins `request` and `answer` before, and unpins all blocks afterwards. */
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
};

/* Loads and binds the classes. Call it before any other function except host_refuse_exit. Errors: CLK_HOST. */
int32_t host_bind(JNIEnv *environment);

/* Calls Host.start() and copies the version line that it returns. Errors: CLK_HOST. */
int32_t host_start(char *version, int32_t capacity);

/* Runs the call and fills in its result. Errors: those of the host, CLK_HOST and CLK_JAVA. */
int32_t host_run(struct host_call *call);

/* Calls Host.close(). Errors: CLK_JAVA. */
int32_t host_close(clk_session session);

/* Calls Host.stop() and sets `idle` to whether DestroyJavaVM has no thread to wait for. Errors: CLK_JAVA, with `idle` unchanged. */
int32_t host_stop(int32_t limit_ms, bool *idle);

/* Runs the shutdown hooks, as DestroyJavaVM does after the last thread. False if this JVM lacks the private method. */
bool host_run_exit_hooks(void);

/* Makes System.exit and Runtime.halt throw SecurityException. False if this JVM lacks the private methods. */
bool host_refuse_exit(JNIEnv *environment);

/* Returns the number of direct ByteBuffers created since the start. Any thread. */
uint64_t host_wrapped(void);

#endif
