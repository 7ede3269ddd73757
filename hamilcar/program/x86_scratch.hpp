// Stack slots for spilled values, reused as soon as a value is dead.
#pragma once

#include <array>
#include <bit>
#include <vector>

namespace hamilcar::program::x86 {

class Scratch {
public:
    // `bytes` is a power of two; the offset is aligned to it.
    int take(int bytes) {
        std::vector<int>& free = free_of(bytes);
        if (free.empty()) return block(bytes, bytes);
        const int offset = free.back();
        free.pop_back();
        return offset;
    }
    void release(int offset, int bytes) { free_of(bytes).push_back(offset); }
    // Never reused as a whole; its parts may be released.
    int block(int bytes, int alignment) {
        const int offset = (size_ + alignment - 1) / alignment * alignment;
        size_ = offset + bytes;
        return offset;
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
