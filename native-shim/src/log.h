/* The log ring. Any thread can write lines, and clk_log_read removes them. When the ring is full, lines are dropped, so writers never wait. */
#ifndef COLLEKTIVE_LOG_H
#define COLLEKTIVE_LOG_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

#define LOG_LINE_CAPACITY 8192 /* bytes of one line, including NUL; longer ones are truncated after a whole character */
#define LOG_RING_BYTES (256 * 1024)

/* Records between two positions. A position is the number of all bytes before it since the start, modulo 2^32. The tail moves after a record was
 * written, so a process that dies while it writes leaves only whole records. */
struct log_ring {
    _Atomic uint32_t head; /* position of the oldest record */
    _Atomic uint32_t tail; /* position after the latest record */
    _Atomic uint64_t dropped;
    char bytes[LOG_RING_BYTES];
};

/* Adds a ring, which must be zeroed, in memory that both processes share. The child writes all its lines to it, and the parent only reads it. Call
 * this function once in each process. */
void log_share(struct log_ring *ring, bool is_child);

/* Adds a line. Any thread may call it, even a thread of the JVM, because it does not call JNI and holds a lock only while it copies the line. */
void log_write(int32_t level, const char *text, int32_t length);
__attribute__((format(printf, 2, 3))) void log_format(int32_t level, const char *format, ...);

/* Logs a piece of the JVM's output. A line is written to the ring once it is complete. The level of a line that contains "warning" is at least
 * CLK_LOG_WARNING. Any thread. */
void log_jvm_text(int32_t level, const char *text);

/* Copies the last lines of the JVM's output, joined by "; ". */
#define LOG_LAST_CAPACITY 2048
void log_jvm_last(char *buffer, int32_t capacity);

/* Clears the JVM's output, before another JVM starts. */
void log_jvm_clear(void);

/* Returns the number of lines that did not fit into the ring. */
uint64_t log_dropped(void);

#endif
