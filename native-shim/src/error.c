#include "error.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include "text.h"

static _Thread_local char last_error[ERROR_CAPACITY];

uint32_t clk_version(void) { return CLK_VERSION; }

static const struct {
    const char *name, *text;
} errors[] = {
#define CLK_X(name, code, text) [-(code)] = {"CLK_" #name, text},
    CLK_ERRORS(CLK_X)
#undef CLK_X
};

static bool is_error(int32_t code) { return code <= 0 && code > -(int32_t)(sizeof errors / sizeof errors[0]); }

const char *clk_error_name(int32_t code) { return is_error(code) ? errors[-code].name : "CLK_UNKNOWN"; }

const char *clk_error_text(int32_t code) { return is_error(code) ? errors[-code].text : "unknown error code"; }

int32_t error_set(int32_t code, const char *format, ...) {
    /* The text is composed in a copy, because the arguments may include the last error. */
    char text[ERROR_CAPACITY + 4];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length < 0) length = 0;
    if ((size_t)length >= sizeof text) length = (int)sizeof text - 1;
    text_copy(text, length, last_error, sizeof last_error);
    return code;
}

const char *error_last(void) { return last_error; }

int32_t clk_last_error(char *buffer, int32_t capacity) { return text_export(last_error, buffer, capacity); }
