#include "text.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Returns whether the byte is a continuation byte of UTF-8. */
static bool continues(char byte) { return ((unsigned char)byte & 0xC0) == 0x80; }

char *text_next_character(char *text) {
    while (continues(*text)) text++;
    return text;
}

int32_t text_copy(const char *text, int32_t length, char *buffer, int32_t capacity) {
    if (capacity <= 0) return 0;
    if (length >= capacity) {
        length = capacity - 1;
        while (length > 0 && continues(text[length])) length--;
    }
    memcpy(buffer, text, (size_t)length);
    buffer[length] = '\0';
    return length;
}

int32_t text_export(const char *text, char *buffer, int32_t capacity) {
    int32_t length = (int32_t)strlen(text);
    if (buffer != NULL) text_copy(text, length, buffer, capacity);
    return length;
}

static int32_t encode(uint32_t character, char *bytes) {
    if (character < 0x80) {
        bytes[0] = (char)character;
        return 1;
    }
    int32_t length = character < 0x800 ? 2 : character < 0x10000 ? 3 : 4;
    static const uint8_t first[] = {0, 0, 0xC0, 0xE0, 0xF0};
    for (int32_t i = length - 1; i > 0; i--) {
        bytes[i] = (char)(0x80 | (character & 0x3F));
        character >>= 6;
    }
    bytes[0] = (char)(first[length] | character);
    return length;
}

void text_from_utf16(const uint16_t *units, int32_t count, char *buffer, int32_t capacity) {
    int32_t used = 0;
    for (int32_t i = 0; i < count && used + 5 <= capacity; i++) {
        uint32_t character = units[i];
        if (character >= 0xD800 && character < 0xE000) {
            bool pair = character < 0xDC00 && i + 1 < count && units[i + 1] >= 0xDC00 && units[i + 1] < 0xE000;
            character = pair ? 0x10000 + ((character - 0xD800) << 10) + (units[++i] - 0xDC00u) : 0xFFFD;
        }
        used += encode(character, buffer + used);
    }
    buffer[used] = '\0';
}
