// A thread for what may take its time: reading files, finding an equilibrium, opening and closing recordings.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace hamilcar::live {

class Workshop {
public:
    Workshop();
    ~Workshop();  // waits for the job at hand, drops the others
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;

    // Done in order; a job must not throw.
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
