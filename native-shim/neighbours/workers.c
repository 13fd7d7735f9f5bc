#define _POSIX_C_SOURCE 200809L
#include "workers.h"

#include <stdbool.h>
#include <stdlib.h>

#if defined(_WIN32)
#include <windows.h>

typedef SRWLOCK lock;
typedef CONDITION_VARIABLE condition;
typedef HANDLE thread;
#define THREAD_FUNCTION static DWORD WINAPI
#define THREAD_RESULT 0

static bool begin(thread *started, LPTHREAD_START_ROUTINE run, void *context) {
    *started = CreateThread(NULL, 0, run, context, 0, NULL);
    return *started != NULL;
}

static void join(thread ended) {
    WaitForSingleObject(ended, INFINITE);
    CloseHandle(ended);
}

static void init(lock *mutex, condition *first, condition *second) {
    InitializeSRWLock(mutex);
    InitializeConditionVariable(first);
    InitializeConditionVariable(second);
}

static void fini(lock *mutex, condition *first, condition *second) { (void)mutex, (void)first, (void)second; }
static void enter(lock *mutex) { AcquireSRWLockExclusive(mutex); }
static void leave(lock *mutex) { ReleaseSRWLockExclusive(mutex); }
static void await(condition *changed, lock *mutex) { SleepConditionVariableSRW(changed, mutex, INFINITE, 0); }
static void signal_all(condition *changed) { WakeAllConditionVariable(changed); }
#else
#include <pthread.h>
#include <signal.h>

typedef pthread_mutex_t lock;
typedef pthread_cond_t condition;
typedef pthread_t thread;
#define THREAD_FUNCTION static void *
#define THREAD_RESULT NULL

/* Starts a thread in which all signals are blocked, because signal handlers expect to run on the caller's threads. */
static bool begin(thread *started, void *(*run)(void *), void *context) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    bool ok = pthread_create(started, NULL, run, context) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return ok;
}

static void join(thread ended) { pthread_join(ended, NULL); }

static void init(lock *mutex, condition *first, condition *second) {
    pthread_mutex_init(mutex, NULL);
    pthread_cond_init(first, NULL);
    pthread_cond_init(second, NULL);
}

static void fini(lock *mutex, condition *first, condition *second) {
    pthread_mutex_destroy(mutex);
    pthread_cond_destroy(first);
    pthread_cond_destroy(second);
}

static void enter(lock *mutex) { pthread_mutex_lock(mutex); }
static void leave(lock *mutex) { pthread_mutex_unlock(mutex); }
static void await(condition *changed, lock *mutex) { pthread_cond_wait(changed, mutex); }
static void signal_all(condition *changed) { pthread_cond_broadcast(changed); }
#endif

struct workers {
    lock mutex;
    condition has_work; /* signalled for new work, and when the workers are destroyed */
    condition is_done;
    thread threads[MAX_WORKERS - 1];
    int32_t started;
    int32_t next;    /* number of the next call */
    int32_t limit;   /* calls have numbers below it */
    int32_t running; /* calls that have not returned */
    bool is_ending;
    void (*work)(void *context, int32_t number);
    void *context;
};

THREAD_FUNCTION run(void *context) {
    struct workers *workers = context;
    enter(&workers->mutex);
    for (;;) {
        while (!workers->is_ending && workers->next >= workers->limit) await(&workers->has_work, &workers->mutex);
        if (workers->is_ending) break;
        int32_t number = workers->next++;
        workers->running++;
        leave(&workers->mutex);
        workers->work(workers->context, number);
        enter(&workers->mutex);
        if (--workers->running == 0) signal_all(&workers->is_done);
    }
    leave(&workers->mutex);
    return THREAD_RESULT;
}

struct workers *workers_create(void) {
    struct workers *workers = calloc(1, sizeof *workers);
    if (workers != NULL) init(&workers->mutex, &workers->has_work, &workers->is_done);
    return workers;
}

void workers_destroy(struct workers *workers) {
    if (workers == NULL) return;
    enter(&workers->mutex);
    workers->is_ending = true;
    signal_all(&workers->has_work);
    leave(&workers->mutex);
    for (int32_t i = 0; i < workers->started; i++) join(workers->threads[i]);
    fini(&workers->mutex, &workers->has_work, &workers->is_done);
    free(workers);
}

void workers_run(struct workers *workers, int32_t threads, void (*work)(void *context, int32_t number), void *context) {
    if (threads > MAX_WORKERS) threads = MAX_WORKERS;
    if (threads > 1) {
        while (workers->started < threads - 1 && begin(&workers->threads[workers->started], run, workers)) workers->started++;
        enter(&workers->mutex);
        workers->work = work;
        workers->context = context;
        workers->next = 1;
        workers->limit = threads;
        signal_all(&workers->has_work);
        leave(&workers->mutex);
    }
    work(context, 0);
    if (threads <= 1) return;
    enter(&workers->mutex);
    /* Threads that wake up later must not begin a call. */
    workers->limit = 0;
    while (workers->running > 0) await(&workers->is_done, &workers->mutex);
    leave(&workers->mutex);
}
