// The threads of a world, which run PhysX's tasks and loops with independent iterations.
#ifndef COLLEKTIVE_WORKERS_HPP
#define COLLEKTIVE_WORKERS_HPP

#include <PxPhysicsAPI.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace collektive {

// The calling thread is one of the threads and works while it waits. With one thread, tasks run immediately in the order of submission.
class Workers final : public physx::PxCpuDispatcher {
  public:
    explicit Workers(int threads);
    ~Workers() override;

    void submitTask(physx::PxBaseTask &task) override;
    physx::PxU32 getWorkerCount() const override { return physx::PxU32(workers.size()); }

    // Runs tasks until `over`, which a task sets with `end`. For the thread that owns the world.
    void work_until(const std::atomic<bool> &over);
    void end(std::atomic<bool> &over);

    // Calls part(first, end) for ranges that together are 0 to turns - 1, on all threads; returns when all are done.
    void each(int turns, std::function<void(int first, int end)> part);

    // The same in the background: the other threads start, and `finish` completes the rest. One at a time.
    void begin(int turns, std::function<void(int first, int end)> part);
    void finish();

  private:
    // Runs ranges of a loop on one thread until none is left.
    struct Share final : physx::PxBaseTask {
        Workers *workers = nullptr;

        void run() override;
        void release() override;
        const char *getName() const override { return "share"; }
        void addReference() override {}
        void removeReference() override {}
        physx::PxI32 getReference() const override { return 1; }
    };

    bool work();
    void submit(physx::PxBaseTask &task, size_t waiting_to_wake);

    std::vector<std::thread> workers;
    std::mutex turn; // guards tasks, asleep, and the change of what threads wait for
    std::condition_variable changed;
    std::vector<physx::PxBaseTask *> tasks; // last in, first out, because the data is still in the cache
    int asleep = 0;
    std::atomic<int> waiting{0}; // number of tasks, readable without the lock
    std::atomic<bool> quit{false};
    // The loop.
    std::vector<Share> shares;
    std::function<void(int, int)> part;
    int count = 0;
    std::atomic<int> next{0}, left{0};
    std::atomic<bool> over{true};
};

} // namespace collektive

#endif
