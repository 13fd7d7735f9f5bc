#include <string.h>
#include "child.h"
#include "collektive_shim.h"
#include "engine.h"
#include "error.h"
#include "host.h"
#include "log.h"
#include "session.h"
#include "slots.h"

int32_t clk_get_stats(clk_stats *stats) {
    if (stats == NULL) return error_set(CLK_ARGUMENT, "stats is NULL");
    uint32_t size = stats->size;
    if (size < sizeof stats->size) return error_set(CLK_ARGUMENT, "stats->size is %u; set it to sizeof(clk_stats)", size);
    clk_stats now = {.size = size,
                     .sessions = session_count(),
                     .process = child_process(),
                     .steps = session_steps(),
                     .wrapped = host_wrapped(),
                     .logs_dropped = log_dropped(),
                     .signal_repairs = engine_signal_repairs()};
    slots_count(&now.slots, &now.slot_bytes);
    memcpy(stats, &now, size < sizeof now ? size : sizeof now);
    return CLK_OK;
}
