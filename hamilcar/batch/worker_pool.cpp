#include "hamilcar/batch/worker_pool.hpp"

#include <algorithm>

namespace hamilcar {

WorkerPool::WorkerPool(int threads) {
    const int count = threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    try {
        for (int i = 1; i < count; ++i) workers_.emplace_back([this] { wait_for_work(); });
    } catch (...) {
        close();  // more threads than the system allows: those already running must not wait forever
        throw;
    }
}

WorkerPool::~WorkerPool() {
    close();
}

void WorkerPool::close() {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    start_.notify_all();
}

void WorkerPool::run(int pieces, const std::function<void(int)>& work) {
    {
        const std::lock_guard lock(mutex_);
        work_ = &work, pieces_ = pieces, next_ = 0, failure_ = nullptr;
        busy_ = static_cast<int>(workers_.size());
        ++round_;
    }
    start_.notify_all();
    take_pieces();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
    if (failure_) std::rethrow_exception(failure_);
}

void WorkerPool::wait_for_work() {
    long seen = 0;
    std::unique_lock lock(mutex_);
    while (true) {
        start_.wait(lock, [&] { return closing_ || round_ != seen; });
        if (closing_) return;
        seen = round_;
        lock.unlock();
        take_pieces();
        lock.lock();
        if (--busy_ == 0) done_.notify_one();
    }
}

void WorkerPool::take_pieces() {
    try {
        for (int i = next_++; i < pieces_; i = next_++) (*work_)(i);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
    }
}

}  // namespace hamilcar
