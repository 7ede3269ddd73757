// Threads that wait for work. Any thread may take any piece, so pieces must not depend on each other.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hamilcar {

class WorkerPool {
public:
    // `threads` includes the caller's; zero: as many as the machine has.
    explicit WorkerPool(int threads);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    // Calls work(0) ... work(pieces - 1), each once, and returns when all are done; rethrows the first exception.
    void run(int pieces, const std::function<void(int)>& work);

private:
    void close();
    void wait_for_work();
    void take_pieces();

    std::mutex mutex_;
    std::condition_variable start_, done_;
    const std::function<void(int)>* work_ = nullptr;
    std::atomic<int> next_{0};
    int pieces_ = 0, busy_ = 0;
    long round_ = 0;
    bool closing_ = false;
    std::exception_ptr failure_;
    std::vector<std::jthread> workers_;
};

}  // namespace hamilcar
