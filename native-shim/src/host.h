/*
 * The two Java classes of docs/boundary.md: org.collektive.host.Host, which is called here, and org.collektive.host.Shim,
 * whose natives are here. Engine thread only, unless said otherwise.
 */
#ifndef COLLEKTIVE_HOST_H
#define COLLEKTIVE_HOST_H

#include <jni.h>
#include <stdbool.h>
#include <stdint.h>
#include "slots.h"

enum host_entry { HOST_OPEN, HOST_STEP, HOST_CONTROL, HOST_ENTRIES };

/* One call of Host.open, Host.step or Host.control. The blocks are pinned by the caller, who unpins them afterwards. */
struct host_call {
    enum host_entry entry;
    clk_session session;
    struct block *request;
    int32_t offset;
    int32_t length;
    clk_slot slot;         /* for the answer */
    struct block *answer;  /* of this slot; another one after Shim.grow */
    struct block *retired; /* what it had before, still pinned */
    int32_t limit_ms;
    int32_t answer_offset; /* result */
    int32_t answer_length;
};

/* Finds and binds the classes. The environment is the engine thread's. */
int32_t host_bind(JNIEnv *environment);

/* Host.start(): fills in the version line. */
int32_t host_start(char *version, int32_t capacity);

int32_t host_run(struct host_call *call);
int32_t host_close(clk_session session);

/* Fills in `idle` unless it fails: whether no thread of a program is left that the end of the JVM would wait for. */
int32_t host_stop(int32_t limit_ms, bool *idle);

/* Runs what DestroyJavaVM would run at the end of the last thread. False when this JVM has no place for that. */
bool host_run_exit_hooks(void);

/* Makes System.exit and Runtime.halt throw. False when this JVM has no place for that. */
bool host_refuse_exit(JNIEnv *environment);

/* Direct ByteBuffers made since the start. Any thread. */
uint64_t host_wrapped(void);

#endif
