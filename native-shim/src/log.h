/* The log ring: many producers, polled readers. No function waits for a reader. */
#ifndef COLLEKTIVE_LOG_H
#define COLLEKTIVE_LOG_H

#include <stdarg.h>
#include <stdint.h>
#include "collektive_shim.h"

#define LOG_LINE_CAPACITY 8192 /* bytes of one line, NUL included; longer ones are cut at a character */
#define LOG_RING_BYTES (256 * 1024)

/* Any thread. Takes no JNI call and no other lock. */
void log_write(int32_t level, const char *text, int32_t length);
__attribute__((format(printf, 2, 3))) void log_format(int32_t level, const char *format, ...);

/* A piece of what the JVM prints; whole lines go to the ring, at least as a warning when they say so. */
__attribute__((format(printf, 2, 0))) int32_t log_jvm_output(int32_t level, const char *format, va_list arguments);

/* Copies what the JVM printed last (at most `capacity` - 1 bytes), lines joined by "; ". */
void log_jvm_last(char *buffer, int32_t capacity);

uint64_t log_dropped(void);

#endif
