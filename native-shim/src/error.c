#include "error.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static _Thread_local char last_error[ERROR_CAPACITY];

uint32_t clk_version(void) { return CLK_VERSION; }

const char *clk_error_name(int32_t code) {
    switch (code) {
#define CLK_X(name, number, text) \
    case number: return "CLK_" #name;
        CLK_ERRORS(CLK_X)
#undef CLK_X
        default: return "CLK_UNKNOWN";
    }
}

const char *clk_error_text(int32_t code) {
    switch (code) {
#define CLK_X(name, number, text) \
    case number: return text;
        CLK_ERRORS(CLK_X)
#undef CLK_X
        default: return "no error of this library has this code";
    }
}

int32_t copy_text(const char *text, int32_t length, char *buffer, int32_t capacity) {
    if (capacity <= 0) return 0;
    if (length >= capacity) {
        length = capacity - 1;
        /* Bytes 10xxxxxx continue a character: go back to where the cut one began. */
        while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) length--;
    }
    memcpy(buffer, text, (size_t)length);
    buffer[length] = '\0';
    return length;
}

int32_t give_text(const char *text, char *buffer, int32_t capacity) {
    int32_t length = (int32_t)strlen(text);
    if (buffer != NULL) copy_text(text, length, buffer, capacity);
    return length;
}

int32_t error_set(int32_t code, const char *format, ...) {
    /* Formatted aside, as the arguments may be the last error itself. */
    char text[ERROR_CAPACITY + 4];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length < 0) length = 0;
    if ((size_t)length >= sizeof text) length = (int)sizeof text - 1;
    copy_text(text, length, last_error, sizeof last_error);
    return code;
}

const char *error_last(void) { return last_error; }

int32_t clk_last_error(char *buffer, int32_t capacity) { return give_text(last_error, buffer, capacity); }
