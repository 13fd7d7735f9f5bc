/* UTF-8 text: copies that end after a whole character. Any thread. */
#ifndef COLLEKTIVE_TEXT_H
#define COLLEKTIVE_TEXT_H

#include <stdint.h>

/* Copies the first `length` bytes of `text`, or as many whole characters as fit, and a NUL; returns the length of the copy. */
int32_t text_copy(const char *text, int32_t length, char *buffer, int32_t capacity);

/* Copies a NUL-terminated text in the same way and returns its whole length, as the getters of collektive_shim.h do. */
int32_t text_export(const char *text, char *buffer, int32_t capacity);

/* Converts UTF-16, or as many whole characters as fit, and adds a NUL. Half a surrogate pair becomes U+FFFD. */
void text_from_utf16(const uint16_t *units, int32_t count, char *buffer, int32_t capacity);

/* Returns the first whole character at or after `text`. */
char *text_next_character(char *text);

#endif
