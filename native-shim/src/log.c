#include "log.h"

#include <stdio.h>
#include <string.h>
#include "prim.h"
#include "text.h"

/* A record is this header and the text without NUL. Records follow each other in the ring; one may wrap around its end. */
struct record {
    int32_t level;
    int32_t length;
};

static struct {
    prim_mutex mutex; /* held for copies only, never during a call that may wait */
    uint32_t head;    /* position of the oldest record; positions count all bytes ever written, modulo 2^32 */
    uint32_t tail;
    uint64_t dropped;
    char bytes[LOG_RING_BYTES];
} ring = {.mutex = PRIM_MUTEX_INIT};

_Static_assert((LOG_RING_BYTES & (LOG_RING_BYTES - 1)) == 0, "positions wrap by masking");

static void ring_put(uint32_t position, const void *source, uint32_t length) {
    uint32_t at = position & (LOG_RING_BYTES - 1);
    uint32_t first = length < LOG_RING_BYTES - at ? length : LOG_RING_BYTES - at;
    memcpy(ring.bytes + at, source, first);
    memcpy(ring.bytes, (const char *)source + first, length - first);
}

static void ring_get(uint32_t position, void *target, uint32_t length) {
    uint32_t at = position & (LOG_RING_BYTES - 1);
    uint32_t first = length < LOG_RING_BYTES - at ? length : LOG_RING_BYTES - at;
    memcpy(target, ring.bytes + at, first);
    memcpy((char *)target + first, ring.bytes, length - first);
}

void log_write(int32_t level, const char *text, int32_t length) {
    char cut[LOG_LINE_CAPACITY];
    if (length >= LOG_LINE_CAPACITY) {
        length = text_copy(text, length, cut, sizeof cut);
        text = cut;
    }
    struct record record = {level, length};
    uint32_t size = (uint32_t)sizeof record + (uint32_t)length;
    prim_lock(&ring.mutex);
    if (ring.tail - ring.head + size > LOG_RING_BYTES) {
        ring.dropped++;
    } else {
        ring_put(ring.tail, &record, sizeof record);
        ring_put(ring.tail + (uint32_t)sizeof record, text, (uint32_t)length);
        ring.tail += size;
    }
    prim_unlock(&ring.mutex);
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

int32_t clk_log_read(int32_t *level, char *buffer, int32_t capacity) {
    char text[LOG_LINE_CAPACITY];
    struct record record = {0, -1};
    prim_lock(&ring.mutex);
    if (ring.tail != ring.head) {
        ring_get(ring.head, &record, sizeof record);
        ring_get(ring.head + (uint32_t)sizeof record, text, (uint32_t)record.length);
        ring.head += (uint32_t)sizeof record + (uint32_t)record.length;
    }
    prim_unlock(&ring.mutex);
    if (record.length < 0) return -1;
    if (level != NULL) *level = record.level;
    return buffer != NULL ? text_copy(text, record.length, buffer, capacity) : 0;
}

uint64_t log_dropped(void) {
    prim_lock(&ring.mutex);
    uint64_t dropped = ring.dropped;
    prim_unlock(&ring.mutex);
    return dropped;
}

/* ---- Output of the JVM ----------------------------------------------------------------------------------------------- */

static struct {
    prim_mutex mutex; /* locked before the ring's */
    int32_t used;
    char line[LOG_LINE_CAPACITY + 4]; /* the unfinished line */
    char last[1024];                  /* the latest whole lines, for error texts */
} jvm_output = {.mutex = PRIM_MUTEX_INIT};

static void keep_last(const char *line, int32_t length) {
    int32_t capacity = sizeof jvm_output.last;
    int32_t used = (int32_t)strlen(jvm_output.last);
    if (used + length + 3 > capacity) used = 0;
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

int32_t log_jvm_output(int32_t level, const char *format, va_list arguments) {
    char text[LOG_LINE_CAPACITY + 4];
    int length = vsnprintf(text, sizeof text, format, arguments);
    if (length < 0) return length;
    prim_lock(&jvm_output.mutex);
    for (const char *at = text; *at != '\0'; at++) {
        if (*at == '\n') {
            end_line(level);
        } else if (jvm_output.used < (int32_t)sizeof jvm_output.line - 1) {
            jvm_output.line[jvm_output.used++] = *at;
        }
    }
    if ((size_t)length >= sizeof text) end_line(level); /* the rest was truncated, including the end of the line */
    prim_unlock(&jvm_output.mutex);
    return length;
}

void log_jvm_last(char *buffer, int32_t capacity) {
    prim_lock(&jvm_output.mutex);
    if (jvm_output.used > 0) end_line(CLK_LOG_ERROR);
    text_export(jvm_output.last, buffer, capacity);
    prim_unlock(&jvm_output.mutex);
}
