// The table of constants after the code: each stored once, as wide as the instructions that read it require.
#pragma once

#include <asmjit/x86.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>

#include "hamilcar/program/x86_target.hpp"

namespace hamilcar::program::x86 {

class ConstantTable {
public:
    explicit ConstantTable(const Target& target) : target_(target) {}

    // The operand that reads these numbers as that kind. With AVX-512 a number for all lanes is stored once and spread by the
    // instruction (embedded broadcast).
    asmjit::x86::Mem numbers(std::span<const double> values, Kind kind);
    // The same bits in all numbers of a whole register, for negate, absolute and opposite.
    asmjit::x86::Mem bits(std::uint64_t bits, Kind kind);
    bool is_spread(std::span<const double> values, Kind kind) const {
        return target_.has_masks() && values.size() == 1 && kind != Kind::scalar;
    }
    std::span<const char> bytes() const { return bytes_; }

    // Offset of the base register from the beginning of the table: so that displacements of one byte, which are signed, cover
    // more of it.
    static inline const asmjit::x86::Gp base = asmjit::x86::rbx;
    int bias() const { return target_.has_masks() ? 128 * target_.number_bytes() : 128; }

private:
    asmjit::x86::Mem operand(const std::string& number, Kind kind);
    int offset_of(const std::string& bytes);

    Target target_;
    std::string bytes_;
    std::unordered_map<std::string, int> offsets_;
};

}  // namespace hamilcar::program::x86
