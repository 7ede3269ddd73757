// A thread for slow jobs: reading files, finding an equilibrium, opening and closing recordings.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace hamilcar::live {

class BackgroundWorker {
public:
    BackgroundWorker();
    ~BackgroundWorker();  // finishes the current job, drops the others
    BackgroundWorker(const BackgroundWorker&) = delete;
    BackgroundWorker& operator=(const BackgroundWorker&) = delete;

    // Jobs run in order and must not throw.
    void post(std::function<void()> job);

private:
    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    bool closing_ = false;
    std::jthread thread_;
};

}  // namespace hamilcar::live
