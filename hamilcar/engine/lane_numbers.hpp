// Arrays of numbers for all lanes of a program: number i of lane l is at [i * lanes + l].
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace hamilcar {

// Aligned to the widest register.
template <class E>
struct AlignedAllocator {
    using value_type = E;
    static constexpr std::align_val_t alignment{64};
    AlignedAllocator() = default;
    template <class Other>
    AlignedAllocator(const AlignedAllocator<Other>&) {}
    E* allocate(std::size_t count) { return static_cast<E*>(::operator new(count * sizeof(E), alignment)); }
    void deallocate(E* at, std::size_t) { ::operator delete(at, alignment); }
    bool operator==(const AlignedAllocator&) const { return true; }
};

// Has the member `values` that Integrator expects.
template <class E>
struct LaneNumbers {
    std::vector<E, AlignedAllocator<E>> values;

    LaneNumbers() = default;
    explicit LaneNumbers(std::size_t count) : values(count) {}
    E* data() { return values.data(); }
    const E* data() const { return values.data(); }
};

// Lane `to` gets the numbers of lane `from`.
template <class E>
void copy_lane(LaneNumbers<E>& numbers, int lanes, int from, int to) {
    for (std::size_t i = 0; i < numbers.values.size(); i += static_cast<std::size_t>(lanes)) {
        numbers.values[i + static_cast<std::size_t>(to)] = numbers.values[i + static_cast<std::size_t>(from)];
    }
}

// A lane of one array into the same lane of another.
template <class E>
void copy_lane(const LaneNumbers<E>& from, LaneNumbers<E>& to, int lanes, int lane) {
    for (std::size_t i = static_cast<std::size_t>(lane); i < to.values.size(); i += static_cast<std::size_t>(lanes)) {
        to.values[i] = from.values[i];
    }
}

}  // namespace hamilcar
