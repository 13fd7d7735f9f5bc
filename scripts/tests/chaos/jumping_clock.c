// A time of day that jumps once, for LD_PRELOAD: by CLOCK_JUMP seconds, CLOCK_AFTER_MS after the process began to ask for it.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <sys/time.h>
#include <time.h>

typedef int (*get_time)(clockid_t, struct timespec *);

static get_time real(void) {
    static get_time function;
    if (!function) function = (get_time)dlsym(RTLD_NEXT, "clock_gettime");
    return function;
}

static time_t jump(void) {
    static double begin;
    static double after = -1;
    static long seconds;
    struct timespec now;
    real()(CLOCK_MONOTONIC, &now);
    double at = (double)now.tv_sec * 1000 + (double)now.tv_nsec / 1e6;
    if (after < 0) {
        const char *text = getenv("CLOCK_JUMP");
        const char *delay = getenv("CLOCK_AFTER_MS");
        seconds = text ? atol(text) : 0;
        begin = at;
        after = delay ? atof(delay) : 0;
    }
    return at - begin >= after ? seconds : 0;
}

int clock_gettime(clockid_t clock, struct timespec *time) {
    int result = real()(clock, time);
    if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) time->tv_sec += jump();
    return result;
}

int gettimeofday(struct timeval *time, void *zone) {
    (void)zone;
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    time->tv_sec = now.tv_sec;
    time->tv_usec = now.tv_nsec / 1000;
    return 0;
}

time_t time(time_t *place) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (place) *place = now.tv_sec;
    return now.tv_sec;
}
