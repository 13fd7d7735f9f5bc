/* The JVM's own process. Its engine thread serves the calls that arrive through the shared memory. */
#include <jni.h>
#include <stdlib.h>
#include "channel.h"
#include "collektive_shim.h"
#include "engine.h"
#include "error.h"
#include "host.h"
#include "log.h"
#include "prim.h"
#include "slots.h"
#include "text.h"

static struct {
    uint8_t *memory;
    struct channel *channel;
    struct block **blocks; /* by offset / CHANNEL_ALIGNMENT; NULL before their first use */
} serve;

/* Returns the block of this process for a block of the parent. The same block is returned each time, so its ByteBuffer is created only once. If out
 * of memory, sets the last error and returns NULL. */
static struct block *block_at(const struct block *place) {
    struct block **block = &serve.blocks[place->offset / CHANNEL_ALIGNMENT];
    if (*block != NULL) return *block;
    *block = malloc(sizeof **block);
    if (*block == NULL) {
        error_set(CLK_MEMORY, "out of memory in the JVM's process for a slot of %d bytes", place->capacity);
    } else {
        **block = (struct block){.address = serve.memory + place->offset, .capacity = place->capacity};
    }
    return *block;
}

/* Sends a result to the parent. Posts `done` last, because the parent reads the result after it. */
static void answer(int32_t result) {
    serve.channel->result = result;
    if (result < 0) text_export(error_last(), serve.channel->text, ERROR_CAPACITY);
    prim_semaphore_post(&serve.channel->done);
}

static enum host_entry await_request(void) {
    prim_semaphore_wait(&serve.channel->request);
    return serve.channel->call.entry;
}

static bool grow(struct host_call *call, int32_t capacity) {
    serve.channel->capacity = capacity;
    answer(CHANNEL_GROW);
    await_request();
    if (serve.channel->result != CLK_OK) {
        error_set(CLK_MEMORY, "%s", serve.channel->text);
        return false;
    }
    struct block *block = block_at(&serve.channel->answer_block);
    if (block != NULL) call->answer = block;
    return block != NULL;
}

static int32_t run(void) {
    struct host_call *call = &serve.channel->call;
    if (call->entry == HOST_CLOSE) return host_run(call);
    call->request = block_at(&serve.channel->request_block);
    call->answer = block_at(&serve.channel->answer_block);
    call->grow = grow;
    return call->request != NULL && call->answer != NULL ? host_run(call) : CLK_MEMORY;
}

/* Stops the host. After the return of serve(), DestroyJavaVM waits for the other threads. If threads of programs do not end, runs the shutdown hooks
 * and ends the process here. */
static void stop(int32_t limit_ms) {
    if (!host_stop(limit_ms / 2) && host_run_exit_hooks()) _Exit(0);
}

/* org.collektive.host.Main.serve(token), which returns when the JVM must end. Uses CLK_API instead of JNIEXPORT, because jni_md.h may be that of
 * another platform (see CMakeLists.txt). */
CLK_API void JNICALL Java_org_collektive_host_Main_serve(JNIEnv *env, jclass class, jstring token);

CLK_API void JNICALL Java_org_collektive_host_Main_serve(JNIEnv *env, jclass class, jstring token) {
    char text[64];
    (void)class;
    host_text(env, token, text, sizeof text);
    serve.memory = prim_child_attach(text);
    serve.channel = (struct channel *)(void *)serve.memory;
    serve.blocks = calloc(PRIM_SHARED_BYTES / CHANNEL_ALIGNMENT, sizeof(struct block *)); /* pages that are not used need no memory */
    const char *problem = serve.memory == NULL || serve.blocks == NULL
                              ? "cannot map the memory of the caller; free memory or raise the thread limit"
                          : serve.channel->version != CLK_VERSION || serve.channel->size != sizeof *serve.channel
                              ? "the caller has a shim of another version; reinstall the package"
                              : NULL;
    if (problem != NULL) {
        (*env)->ThrowNew(env, (*env)->FindClass(env, "java/lang/IllegalStateException"), problem);
        return;
    }
    log_share(&serve.channel->log, true);
    host_share(&serve.channel->state);
    engine_adopt();
    int32_t result = host_start(env, serve.channel->text, ERROR_CAPACITY);
    answer(result);
    if (result != CLK_OK) return;
    while (await_request() != HOST_STOP) answer(run());
    stop(serve.channel->call.limit_ms);
}
