/* The checked configuration of the caller, and the JVM's complete command line. Guarded by the turn. */
#ifndef COLLEKTIVE_LAUNCH_H
#define COLLEKTIVE_LAUNCH_H

#include <stdint.h>
#include "collektive_shim.h"

struct launch {
    char *home;
    char *configuration; /* as launch_configuration writes it */
    char **options;      /* the shim's own, then the caller's */
    int32_t option_count;
    int32_t own_count; /* the shim's own */
};

/* Returns CLK_ARGUMENT if the struct is invalid. Does not access files. */
int32_t launch_check_config(const clk_jvm_config *config);

/* Checks files and options, with `check_options` also in a child process, and fills in `launch`, which must be zeroed. Call launch_free
 * afterwards, also after an error. */
int32_t launch_prepare(struct launch *launch, const clk_jvm_config *config, int64_t deadline);
void launch_free(struct launch *launch);

/* Returns the configuration as one text, equal for equal configurations. The caller frees it; NULL if out of memory. */
char *launch_configuration(const clk_jvm_config *config);

/* Returns the text of clk_jvm_description. The caller frees it; NULL if out of memory. */
char *launch_description(const struct launch *launch, const char *version);

#endif
