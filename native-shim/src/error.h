/* The calling thread's last error. */
#ifndef COLLEKTIVE_ERROR_H
#define COLLEKTIVE_ERROR_H

#include <stdint.h>
#include "collektive_shim.h"

#define ERROR_CAPACITY 4096

/* Sets the calling thread's last error and returns `code`. A text that is too long is truncated after a whole character. */
__attribute__((format(printf, 2, 3))) int32_t error_set(int32_t code, const char *format, ...);

/* Returns the calling thread's last error, or "" if it had none. Valid until the thread's next error. */
const char *error_last(void);

#endif
