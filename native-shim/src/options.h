/* Which JVM options are allowed. */
#ifndef COLLEKTIVE_OPTIONS_H
#define COLLEKTIVE_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

/* Refuses options by their texts: those that endanger the process, let other machines in, or are known to the java launcher alone, and
 * those that are too long to be tried. CLK_JVM_OPTIONS, with the first one's text and the reason. Any thread. */
int32_t options_check(const char *const options[], int32_t count);

/* Runs `java -version` of the JVM with the options in a child process, as several wrong ones would end this process inside
 * JNI_CreateJavaVM. CLK_JVM_OPTIONS when it fails, CLK_TIMEOUT when it lasts too long. A JVM without a java command cannot be
 * tried: a line in the log and CLK_OK. Any thread. */
int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline);

/* Whether an option makes the JVM write an archive of its classes when it ends. */
bool options_write_archive(const char *option);

/* The file that a JVM with these options writes its classes to when it ends; NULL when it writes none. */
const char *options_archive(char *const options[], int32_t count);

#endif
