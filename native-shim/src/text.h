/* Copies of UTF-8 text. A copy that is too long is truncated after a whole character. Any thread may call these functions. */
#ifndef COLLEKTIVE_TEXT_H
#define COLLEKTIVE_TEXT_H

#include <stdint.h>

/* Copies the first `length` bytes of `text` and adds a NUL. Returns the length of the copy. */
int32_t text_copy(const char *text, int32_t length, char *buffer, int32_t capacity);

/* Copies a NUL-terminated text in the same way. Returns the length of the whole text, as functions of collektive_shim.h do. */
int32_t text_export(const char *text, char *buffer, int32_t capacity);

/* Converts UTF-16 to UTF-8 and adds a NUL. An unpaired surrogate becomes U+FFFD. */
void text_from_utf16(const uint16_t *units, int32_t count, char *buffer, int32_t capacity);

/* Returns `text`, or the beginning of the next character if `text` points into the middle of one. */
char *text_next_character(char *text);

#endif
