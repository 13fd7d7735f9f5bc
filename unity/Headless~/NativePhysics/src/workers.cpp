// The queue of tasks and the threads that empty it.
#include "workers.hpp"

#include <algorithm>

using namespace physx;

namespace collektive {

namespace {

// Waking a thread costs more than a small task: those that find nothing look again for some ten microseconds before they sleep.
const int LOOKS = 1000;
const int TURNS_AT_ONCE = 64;

// Tells the core that it waits for another one's write.
void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ __volatile__("yield");
#endif
}

// A share of a loop. Several of them take ranges until none is left.
struct Share final : PxBaseTask {
    Workers *workers = nullptr;
    const std::function<void(int, int)> *part = nullptr;
    std::atomic<int> *next = nullptr, *left = nullptr;
    std::atomic<bool> *over = nullptr;
    int count = 0;

    void run() override {
        for (int first; (first = next->fetch_add(TURNS_AT_ONCE)) < count;) (*part)(first, std::min(first + TURNS_AT_ONCE, count));
    }
    void release() override {
        if (left->fetch_sub(1) == 1) workers->end(*over);
    }
    const char *getName() const override { return "share"; }
    void addReference() override {}
    void removeReference() override {}
    PxI32 getReference() const override { return 1; }
};

} // namespace

Workers::Workers(int threads) {
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
    // One task alone is for the thread that submits it: it is done with its own in a moment.
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
    // Notified under the lock: the waiting thread may free what it waited for as soon as it sees it.
    std::lock_guard<std::mutex> lock(turn);
    over = true;
    changed.notify_all();
}

void Workers::each(int count, const std::function<void(int, int)> &part) {
    if (workers.empty() || count <= TURNS_AT_ONCE) {
        if (count > 0) part(0, count);
        return;
    }
    std::atomic<int> next{0}, left{int(workers.size()) + 1};
    std::atomic<bool> over{false};
    std::vector<Share> shares(workers.size() + 1);
    for (Share &share : shares) {
        share.workers = this;
        share.part = &part;
        share.next = &next;
        share.left = &left;
        share.over = &over;
        share.count = count;
        submit(share, 1);
    }
    work_until(over);
}

} // namespace collektive
