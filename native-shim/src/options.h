/* Which JVM options are let through. */
#ifndef COLLEKTIVE_OPTIONS_H
#define COLLEKTIVE_OPTIONS_H

#include <stdint.h>

/* Refuses, by its text alone, an option that endangers the host process or that only the java launcher knows. */
int32_t options_check(const char *option);

/* Tries the options, ended by NULL, in a child process: several wrong ones would end this one inside JNI_CreateJavaVM. A JVM
 * without a java command cannot be tried so; that gives a line in the log and CLK_OK. */
int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline);

#endif
