#define _POSIX_C_SOURCE 200809L
#define _XOPEN_SOURCE 700 /* SA_ONSTACK */
#include "signals.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

/* The first ones are how HotSpot sees implicit null checks, stack overflows and safepoint polls: without them it is lost. */
static const int watched[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPIPE, SIGXFSZ, SIGTRAP, SIGUSR2};
enum { FAULTS = 4, COUNT = sizeof watched / sizeof watched[0] };

static struct sigaction host[COUNT];
static struct sigaction jvm[FAULTS];

void signals_save_host(void) {
    for (int i = 0; i < COUNT; i++) sigaction(watched[i], NULL, &host[i]);
}

void signals_restore_host(void) {
    for (int i = 0; i < COUNT; i++) sigaction(watched[i], &host[i], NULL);
}

/* HotSpot drops SA_ONSTACK from SIGSEGV. A stack overflow in the host's own code then has no stack to be handled on, and the
 * process dies in silence. The other faults get back what each had. */
void signals_adopt_jvm(void) {
    for (int i = 0; i < FAULTS; i++) {
        int on_stack = watched[i] == SIGSEGV ? SA_ONSTACK : host[i].sa_flags & SA_ONSTACK;
        sigaction(watched[i], NULL, &jvm[i]);
        jvm[i].sa_flags = (jvm[i].sa_flags & ~SA_ONSTACK) | on_stack;
        sigaction(watched[i], &jvm[i], NULL);
    }
}

static bool same_handler(const struct sigaction *a, const struct sigaction *b) {
    if (((a->sa_flags ^ b->sa_flags) & (SA_ONSTACK | SA_SIGINFO)) != 0) return false;
    return (a->sa_flags & SA_SIGINFO) != 0 ? a->sa_sigaction == b->sa_sigaction : a->sa_handler == b->sa_handler;
}

int32_t signals_repair(void) {
    int32_t repaired = 0;
    for (int i = 0; i < FAULTS; i++) {
        struct sigaction now;
        if (sigaction(watched[i], NULL, &now) == 0 && !same_handler(&now, &jvm[i])) {
            sigaction(watched[i], &jvm[i], NULL);
            repaired++;
        }
    }
    return repaired;
}
