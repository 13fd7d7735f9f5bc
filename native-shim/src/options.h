/* Checks of JVM options. */
#ifndef COLLEKTIVE_OPTIONS_H
#define COLLEKTIVE_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

/* Checks the text of the options. Returns CLK_JVM_OPTIONS if an option endangers the process, opens it to other machines, works only with the java
 * command, or is too long. The error text contains the first such option and the reason. Any thread. */
int32_t options_check(const char *const options[], int32_t count);

/* Runs `java -version` with the options in a child process, because some invalid options would end this process inside JNI_CreateJavaVM. Returns
 * CLK_JVM_OPTIONS if the command fails, and CLK_TIMEOUT if it takes too long. If the JVM has no java command, logs a line and returns CLK_OK. Any
 * thread. */
int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline);

/* Returns whether an option makes the JVM write a class archive when it ends. */
bool options_write_archive(const char *option);

/* Returns the path of the class archive that a JVM with these options writes when it ends. NULL if it does not write an archive. */
const char *options_archive(char *const options[], int32_t count);

#endif
