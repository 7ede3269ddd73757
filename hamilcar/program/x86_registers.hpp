// The registers of one kind, vectors or masks: which values they hold, and whose next use is farthest.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program::x86 {

inline constexpr int never = std::numeric_limits<int>::max();  // no next use

class RegisterFile {
public:
    RegisterFile(int first, int last) {
        for (int i = first; i < last; ++i) free_ |= 1u << i;
        occupants_.fill(none);
        next_uses_.fill(-1);
    }

    // The lowest: its encodings are the shortest. -1 where all are taken.
    int free_register() const { return free_ == 0 ? -1 : std::countr_zero(free_); }
    Id occupant(int reg) const { return occupants_[static_cast<std::size_t>(reg)]; }
    int next_use(int reg) const { return next_uses_[static_cast<std::size_t>(reg)]; }
    std::uint32_t overwritten() const { return overwritten_; }
    void forget_overwritten() { overwritten_ = 0; }

    void assign(int reg, Id id, int next_use) {
        free_ &= ~(1u << reg);
        overwritten_ |= 1u << reg;
        occupants_[static_cast<std::size_t>(reg)] = id;
        next_uses_[static_cast<std::size_t>(reg)] = next_use;
    }
    void release(int reg) {
        free_ |= 1u << reg;
        occupants_[static_cast<std::size_t>(reg)] = none;
        next_uses_[static_cast<std::size_t>(reg)] = -1;
    }
    void set_next_use(int reg, int next_use) { next_uses_[static_cast<std::size_t>(reg)] = next_use; }
    // After a call, which may have changed them all.
    void overwrite_all() { overwritten_ = ~0u; }

    // Belady's rule: what is needed farthest ahead is evicted. Registers that are not of this file have -1, as free ones.
    int farthest() const {
        int best = 0;
        for (int i = 1; i < size; ++i) {
            if (next_use(i) > next_use(best)) best = i;
        }
        return best;
    }

    static constexpr int size = 32;

private:
    std::uint32_t free_ = 0, overwritten_ = 0;
    std::array<Id, size> occupants_;
    std::array<int, size> next_uses_;
};

}  // namespace hamilcar::program::x86
