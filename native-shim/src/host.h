/*
 * The two Java classes of docs/boundary.md: calls of the host's entries, and the natives that the host calls. Engine thread only, unless
 * said otherwise; functions that return int32_t set the last error when they fail.
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

/* Loads and binds the classes: the first call of all but host_refuse_exit. CLK_HOST. */
int32_t host_bind(JNIEnv *environment);

/* Calls Host.start() and copies the version line that it returns. CLK_HOST. */
int32_t host_start(char *version, int32_t capacity);

/* Runs the call and fills in its result. A code of the host's, CLK_HOST or CLK_JAVA. */
int32_t host_run(struct host_call *call);

/* Calls Host.close(). CLK_JAVA. */
int32_t host_close(clk_session session);

/* Calls Host.stop() and sets `idle`: whether no thread is left that DestroyJavaVM would wait for. CLK_JAVA, with `idle` unchanged. */
int32_t host_stop(int32_t limit_ms, bool *idle);

/* Runs the shutdown hooks, as DestroyJavaVM does after the last thread. False when this JVM's private names differ. */
bool host_run_exit_hooks(void);

/* Makes System.exit and Runtime.halt throw SecurityException. False when this JVM's private names differ. */
bool host_refuse_exit(JNIEnv *environment);

/* Direct ByteBuffers made since the start. Any thread. */
uint64_t host_wrapped(void);

#endif
