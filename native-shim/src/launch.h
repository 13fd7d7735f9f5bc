/* Checks of the caller's configuration, and the JVM's command line. A caller must have the turn (see engine.h). */
#ifndef COLLEKTIVE_LAUNCH_H
#define COLLEKTIVE_LAUNCH_H

#include <stdint.h>
#include "collektive_shim.h"

struct launch {
    char *home;
    char *configuration; /* result of launch_configuration */
    char **options;      /* the shim's options, then the caller's */
    int32_t option_count;
    int32_t own_count; /* number of the shim's options */
};

/* Returns CLK_ARGUMENT if the configuration is invalid. Does not access files. */
int32_t launch_check_config(const clk_jvm_config *config);

/* Checks the files and options and fills in `launch`, which must be zeroed. With `check_options`, also tries the options in a child process. Call
 * launch_free afterwards, even after an error. */
int32_t launch_prepare(struct launch *launch, const clk_jvm_config *config, int64_t deadline);
void launch_free(struct launch *launch);

/* Returns the configuration as a text by which configurations can be compared. NULL if out of memory. The caller frees the text. */
char *launch_configuration(const clk_jvm_config *config);

/* Returns the text of clk_jvm_description. NULL if out of memory. The caller frees the text. */
char *launch_description(const struct launch *launch, const char *version);

#endif
