/* A benchmark, not a test: times steps that do nothing, back to back and with pauses of 2 ms. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include "collektive_shim.h"

static void require(int32_t code) {
    char text[1024];
    if (code == CLK_OK) return;
    clk_last_error(text, sizeof text);
    fprintf(stderr, "%s: %s\n", clk_error_name(code), text);
    exit(1);
}

static double now_us(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec / 1e3;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void measure(const char *name, clk_session session, clk_slot slot, int count, long pause_ns) {
    clk_answer answer = {.size = sizeof answer};
    double *times = malloc((size_t)count * sizeof *times);
    if (times == NULL) exit(1);
    for (int i = 0; i < count; i++) {
        if (pause_ns > 0) nanosleep(&(struct timespec){.tv_nsec = pause_ns}, NULL);
        double begin = now_us();
        require(clk_step(session, slot, 0, 8, 10000, &answer));
        times[i] = now_us() - begin;
    }
    qsort(times, (size_t)count, sizeof *times, ascending);
    printf("%-14s %7d steps: median %6.2f us, p99 %6.2f us\n", name, count, times[count / 2], times[count * 99 / 100]);
    free(times);
}

int main(void) {
    const char *home = getenv("CLK_TEST_JAVA_HOME");
    clk_jvm_config config = {
        .size = sizeof config, .home = home != NULL ? home : TEST_JAVA_HOME, .class_path = TEST_HOST_CLASSES, .start_limit_ms = 60000};
    clk_slot slot;
    clk_session session;
    clk_memory memory = {.size = sizeof memory};
    clk_answer answer = {.size = sizeof answer};
    double begin = now_us();
    require(clk_jvm_start(&config));
    printf("start          %7.1f ms\n", (now_us() - begin) / 1000);
    require(clk_slot_acquire(8, &slot, &memory));
    memset(memory.address, 0, 8);
    require(clk_session_open(slot, 0, 8, 10000, &session, &answer));
    measure("warm-up", session, slot, 50000, 0);
    measure("back to back", session, slot, 200000, 0);
    measure("every 2 ms", session, slot, 500, 2000000);
    require(clk_session_close(session, 10000));
    require(clk_jvm_stop(10000));
    return 0;
}
