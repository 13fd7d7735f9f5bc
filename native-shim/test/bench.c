/* Benchmark that measures the time of an empty step, without and with pauses between steps. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include "test.h"

static int ascending(const void *a, const void *b) {
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

static void measure(const char *name, clk_session session, int count, int pause_ms) {
    int64_t *times = malloc((size_t)count * sizeof *times);
    CHECK(times != NULL);
    for (int i = 0; i < count; i++) {
        if (pause_ms > 0) sleep_ms(pause_ms);
        int64_t begin = now_ns();
        int32_t code = step(session, EMPTY, 0, 10000);
        times[i] = now_ns() - begin;
        CHECK_OK(code);
    }
    qsort(times, (size_t)count, sizeof *times, ascending);
    printf("%-14s %7d steps: median %6.2f us, p99 %6.2f us\n", name, count, (double)times[count / 2] / 1e3,
           (double)times[count * 99 / 100] / 1e3);
    free(times);
}

void bench(void) {
    clk_session session;
    int64_t begin = now_ns();
    start_plain();
    printf("start          %7.1f ms\n", (double)(now_ns() - begin) / 1e6);
    CHECK_OK(open_session(&session));
    measure("warm-up", session, 50000, 0);
    measure("back to back", session, 200000, 0);
    measure("every 2 ms", session, 500, 2);
    CHECK_OK(clk_session_close(session, 10000));
    CHECK_OK(clk_jvm_stop(10000));
}
