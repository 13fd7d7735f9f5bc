/* The calling thread's last error. */
#ifndef COLLEKTIVE_ERROR_H
#define COLLEKTIVE_ERROR_H

#include <stdint.h>
#include "collektive_shim.h"

#define ERROR_CAPACITY 4096

/* Keeps the formatted text as the calling thread's last error, cut at a character if need be, and returns `code`. */
__attribute__((format(printf, 2, 3))) int32_t error_set(int32_t code, const char *format, ...);

/* The calling thread's last error text; "" when it had none. Valid until its next error. */
const char *error_last(void);

/* Copies `text` to the buffer, NUL-ended and cut at a UTF-8 character if need be; returns the length of the copy. */
int32_t copy_text(const char *text, int32_t length, char *buffer, int32_t capacity);

/* The same, but returns the length of the whole text: the contract of the getters in the header. */
int32_t give_text(const char *text, char *buffer, int32_t capacity);

#endif
