#include "log.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include "prim.h"
#include "text.h"

/* A record consists of this header and the text without NUL. Records follow each other in the ring, and a record may wrap around its end. */
struct record {
    int32_t level;
    int32_t length;
};

static struct log_ring own;
static _Atomic(struct log_ring *) written = &own, shared;
static prim_mutex copying = PRIM_MUTEX_INIT; /* locked only while a line is copied, never during a call that may wait */

_Static_assert((LOG_RING_BYTES & (LOG_RING_BYTES - 1)) == 0, "positions wrap by masking");

void log_share(struct log_ring *ring, bool is_child) {
    if (is_child) atomic_store(&written, ring);
    atomic_store(&shared, ring);
}

static void ring_put(struct log_ring *ring, uint32_t position, const void *source, uint32_t length) {
    uint32_t at = position & (LOG_RING_BYTES - 1);
    uint32_t first = length < LOG_RING_BYTES - at ? length : LOG_RING_BYTES - at;
    memcpy(ring->bytes + at, source, first);
    memcpy(ring->bytes, (const char *)source + first, length - first);
}

static void ring_get(const struct log_ring *ring, uint32_t position, void *target, uint32_t length) {
    uint32_t at = position & (LOG_RING_BYTES - 1);
    uint32_t first = length < LOG_RING_BYTES - at ? length : LOG_RING_BYTES - at;
    memcpy(target, ring->bytes + at, first);
    memcpy((char *)target + first, ring->bytes, length - first);
}

void log_write(int32_t level, const char *text, int32_t length) {
    char cut[LOG_LINE_CAPACITY];
    if (length >= LOG_LINE_CAPACITY) {
        length = text_copy(text, length, cut, sizeof cut);
        text = cut;
    }
    struct record record = {level, length};
    uint32_t size = (uint32_t)sizeof record + (uint32_t)length;
    struct log_ring *ring = atomic_load(&written);
    prim_lock(&copying);
    uint32_t tail = atomic_load_explicit(&ring->tail, memory_order_relaxed);
    if (tail - atomic_load(&ring->head) + size > LOG_RING_BYTES) {
        atomic_fetch_add(&ring->dropped, 1);
    } else {
        ring_put(ring, tail, &record, sizeof record);
        ring_put(ring, tail + (uint32_t)sizeof record, text, (uint32_t)length);
        atomic_store(&ring->tail, tail + size);
    }
    prim_unlock(&copying);
}

void log_format(int32_t level, const char *format, ...) {
    char text[LOG_LINE_CAPACITY + 4]; /* longer than a line may be, so that log_write truncates after a whole character */
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length < 0) return;
    log_write(level, text, (size_t)length < sizeof text ? length : (int32_t)sizeof text - 1);
}

/* Removes the oldest record. False if the ring is empty. Checks the record, because a child may have overwritten its ring when it crashed. */
static bool ring_take(struct log_ring *ring, struct record *record, char *text) {
    uint32_t head = atomic_load_explicit(&ring->head, memory_order_relaxed), used = atomic_load(&ring->tail) - head;
    if (used == 0) return false;
    ring_get(ring, head, record, sizeof *record);
    bool good = used <= LOG_RING_BYTES && record->length >= 0 && record->length < LOG_LINE_CAPACITY &&
                (uint32_t)record->length + sizeof *record <= used && record->level >= CLK_LOG_DEBUG && record->level <= CLK_LOG_ERROR;
    if (!good) {
        atomic_store(&ring->head, head + used);
        return false;
    }
    ring_get(ring, head + (uint32_t)sizeof *record, text, (uint32_t)record->length);
    atomic_store(&ring->head, head + (uint32_t)sizeof *record + (uint32_t)record->length);
    return true;
}

int32_t clk_log_read(int32_t *level, char *buffer, int32_t capacity) {
    char text[LOG_LINE_CAPACITY];
    struct record record;
    prim_lock(&copying);
    struct log_ring *other = atomic_load(&shared);
    bool taken = ring_take(&own, &record, text) || (other != NULL && ring_take(other, &record, text));
    prim_unlock(&copying);
    if (!taken) return -1;
    if (level != NULL) *level = record.level;
    return buffer != NULL ? text_copy(text, record.length, buffer, capacity) : 0;
}

uint64_t log_dropped(void) {
    struct log_ring *other = atomic_load(&shared);
    return atomic_load(&own.dropped) + (other != NULL ? atomic_load(&other->dropped) : 0);
}

/* ---- Output of the JVM ----------------------------------------------------------------------------------------------- */

static struct {
    prim_mutex mutex; /* locked before `copying` */
    int32_t used;
    char line[LOG_LINE_CAPACITY + 4]; /* the unfinished line */
    char last[LOG_LAST_CAPACITY];     /* the latest whole lines, for error texts */
} jvm_output = {.mutex = PRIM_MUTEX_INIT};

static void keep_last(const char *line, int32_t length) {
    int32_t capacity = sizeof jvm_output.last;
    int32_t used = (int32_t)strlen(jvm_output.last);
    if (length > capacity / 2) length = capacity / 2;
    if (used + length + 3 > capacity) { /* drop the older half */
        char *kept = text_next_character(jvm_output.last + used / 2);
        used -= (int32_t)(kept - jvm_output.last);
        memmove(jvm_output.last, kept, (size_t)used + 1);
    }
    if (used > 0) used += text_copy("; ", 2, jvm_output.last + used, capacity - used);
    text_copy(line, length, jvm_output.last + used, capacity - used);
}

static void end_line(int32_t level) {
    jvm_output.line[jvm_output.used] = '\0';
    if (level < CLK_LOG_WARNING && strstr(jvm_output.line, "warning") != NULL) level = CLK_LOG_WARNING;
    if (jvm_output.used > 0) {
        log_write(level, jvm_output.line, jvm_output.used);
        keep_last(jvm_output.line, jvm_output.used);
    }
    jvm_output.used = 0;
}

void log_jvm_text(int32_t level, const char *text) {
    prim_lock(&jvm_output.mutex);
    for (const char *at = text; *at != '\0'; at++) {
        if (*at == '\n') {
            end_line(level);
        } else if (jvm_output.used < (int32_t)sizeof jvm_output.line - 1) {
            jvm_output.line[jvm_output.used++] = *at;
        }
    }
    prim_unlock(&jvm_output.mutex);
}

void log_jvm_last(char *buffer, int32_t capacity) {
    prim_lock(&jvm_output.mutex);
    if (jvm_output.used > 0) end_line(CLK_LOG_ERROR);
    text_export(jvm_output.last, buffer, capacity);
    prim_unlock(&jvm_output.mutex);
}

void log_jvm_clear(void) {
    prim_lock(&jvm_output.mutex);
    jvm_output.used = 0;
    jvm_output.last[0] = '\0';
    prim_unlock(&jvm_output.mutex);
}
