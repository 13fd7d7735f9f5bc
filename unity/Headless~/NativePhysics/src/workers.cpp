// The queue of tasks and the threads that empty it.
#include "workers.hpp"

#include <algorithm>
#include <utility>

using namespace physx;

namespace collektive {

namespace {

// Waking a thread costs more than a small task, so idle threads poll for some ten microseconds before they sleep.
const int LOOKS = 1000;
const int TURNS_AT_ONCE = 64;

// Hints to the core that this thread is waiting for another core's write.
void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ __volatile__("yield");
#endif
}

} // namespace

void Workers::Share::run() {
    for (int first; (first = workers->next.fetch_add(TURNS_AT_ONCE)) < workers->count;)
        workers->part(first, std::min(first + TURNS_AT_ONCE, workers->count));
}

void Workers::Share::release() {
    if (workers->left.fetch_sub(1) == 1) workers->end(workers->over);
}

Workers::Workers(int threads) : shares(size_t(std::max(0, threads - 1))) {
    for (Share &share : shares) share.workers = this;
    for (int index = 1; index < threads; index++) workers.emplace_back([this] { work_until(quit); });
}

Workers::~Workers() {
    end(quit);
    for (std::thread &worker : workers) worker.join();
}

void Workers::submitTask(PxBaseTask &task) {
    if (workers.empty()) {
        task.run();
        task.release();
        return;
    }
    // A single task is left to the submitting thread, which is about to finish its own.
    submit(task, 2);
}

void Workers::submit(PxBaseTask &task, size_t waiting_to_wake) {
    bool wake;
    {
        std::lock_guard<std::mutex> lock(turn);
        tasks.push_back(&task);
        waiting.store(int(tasks.size()), std::memory_order_relaxed);
        wake = asleep > 0 && tasks.size() >= waiting_to_wake;
    }
    if (wake) changed.notify_one();
}

bool Workers::work() {
    PxBaseTask *task;
    {
        std::lock_guard<std::mutex> lock(turn);
        if (tasks.empty()) return false;
        task = tasks.back();
        tasks.pop_back();
        waiting.store(int(tasks.size()), std::memory_order_relaxed);
    }
    task->run();
    task->release();
    return true;
}

void Workers::work_until(const std::atomic<bool> &over) {
    while (!over) {
        if (waiting.load(std::memory_order_relaxed) > 0 && work()) continue;
        int looks = 0;
        while (looks < LOOKS && !over && waiting.load(std::memory_order_relaxed) == 0) {
            looks++;
            pause();
        }
        if (looks < LOOKS) continue;
        std::unique_lock<std::mutex> lock(turn);
        asleep++;
        changed.wait(lock, [&] { return over || !tasks.empty(); });
        asleep--;
    }
}

void Workers::end(std::atomic<bool> &over) {
    // Notifies under the lock, because the waiting thread may free the object as soon as it wakes up.
    std::lock_guard<std::mutex> lock(turn);
    over = true;
    changed.notify_all();
}

void Workers::begin(int turns, std::function<void(int, int)> what) {
    count = turns;
    part = std::move(what);
    next = 0;
    left = int(shares.size());
    over = shares.empty() || count <= TURNS_AT_ONCE;
    if (over) return;
    for (Share &share : shares) submit(share, 1);
}

void Workers::finish() {
    for (int first; (first = next.fetch_add(TURNS_AT_ONCE)) < count;) part(first, std::min(first + TURNS_AT_ONCE, count));
    work_until(over);
    count = 0;
}

void Workers::each(int turns, std::function<void(int, int)> what) {
    begin(turns, std::move(what));
    finish();
}

} // namespace collektive
