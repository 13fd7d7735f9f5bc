/* The log ring, which any thread writes and clk_log_read polls. A full ring drops lines, so writers never wait for readers. */
#ifndef COLLEKTIVE_LOG_H
#define COLLEKTIVE_LOG_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

#define LOG_LINE_CAPACITY 8192 /* bytes of one line, including NUL; longer ones are truncated after a whole character */
#define LOG_RING_BYTES (256 * 1024)

/* Records between two positions, which count all bytes ever written, modulo 2^32. A writer that dies leaves only whole records. */
struct log_ring {
    _Atomic uint32_t head; /* of the oldest record */
    _Atomic uint32_t tail;
    _Atomic uint64_t dropped;
    char bytes[LOG_RING_BYTES];
};

/* Uses a zeroed ring in memory shared by both processes. Only the child writes to it; the parent also reads it. Call it once. */
void log_share(struct log_ring *ring, bool is_child);

/* Adds a line. Any thread, including those of the JVM: does not call JNI, and holds one lock only while it copies. */
void log_write(int32_t level, const char *text, int32_t length);
__attribute__((format(printf, 2, 3))) void log_format(int32_t level, const char *format, ...);

/* Logs a piece of the JVM's output. Only whole lines are written to the ring; a line that contains "warning" has
 * at least that level. Any thread. */
void log_jvm_text(int32_t level, const char *text);

/* Copies the JVM's last lines, joined by "; ". */
#define LOG_LAST_CAPACITY 2048
void log_jvm_last(char *buffer, int32_t capacity);

/* Clears these lines before another JVM starts. */
void log_jvm_clear(void);

/* Returns the number of lines that did not fit into the ring. */
uint64_t log_dropped(void);

#endif
