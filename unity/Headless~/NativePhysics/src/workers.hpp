// The threads of a world: PhysX's tasks, and loops whose turns do not depend on each other.
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

// The calling thread is one of the threads: it works while it waits. With one thread all is done at once, in the order of submission.
class Workers final : public physx::PxCpuDispatcher {
  public:
    explicit Workers(int threads);
    ~Workers() override;

    void submitTask(physx::PxBaseTask &task) override;
    physx::PxU32 getWorkerCount() const override { return physx::PxU32(workers.size()); }

    // Does tasks until `over`, which a task sets by `end`. For the thread that owns the world.
    void work_until(const std::atomic<bool> &over);
    void end(std::atomic<bool> &over);

    // Calls part(first, end) for ranges that together are 0 to turns - 1, on all threads; returns when all are done.
    void each(int turns, std::function<void(int first, int end)> part);

    // The same, but the caller can do something else between: the other threads begin, and `finish` does what they have left. One at a time.
    void begin(int turns, std::function<void(int first, int end)> part);
    void finish();

  private:
    // Of a loop, for one thread: it takes ranges until none is left.
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
    std::vector<physx::PxBaseTask *> tasks; // the last comes first: its data are still in the cache
    int asleep = 0;
    std::atomic<int> waiting{0}; // as many as there are tasks, to look at without the lock
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
