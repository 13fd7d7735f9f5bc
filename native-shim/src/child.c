#include "child.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "channel.h"
#include "engine.h"
#include "error.h"
#include "log.h"
#include "prim.h"
#include "slots.h"
#include "text.h"

#define STACK_BYTES ((size_t)256 * 1024)
#define MAIN_CLASS "org.collektive.host.Main"
#define OUTPUT_SHOWN 600
#define REAP_LIMIT_MS 1000 /* maximum time from the end of the connection to the end of the child */
#define KILL_LIMIT_MS 10000

/* The turn guards all fields except atomics, semaphores, and the fields that the child's thread writes before it posts a semaphore. */
static struct {
    struct channel *channel; /* NULL before the first start */
    char **arguments;        /* command line of the child; NULL without a child */
    atomic_bool used;
    atomic_bool alive;
    prim_semaphore ended; /* posted when the child has ended, or cannot start */
    prim_mutex killing;   /* held to kill or reap `process` */
    prim_child process;
    _Atomic int32_t id;          /* 0 if the child could not start */
    char reason[ERROR_CAPACITY]; /* why the child did not start, or why it ended */
} child = {.killing = PRIM_MUTEX_INIT};

bool child_is_used(void) { return atomic_load_explicit(&child.used, memory_order_relaxed); }

void child_use(bool used) { atomic_store(&child.used, used); }

int32_t child_process(void) { return child_is_used() ? atomic_load(&child.id) : 0; }

/* ---- The child's thread ---------------------------------------------------------------------------------------------- */

/* Sets the reason why the child ended. If HotSpot has crashed, its output contains "# An error report file with more information is saved as:", and in
 * the next line "# " and the path of the report. */
static void describe_end(int status) {
    static const char announcement[] = "is saved as:; # ";
    char last[LOG_LAST_CAPACITY];
    log_jvm_last(last, sizeof last);
    const char *path = strstr(last, announcement);
    if (path != NULL) {
        path += sizeof announcement - 1;
        snprintf(child.reason, sizeof child.reason, "its process crashed; see %.*s", (int)strcspn(path, ";"), path);
        return;
    }
    size_t length = strlen(last);
    const char *shown = length > OUTPUT_SHOWN ? text_next_character(last + length - OUTPUT_SHOWN) : last;
    snprintf(child.reason, sizeof child.reason, "its process %s %d; it printed last: %s",
             status < 0 ? "was ended by signal" : "ended with exit code", status < 0 ? -status : status,
             shown[0] != '\0' ? shown : "nothing");
}

/* Waits until a child that has closed its connection exits, and kills it at a limit. Normally, the connection closes only because the child exits. */
static int reap(void) {
    int status = 0;
    int64_t limit = prim_now() + REAP_LIMIT_MS * PRIM_MILLI;
    for (bool ended = false; !ended;) {
        prim_lock(&child.killing);
        ended = prim_child_reap(&child.process, prim_now() + PRIM_MILLI, &status);
        if (!ended && prim_now() > limit) prim_child_kill(&child.process);
        prim_unlock(&child.killing);
    }
    return status;
}

static void announce(void) {
    if (engine_state() == CLK_STATE_RUNNING) engine_lose("%s", child.reason);
}

bool child_is_alive(void) {
    bool alive = atomic_load(&child.alive);
    if (!alive) announce();
    return alive;
}

/* The child's thread. It announces the loss before it clears `alive`, so that a call that sees a dead child also sees the reason. It announces the loss
 * again afterwards, because the start may have set the state to running in the meantime. */
static void child_main(void) {
    char output[4096];
    int32_t id = prim_child_start(child.arguments, true, &child.process, child.reason, sizeof child.reason);
    atomic_store(&child.id, id);
    atomic_store(&child.alive, id != 0);
    if (id != 0) {
        while (prim_child_read(&child.process, INT64_MAX, output, sizeof output)) log_jvm_text(CLK_LOG_INFO, output);
        describe_end(reap());
        announce();
        atomic_store(&child.alive, false);
        announce();
    }
    prim_semaphore_post(&child.channel->done);
    prim_semaphore_post(&child.ended);
}

/* ---- Start and end --------------------------------------------------------------------------------------------------- */

int32_t child_end(void) {
    if (child.arguments == NULL) return CLK_OK;
    prim_lock(&child.killing);
    prim_child_kill(&child.process);
    prim_unlock(&child.killing);
    if (!prim_semaphore_wait_until(&child.ended, prim_now() + KILL_LIMIT_MS * PRIM_MILLI))
        return error_set(CLK_TIMEOUT, "the JVM's process %d was killed but has not exited; try again later, or restart this process",
                         child_process());
    free(child.arguments);
    child.arguments = NULL;
    return CLK_OK;
}

/* Fills in the command line of the child. Two options come first: with the first, a crash leaves a report but no core dump. The second allows Main to
 * load the shim. */
static int32_t fill_arguments(const struct launch *launch) {
    static char java[4096], library[4096], token[64];
    static char main_class[] = MAIN_CLASS, no_core[] = "-XX:-CreateCoredumpOnCrash";
    static char native[] = "--enable-native-access=ALL-UNNAMED";
    snprintf(java, sizeof java, "%s/" PRIM_JAVA, launch->home);
    if (!prim_executable(java))
        return error_set(CLK_JVM_NOT_FOUND,
                         "%s is missing or not executable; make it executable, reinstall the JVM, or run the JVM in this process", java);
    if (!prim_library_path(library, sizeof library) || !prim_jvm_can_decode(library))
        return error_set(CLK_HOST, "the JVM cannot decode the path of the shim's library, or it is too long; move the package");
    prim_child_token(token, sizeof token);
    child.arguments = calloc((size_t)launch->option_count + 7, sizeof *child.arguments);
    if (child.arguments == NULL) return error_set(CLK_MEMORY, "out of memory for %d JVM options", launch->option_count);
    memcpy(child.arguments, (char *[]){java, no_core, native}, 3 * sizeof(char *));
    memcpy(child.arguments + 3, launch->options, (size_t)launch->option_count * sizeof(char *));
    memcpy(child.arguments + 3 + launch->option_count, (char *[]){main_class, library, token}, 3 * sizeof(char *));
    return CLK_OK;
}

static int32_t prepare_channel(void) {
    struct channel *channel = child.channel;
    if (channel == NULL) {
        child.channel = channel = (struct channel *)(void *)slots_share(CHANNEL_BYTES);
        if (channel == NULL) return CLK_MEMORY;
        prim_semaphore_init(&child.ended, 0);
        log_share(&channel->log, false);
        host_share(&channel->state);
    }
    log_jvm_clear();
    prim_semaphore_share(&channel->request);
    prim_semaphore_share(&channel->done);
    channel->version = CLK_VERSION;
    channel->size = sizeof *channel;
    atomic_store(&channel->state.debugged, false);
    channel->result = CHANNEL_SILENT;
    return CLK_OK;
}

/* Returns the text in the channel. Terminates it, because a child that crashed may have left it without a NUL. */
static const char *channel_text(void) {
    child.channel->text[ERROR_CAPACITY - 1] = '\0';
    return child.channel->text;
}

/* Waits for the child's first answer, which reports the result of the start. */
static int32_t await_start(int64_t deadline) {
    if (!prim_semaphore_sleep_until(&child.channel->done, deadline)) {
        char last[LOG_LAST_CAPACITY];
        log_jvm_last(last, sizeof last);
        return error_set(CLK_TIMEOUT, "the JVM's process did not start within the time limit; it printed: %s",
                         last[0] != '\0' ? last : "nothing");
    }
    int32_t result = child.channel->result;
    if (result != CHANNEL_SILENT) return result == CLK_OK ? CLK_OK : error_set(result, "%s", channel_text());
    if (child.id == 0) return error_set(CLK_JVM_START, "cannot run %s: %s", child.arguments[0], child.reason);
    if (strstr(child.reason, "load main class " MAIN_CLASS) != NULL)
        return error_set(CLK_HOST, "the class path does not contain " MAIN_CLASS " in the version of this shim: %s", child.reason);
    return error_set(CLK_JVM_START, "the JVM did not start: %s; correct the JVM options, or reinstall the JVM", child.reason);
}

int32_t child_start(const struct launch *launch, int64_t deadline, char *version, int32_t capacity) {
    int32_t result = prepare_channel();
    if (result == CLK_OK) result = fill_arguments(launch);
    if (result != CLK_OK) return result;
    if (!prim_thread_start(child_main, "collektive-jvm", STACK_BYTES)) {
        prim_semaphore_post(&child.ended);
        return error_set(CLK_MEMORY, "cannot create a thread; free memory or raise the thread limit");
    }
    result = await_start(deadline);
    text_export(channel_text(), version, capacity);
    return result;
}

/* ---- Calls ----------------------------------------------------------------------------------------------------------- */

static int32_t finish(struct host_call *call) {
    struct channel *channel = child.channel;
    int32_t result = channel->result, offset = channel->call.answer_offset, length = channel->call.answer_length;
    if (result > 0) return error_set(CLK_HOST, "the JVM's process returned an unknown result, %d; restart the JVM", result);
    if (result != CLK_OK) return error_set(result, "%s", channel_text());
    if (call->entry == HOST_CLOSE) return CLK_OK;
    if (offset < 0 || length < 0 || (int64_t)offset + length > call->answer->capacity)
        return error_set(CLK_HOST, "the JVM's process returned an answer outside of its slot; restart the JVM");
    call->answer_offset = offset;
    call->answer_length = length;
    return CLK_OK;
}

int32_t child_begin(const struct host_call *call) {
    struct channel *channel = child.channel;
    channel->call = *call;
    if (call->entry < HOST_CALLS) {
        if (call->request->offset == 0 || call->answer->offset == 0) {
            return error_set(CLK_ARGUMENT,
                             "the slot was acquired before the first JVM in a separate process started; release it and acquire another");
        }
        channel->request_block = *call->request;
        channel->answer_block = *call->answer;
    }
    prim_semaphore_post(&channel->request);
    return CLK_OK;
}

int32_t child_await(struct host_call *call, int64_t deadline) {
    struct channel *channel = child.channel;
    while (prim_semaphore_wait_until(&channel->done, deadline)) {
        if (!child_is_alive()) return engine_check_running();
        if (channel->result != CHANNEL_GROW || call->entry >= HOST_CALLS) return finish(call);
        bool grown = call->grow(call, channel->capacity);
        if (grown) channel->answer_block = *call->answer;
        if (!grown) text_export(error_last(), channel->text, ERROR_CAPACITY);
        channel->result = grown ? CLK_OK : CLK_MEMORY;
        prim_semaphore_post(&channel->request);
    }
    return CLK_TIMEOUT;
}

int32_t child_stop(int32_t limit_ms, int64_t deadline) {
    child.channel->call.entry = HOST_STOP;
    child.channel->call.limit_ms = limit_ms;
    prim_semaphore_post(&child.channel->request);
    if (!prim_semaphore_wait_until(&child.ended, deadline))
        return error_set(CLK_TIMEOUT, "the JVM did not end within %d ms; its process was killed, and flight recordings may be missing",
                         limit_ms);
    prim_semaphore_post(&child.ended); /* child_end waits for it too */
    return CLK_OK;
}
