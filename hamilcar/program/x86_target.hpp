// The target of x86-64 code: the instruction set, the precision, and whether the lanes of a register are cars or the
// numbers of one car; and from that, what kind of register a value lives in.
#pragma once

#include <cstdint>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program::x86 {

enum class InstructionSet : std::uint8_t { sse2, avx2, avx512 };

// One number in the low element, a whole vector register of 16, 32 or 64 bytes, or a mask register.
enum class Kind : std::uint8_t { scalar, xmm, ymm, zmm, mask };

struct Target {
    InstructionSet set;
    Precision precision;
    bool car_in_each_lane;

    bool is_double() const { return precision == Precision::double_precision; }
    bool has_masks() const { return set == InstructionSet::avx512; }
    int number_bytes() const { return is_double() ? 8 : 4; }
    int register_bytes() const { return bytes(widest()); }
    int lanes() const { return car_in_each_lane ? register_bytes() / number_bytes() : 1; }
    Kind widest() const {
        return set == InstructionSet::sse2 ? Kind::xmm : set == InstructionSet::avx2 ? Kind::ymm : Kind::zmm;
    }
    Kind kind_of_numbers(int width) const {
        if (car_in_each_lane) return widest();
        if (width == 1) return Kind::scalar;
        return width * number_bytes() <= 16 ? Kind::xmm : Kind::ymm;
    }
    // Without mask registers a condition is a vector with all bits of a number set or clear. It is kept in whole registers
    // also where only its low element counts, as the instructions that take it know no other size.
    Kind kind_of_condition(int width) const {
        if (has_masks()) return Kind::mask;
        const Kind kind = kind_of_numbers(width);
        return kind == Kind::scalar ? Kind::xmm : kind;
    }
    // Size in memory.
    int bytes(Kind kind) const {
        switch (kind) {
            case Kind::scalar: return number_bytes();
            case Kind::xmm: return 16;
            case Kind::ymm: return 32;
            case Kind::zmm: return 64;
            default: return 8;
        }
    }
};

}  // namespace hamilcar::program::x86
