// Places on the stack for spilled values, used again as soon as a value is dead.
#pragma once

#include <array>
#include <bit>
#include <vector>

namespace hamilcar::program::x86 {

class Scratch {
public:
    // `bytes` is a power of two; the place is aligned to as much.
    int take(int bytes) {
        std::vector<int>& free = free_of(bytes);
        if (free.empty()) return block(bytes, bytes);
        const int place = free.back();
        free.pop_back();
        return place;
    }
    void give_back(int place, int bytes) { free_of(bytes).push_back(place); }
    // Never used again as a whole; its parts may be given back.
    int block(int bytes, int alignment) {
        const int place = (size_ + alignment - 1) / alignment * alignment;
        size_ = place + bytes;
        return place;
    }
    int size() const { return size_; }

private:
    std::vector<int>& free_of(int bytes) {
        return free_[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(bytes)))];
    }

    int size_ = 0;
    std::array<std::vector<int>, 7> free_;
};

}  // namespace hamilcar::program::x86
