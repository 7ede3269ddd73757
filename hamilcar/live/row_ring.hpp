// Rows of numbers from one thread to one other, in order, up to a bound; a full ring refuses, and nobody waits.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace hamilcar::live {

class RowRing {
public:
    RowRing(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), cells_(rows * columns) {}

    // The writer's: where the next row goes, empty while the ring is full; then `push` it.
    std::span<double> room() {
        const std::size_t end = end_.load(std::memory_order_relaxed);
        if (end - begin_.load(std::memory_order_acquire) == rows_) return {};
        return row(end);
    }
    void push() { end_.fetch_add(1, std::memory_order_release); }

    // The reader's: the oldest row, empty if there is none; then `pop` it.
    std::span<const double> oldest() {
        const std::size_t begin = begin_.load(std::memory_order_relaxed);
        if (begin == end_.load(std::memory_order_acquire)) return {};
        return row(begin);
    }
    void pop() { begin_.fetch_add(1, std::memory_order_release); }

private:
    std::span<double> row(std::size_t number) { return {cells_.data() + number % rows_ * columns_, columns_}; }

    std::size_t rows_, columns_;
    std::vector<double> cells_;
    std::atomic<std::size_t> begin_{0}, end_{0};  // rows ever popped and pushed
};

}  // namespace hamilcar::live
