#include "hamilcar/live/background_worker.hpp"

#include <utility>

namespace hamilcar::live {

BackgroundWorker::BackgroundWorker() : thread_([this] { work(); }) {}

BackgroundWorker::~BackgroundWorker() {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    changed_.notify_one();
}

void BackgroundWorker::post(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
    changed_.notify_one();
}

void BackgroundWorker::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return closing_ || !jobs_.empty(); });
        if (closing_) return;
        std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        job();
        job = nullptr;  // destroys its captures on this thread
        lock.lock();
    }
}

}  // namespace hamilcar::live
