// The table of constants that stands behind the code: each once, as wide as the instructions that read it want.
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
    // The same bits in all numbers of a whole register: what negate, absolute and opposite need.
    asmjit::x86::Mem bits(std::uint64_t bits, Kind kind);
    bool is_spread(std::span<const double> values, Kind kind) const {
        return target_.has_masks() && values.size() == 1 && kind != Kind::scalar;
    }
    std::span<const char> bytes() const { return bytes_; }

    // The register that points into the table, this far behind its begin: so that displacements of one byte, which are
    // signed, reach more of it.
    static inline const asmjit::x86::Gp base = asmjit::x86::rbx;
    int bias() const { return target_.has_masks() ? 128 * target_.number_bytes() : 128; }

private:
    asmjit::x86::Mem operand(const std::string& number, Kind kind);
    int place(const std::string& bytes);

    Target target_;
    std::string bytes_;
    std::unordered_map<std::string, int> places_;
};

}  // namespace hamilcar::program::x86
