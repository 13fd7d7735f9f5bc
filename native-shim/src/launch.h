/* What a JVM is started with: the caller's configuration, checked, and the JVM's whole command line. Guarded by the turn. */
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

/* CLK_ARGUMENT when the struct itself is wrong; looks at no file. */
int32_t launch_check_config(const clk_jvm_config *config);

/* Checks files and options, with `check_options` in a child process too, and fills `launch`, which is all 0 before. After an error too,
 * launch_free frees what it holds. */
int32_t launch_prepare(struct launch *launch, const clk_jvm_config *config, int64_t deadline);
void launch_free(struct launch *launch);

/* The configuration as one text, equal for equal ones. The caller frees it; NULL when there is no memory. */
char *launch_configuration(const clk_jvm_config *config);

/* The text of clk_jvm_description. The caller frees it; NULL when there is no memory. */
char *launch_description(const struct launch *launch, const char *version);

#endif
