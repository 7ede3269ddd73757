// The newest value on its way from one thread to one other, neither of which ever waits.
//
// Three slots: one is being written, one is being read, and one lies between them. A writer that is done exchanges its slot
// for the one between, a reader that wants news does the same, each by one atomic exchange; what is never read is written
// over. Slots are copies of a sample, so values of any size pass without allocation.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace hamilcar::live {

template <class T>
class Newest {
public:
    explicit Newest(const T& sample = T()) : slots_{sample, sample, sample} {}

    // The writer's: fill the draft, which holds something old, and publish it.
    T& draft() { return slots_[draft_]; }
    void publish() { draft_ = between_.exchange(draft_ | fresh, std::memory_order_acq_rel) & slot; }

    // The reader's: true if something newer than `value` has come, which `value` then is.
    bool fetch() {
        if ((between_.load(std::memory_order_relaxed) & fresh) == 0) return false;
        value_ = between_.exchange(value_, std::memory_order_acq_rel) & slot;
        return true;
    }
    const T& value() const { return slots_[value_]; }

private:
    static constexpr std::size_t slot = 3, fresh = 4, cache_line = 64;

    std::array<T, 3> slots_;
    alignas(cache_line) std::atomic<std::size_t> between_{1};
    alignas(cache_line) std::size_t draft_ = 0;
    alignas(cache_line) std::size_t value_ = 2;
};

}  // namespace hamilcar::live
