#define _POSIX_C_SOURCE 200809L
#define _XOPEN_SOURCE 700 /* SA_ONSTACK */
#include "prim.h"

#include <signal.h>

/* The signals whose handlers HotSpot installs. It uses the first FAULTS for implicit null checks, stack overflows and safepoint polls. */
static const int watched[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPIPE, SIGXFSZ, SIGTRAP, SIGUSR2};
enum { FAULTS = 4, COUNT = sizeof watched / sizeof watched[0] };

static struct sigaction before[COUNT];
static struct sigaction adopted[FAULTS];

void prim_signals_save(void) {
    for (int i = 0; i < COUNT; i++) sigaction(watched[i], NULL, &before[i]);
}

void prim_signals_restore(void) {
    for (int i = 0; i < COUNT; i++) sigaction(watched[i], &before[i], NULL);
}

/* HotSpot installs its SIGSEGV handler without SA_ONSTACK. A stack overflow in the process's own code could then not be handled, and would end the
 * process without a message, so the flag is added. For the other signals, the flag stays as it was before the start. */
void prim_signals_adopt(void) {
    for (int i = 0; i < FAULTS; i++) {
        int on_stack = watched[i] == SIGSEGV ? SA_ONSTACK : before[i].sa_flags & SA_ONSTACK;
        sigaction(watched[i], NULL, &adopted[i]);
        adopted[i].sa_flags = (adopted[i].sa_flags & ~SA_ONSTACK) | on_stack;
        sigaction(watched[i], &adopted[i], NULL);
    }
}

static bool same_handler(const struct sigaction *a, const struct sigaction *b) {
    if (((a->sa_flags ^ b->sa_flags) & (SA_ONSTACK | SA_SIGINFO)) != 0) return false;
    return (a->sa_flags & SA_SIGINFO) != 0 ? a->sa_sigaction == b->sa_sigaction : a->sa_handler == b->sa_handler;
}

int32_t prim_signals_repair(void) {
    int32_t repaired = 0;
    for (int i = 0; i < FAULTS; i++) {
        struct sigaction now;
        if (sigaction(watched[i], NULL, &now) == 0 && !same_handler(&now, &adopted[i])) {
            sigaction(watched[i], &adopted[i], NULL);
            repaired++;
        }
    }
    return repaired;
}
