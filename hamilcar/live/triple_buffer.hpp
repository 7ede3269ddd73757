// Passes the newest value from one thread to one other without blocking either.
//
// Of three slots one is being written, one is being read, and one is in between. The writer publishes by exchanging its slot
// for the one in between, the reader fetches in the same way, each by one atomic exchange; a value that is never read is
// overwritten. Slots are copies of a sample, so values of any size are passed without allocation.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace hamilcar::live {

template <class T>
class TripleBuffer {
public:
    explicit TripleBuffer(const T& sample = T()) : slots_{sample, sample, sample} {}

    // For the writer: fill the draft, which holds an old value, and publish it.
    T& draft() { return slots_[draft_]; }
    void publish() { draft_ = between_.exchange(draft_ | fresh, std::memory_order_acq_rel) & slot; }

    // For the reader: true if there is a newer value; `value` then returns it.
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
