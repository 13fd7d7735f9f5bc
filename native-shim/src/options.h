/* Which JVM options are allowed. */
#ifndef COLLEKTIVE_OPTIONS_H
#define COLLEKTIVE_OPTIONS_H

#include <stdint.h>

/* Refuses an option by its text: one that endangers the process, or that only the java launcher knows. CLK_JVM_OPTIONS. Any thread. */
int32_t options_check(const char *option);

/* Runs `java -version` of the JVM with the options in a child process, as several wrong ones would end this process inside
 * JNI_CreateJavaVM. CLK_JVM_OPTIONS when it fails, CLK_TIMEOUT when it lasts too long. A JVM without a java command cannot be
 * tried: a line in the log and CLK_OK. Any thread. */
int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline);

#endif
