/* Checks of JVM options. */
#ifndef COLLEKTIVE_OPTIONS_H
#define COLLEKTIVE_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

/* Rejects options that endanger the process, open it to other machines, work only with the java launcher, or are too long. Returns
 * CLK_JVM_OPTIONS, with the first such option and the reason as error text. Any thread. */
int32_t options_check(const char *const options[], int32_t count);

/* Runs `java -version` of the JVM with the options in a child process, because some invalid options would end this process inside
 * JNI_CreateJavaVM. Returns CLK_JVM_OPTIONS if it fails, and CLK_TIMEOUT if it takes too long. For a JVM without a java command, logs a line
 * and returns CLK_OK. Any thread. */
int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline);

/* Returns whether an option makes the JVM write a class archive when it ends. */
bool options_write_archive(const char *option);

/* Returns the class archive that a JVM with these options writes when it ends, or NULL if it writes none. */
const char *options_archive(char *const options[], int32_t count);

#endif
