// A bounded queue of rows from one thread to one other. A full ring refuses rows; neither side blocks.
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

    // For the writer: space for the next row, empty while the ring is full; then `push` it.
    std::span<double> free_row() {
        const std::size_t end = end_.load(std::memory_order_relaxed);
        if (end - begin_.load(std::memory_order_acquire) == rows_) return {};
        return row(end);
    }
    void push() { end_.fetch_add(1, std::memory_order_release); }

    // For the reader: the oldest row, empty if there is none; then `pop` it.
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
    std::atomic<std::size_t> begin_{0}, end_{0};  // total rows popped and pushed
};

}  // namespace hamilcar::live
