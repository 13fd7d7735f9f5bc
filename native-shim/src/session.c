#include "session.h"

#include <stdatomic.h>
#include <stdbool.h>
#include "child.h"
#include "collektive_shim.h"
#include "engine.h"
#include "error.h"
#include "host.h"
#include "prim.h"
#include "slots.h"

#define MAX_SESSIONS 256
#define FIRST_ANSWER_BYTES (64 * 1024)
#define DEBUG_CALL_MS 100   /* with a debugger, an open or step that takes longer is pending */
#define DEBUG_LIMIT_MS 1000 /* with a debugger, other calls return CLK_TIMEOUT after this time */

struct session {
    uint32_t generation; /* 0 before the first use */
    bool open;
    bool closing; /* the caller has closed it while a debugger stopped the JVM, and the host has not closed it yet */
    clk_slot answer;
};

/* Guarded by the turn, except the counters. */
static struct {
    struct session all[MAX_SESSIONS];
    struct session control;  /* owns the answer slot of clk_control; no caller opens it */
    struct host_call call;   /* the call that the host runs, or ran last */
    struct session *caller;  /* session of a call that returned CLK_PENDING and has not been completed; otherwise NULL */
    int64_t limit, deadline; /* limit and deadline of the call, including the grace period */
    atomic_int count;
    _Atomic uint64_t steps;
} sessions;

int32_t session_count(void) { return atomic_load_explicit(&sessions.count, memory_order_relaxed); }

uint64_t session_steps(void) { return atomic_load_explicit(&sessions.steps, memory_order_relaxed); }

/* ---- The table ------------------------------------------------------------------------------------------------------- */

static clk_session session_handle(const struct session *session) {
    if (session == &sessions.control) return 0;
    return (uint64_t)session->generation << 32 | (uint64_t)(session - sessions.all);
}

static struct session *session_find(clk_session handle) {
    uint32_t index = (uint32_t)handle;
    if (index < MAX_SESSIONS && sessions.all[index].open && sessions.all[index].generation == handle >> 32 && !sessions.all[index].closing)
        return &sessions.all[index];
    error_set(CLK_HANDLE, "session 0x%llx is already closed or was never issued; open a new one", (unsigned long long)handle);
    return NULL;
}

/* Acquires the slot for the answers of a session. */
static int32_t session_begin(struct session *session) {
    clk_memory memory = {.size = sizeof memory};
    int32_t result = clk_slot_acquire(FIRST_ANSWER_BYTES, &session->answer, &memory);
    session->open = result == CLK_OK;
    return result;
}

/* Returns a free session with a new generation. Without a free session or memory, sets the last error and returns NULL. */
static struct session *session_take(void) {
    struct session *session = sessions.all;
    while (session < sessions.all + MAX_SESSIONS && session->open) session++;
    if (session == sessions.all + MAX_SESSIONS) error_set(CLK_MEMORY, "%d sessions are open; close one first", MAX_SESSIONS);
    if (session == sessions.all + MAX_SESSIONS || session_begin(session) != CLK_OK) return NULL;
    session->generation = session->generation == UINT32_MAX ? 1 : session->generation + 1;
    atomic_fetch_add(&sessions.count, 1);
    return session;
}

/* Marks a session that the caller has closed, but not yet the host. */
static void session_mark_closing(struct session *session) {
    session->closing = true;
    atomic_fetch_sub(&sessions.count, 1);
}

static void session_release(struct session *session) {
    clk_slot_release(session->answer);
    if (!session->closing) atomic_fetch_sub(&sessions.count, 1);
    session->open = session->closing = false;
}

void session_remove_all(void) {
    if (sessions.control.open) clk_slot_release(sessions.control.answer);
    sessions.control.open = false;
    sessions.caller = NULL;
    for (struct session *session = sessions.all; session < sessions.all + MAX_SESSIONS; session++) {
        if (session->open) session_release(session);
    }
}

/* ---- Calls of the host ----------------------------------------------------------------------------------------------- */

static int32_t check_limit(int32_t limit_ms) {
    if (limit_ms >= 1) return CLK_OK;
    return error_set(CLK_ARGUMENT, "limit_ms is %d; it must be 1 or greater", limit_ms);
}

static int32_t check_call(int32_t offset, int32_t length, int32_t limit_ms, const clk_answer *answer) {
    if (answer == NULL) return error_set(CLK_ARGUMENT, "answer is NULL");
    if (answer->size < sizeof *answer) return error_set(CLK_ARGUMENT, "answer->size is %u; set it to sizeof(clk_answer)", answer->size);
    if (offset < 0 || length < 0) return error_set(CLK_ARGUMENT, "offset %d and length %d must not be negative", offset, length);
    return check_limit(limit_ms);
}

static int32_t work_call(void) { return host_run(&sessions.call); }

/* Waits for sessions.call. Returns CLK_PENDING after `until` if a debugger is or was attached. A debugger postpones the call's deadline. If the call
 * has not ended at the deadline, the JVM is lost. */
static int32_t await_call(int64_t until) {
    for (int64_t end = until;;) {
        int64_t longest = prim_now() + DEBUG_CALL_MS * PRIM_MILLI; /* short waits, because a debugger may attach meanwhile */
        if (end > longest) end = longest;
        int32_t result = child_is_used() ? child_await(&sessions.call, end) : engine_await(end);
        if (result != CLK_TIMEOUT) return result;
        int64_t now = prim_now();
        bool debugged = host_is_debugged();
        if (debugged) sessions.deadline = now + sessions.limit;
        if (now >= sessions.deadline) break;
        if (now >= until && (debugged || sessions.caller != NULL)) return CLK_PENDING;
        end = now < until ? until : INT64_MAX;
    }
    engine_lose("the engine thread did not answer within the time limit and a grace period of %d ms", SESSION_GRACE_MS);
    if (child_is_used()) child_end();
    return engine_check_running();
}

/* Runs sessions.call for a session. The host should end the call by the deadline. Returns CLK_PENDING if a debugger has stopped it. */
static int32_t run(struct session *session, int64_t deadline) {
    int64_t now = prim_now();
    bool may_wait = sessions.call.entry == HOST_OPEN || sessions.call.entry == HOST_STEP;
    sessions.deadline = deadline + SESSION_GRACE_MS * PRIM_MILLI;
    sessions.limit = sessions.deadline - now;
    if (sessions.call.entry == HOST_STEP) atomic_fetch_add_explicit(&sessions.steps, 1, memory_order_relaxed);
    int32_t result = child_is_used() ? child_begin(&sessions.call) : engine_begin(work_call);
    if (result == CLK_OK) result = await_call(now + (may_wait ? DEBUG_CALL_MS : DEBUG_LIMIT_MS) * PRIM_MILLI);
    if (result == CLK_PENDING) sessions.caller = session;
    return result;
}

/* Replaces the answer's block. The host may still use the old block during the call. */
static bool grow_answer(struct host_call *call, int32_t capacity) {
    struct block *block = slots_exchange(call->slot, capacity);
    if (block == NULL) return false;
    call->answer->next = call->retired;
    call->retired = call->answer;
    call->answer = block;
    return true;
}

/* Fills in the answer and unpins the blocks of sessions.call. After a loss or failure, the blocks stay pinned, because Java threads that did not end
 * may still read or write them. They are not reused while the JVM lives. */
static int32_t end_call(int32_t result, clk_answer *answer) {
    struct host_call *call = &sessions.call;
    if (result == CLK_JVM_LOST || result == CLK_SESSION_FAILED || call->entry >= HOST_CALLS) return result;
    if (result == CLK_OK && answer != NULL) {
        answer->offset = call->answer_offset;
        answer->length = call->answer_length;
        answer->capacity = call->answer->capacity;
        answer->address = call->answer->address;
    }
    slots_unpin(call->request);
    slots_unpin(call->answer);
    for (struct block *block = call->retired, *next; block != NULL; block = next) {
        next = block->next;
        slots_unpin(block);
    }
    return result;
}

/* Runs one call of the host and fills in `answer`. Returns CLK_PENDING if a debugger has stopped the call. Needs the turn. */
static int32_t call_host(enum host_entry entry, struct session *session, clk_slot slot, int32_t offset, int32_t length, int64_t deadline,
                         clk_answer *answer) {
    struct block *own = slots_pin(session->answer), *request = slots_pin(slot);
    int32_t result = own != NULL && request != NULL ? CLK_OK : CLK_HANDLE;
    if (result == CLK_OK && (int64_t)offset + length > request->capacity)
        result = error_set(CLK_ARGUMENT, "offset %d + length %d is outside the slot's %d bytes", offset, length, request->capacity);
    if (result != CLK_OK) {
        slots_unpin(request);
        slots_unpin(own);
        return result;
    }
    int64_t left_ms = (deadline - prim_now() + PRIM_MILLI - 1) / PRIM_MILLI;
    sessions.call = (struct host_call){.entry = entry,
                                       .session = session_handle(session),
                                       .request = request,
                                       .offset = offset,
                                       .length = length,
                                       .slot = session->answer,
                                       .answer = own,
                                       .limit_ms = left_ms < 1 ? 1 : (int32_t)left_ms,
                                       .grow = grow_answer};
    result = run(session, deadline);
    return result == CLK_PENDING ? result : end_call(result, answer);
}

/* Closes a session in the host. If a debugger has stopped the JVM, a later call of session_complete releases the session. */
static int32_t close_session(struct session *session, int64_t deadline) {
    sessions.call = (struct host_call){.entry = HOST_CLOSE, .session = session_handle(session)};
    int32_t result = run(session, deadline);
    if (result == CLK_PENDING) {
        session_mark_closing(session);
        return CLK_OK;
    }
    if (result != CLK_JVM_LOST) session_release(session);
    return result;
}

int32_t session_complete(int64_t deadline) {
    while (sessions.caller != NULL) {
        struct session *session = sessions.caller;
        int32_t result = session->closing || session == &sessions.control ? await_call(prim_now()) : CLK_PENDING;
        if (result == CLK_PENDING) {
            return error_set(CLK_TIMEOUT, "a debugger has stopped the JVM; continue the program or detach the debugger, then retry");
        }
        sessions.caller = NULL;
        if (end_call(result, NULL) == CLK_JVM_LOST) return result;
        if (sessions.call.entry == HOST_CLOSE || (sessions.call.entry == HOST_OPEN && result != CLK_OK)) {
            session_release(session);
        } else if (session->closing) {
            close_session(session, deadline);
        }
    }
    return CLK_OK;
}

static int32_t take_turn(int64_t deadline) {
    int32_t result = engine_check_running(); /* if no JVM runs, do not wait for the turn */
    if (result == CLK_OK) result = engine_enter(deadline);
    int32_t running = engine_check_running(); /* a loss in the meantime is a more useful error than a time-out */
    if (running != CLK_OK && result == CLK_OK) engine_leave();
    return running != CLK_OK ? running : result;
}

/* Takes the turn if a JVM is running and no debugger has stopped it, and sets the deadline of the whole call. */
static int32_t enter(int32_t limit_ms, int64_t *deadline) {
    *deadline = prim_now() + limit_ms * PRIM_MILLI;
    int32_t result = take_turn(*deadline);
    if (result != CLK_OK) return result;
    result = session_complete(*deadline);
    if (result != CLK_OK) engine_leave();
    return result;
}

/* ---- The header's functions ------------------------------------------------------------------------------------------ */

int32_t clk_session_open(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_session *session, clk_answer *answer) {
    if (session == NULL) return error_set(CLK_ARGUMENT, "session is NULL");
    if (check_call(offset, length, limit_ms, answer) != CLK_OK) return CLK_ARGUMENT;
    int64_t deadline;
    int32_t result = enter(limit_ms, &deadline);
    if (result != CLK_OK) return result;
    struct session *taken = session_take();
    result = taken != NULL ? call_host(HOST_OPEN, taken, slot, offset, length, deadline, answer) : CLK_MEMORY;
    if (result >= CLK_OK) {
        *session = session_handle(taken);
    } else if (taken != NULL && result != CLK_JVM_LOST) {
        session_release(taken);
    }
    engine_leave();
    return result;
}

int32_t clk_step(clk_session session, clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer) {
    if (check_call(offset, length, limit_ms, answer) != CLK_OK) return CLK_ARGUMENT;
    int64_t deadline;
    int32_t result = enter(limit_ms, &deadline);
    if (result != CLK_OK) return result;
    struct session *found = session_find(session);
    result = found != NULL ? call_host(HOST_STEP, found, slot, offset, length, deadline, answer) : CLK_HANDLE;
    engine_leave();
    return result;
}

int32_t clk_session_wait(clk_session session, int32_t wait_ms, clk_answer *answer) {
    if (wait_ms < 0) return error_set(CLK_ARGUMENT, "wait_ms is %d; it must be 0 or greater", wait_ms);
    if (check_call(0, 0, 1, answer) != CLK_OK) return CLK_ARGUMENT;
    int64_t until = prim_now() + wait_ms * PRIM_MILLI;
    int32_t result = take_turn(until);
    if (result != CLK_OK) return result == CLK_TIMEOUT ? CLK_PENDING : result;
    struct session *found = session_find(session);
    if (found == NULL) {
        result = CLK_HANDLE;
    } else if (sessions.caller != found) {
        result = error_set(CLK_ARGUMENT, "the session has no pending call; call clk_step first");
    } else {
        result = await_call(until);
        if (result != CLK_PENDING) {
            sessions.caller = NULL;
            end_call(result, answer);
            if (sessions.call.entry == HOST_OPEN && result != CLK_OK && result != CLK_JVM_LOST) session_release(found);
        }
    }
    engine_leave();
    return result;
}

int32_t clk_control(clk_slot slot, int32_t offset, int32_t length, int32_t limit_ms, clk_answer *answer) {
    if (check_call(offset, length, limit_ms, answer) != CLK_OK) return CLK_ARGUMENT;
    int64_t deadline;
    int32_t result = enter(limit_ms, &deadline);
    if (result != CLK_OK) return result;
    if (!sessions.control.open) result = session_begin(&sessions.control);
    if (result == CLK_OK) result = call_host(HOST_CONTROL, &sessions.control, slot, offset, length, deadline, answer);
    if (result == CLK_PENDING) result = session_complete(deadline);
    engine_leave();
    return result;
}

int32_t clk_session_close(clk_session session, int32_t limit_ms) {
    if (check_limit(limit_ms) != CLK_OK) return CLK_ARGUMENT;
    int64_t deadline = prim_now() + limit_ms * PRIM_MILLI;
    int32_t result = take_turn(deadline);
    if (result != CLK_OK) return result;
    struct session *found = session_find(session);
    if (found == NULL) {
        result = CLK_HANDLE;
    } else if (sessions.caller == found) {
        session_mark_closing(found);
        result = session_complete(deadline) == CLK_JVM_LOST ? CLK_JVM_LOST : CLK_OK;
    } else {
        result = session_complete(deadline);
        if (result == CLK_OK) result = close_session(found, deadline);
    }
    engine_leave();
    return result;
}
