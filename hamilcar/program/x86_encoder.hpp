// Writes one operation of a graph as machine instructions, with given registers and memory addresses: the only
// code that distinguishes SSE2, AVX2 and AVX-512.
//
// Registers are numbers within their file. `Operand` is a register or a memory address; `takes_memory` tells which operations
// accept memory. The result's register may be an operand's, except where `needs_own_result` says otherwise.
#pragma once

#include <asmjit/x86.h>

#include "hamilcar/program/graph.hpp"
#include "hamilcar/program/x86_constants.hpp"
#include "hamilcar/program/x86_target.hpp"

namespace hamilcar::program::x86 {

// Whether operand b of this operation, where its numbers are of this kind, may be in memory.
bool takes_memory(const Target& target, Op op, Kind kind);

class Encoder {
public:
    using Mem = asmjit::x86::Mem;
    using Operand = asmjit::Operand;

    Encoder(const Target& target, asmjit::x86::Assembler& assembler) : target_(target), assembler_(assembler) {}

    // The last vector register is reserved where instructions overwrite their first operand.
    int vector_count() const {
        return target_.has_masks() ? 32 : target_.set == InstructionSet::avx2 ? 16 : sse2_scratch;
    }
    // Masks are 1 to 7; 0 means "no mask" in an instruction.
    int mask_end() const { return target_.has_masks() ? 8 : 1; }
    bool needs_own_result(Op op, Kind result) const { return op == Op::join && result == Kind::mask; }
    // Whether the result should best have an operand's register.
    bool overwrites_first() const { return target_.set == InstructionSet::sse2; }

    static asmjit::Operand reg(Kind kind, int index);
    void load(Kind kind, int to, const Mem& from);
    void load_spread(Kind kind, int to, const Mem& from);  // one number into all
    void load_zero(int to);
    void load_truth(Kind kind, int to, bool value, int width);
    void store(Kind kind, const Mem& to, int from);
    void copy(Kind kind, int to, int from);

    // `kind` is that of the numbers, for comparisons too; of the conditions for both, either, opposite.
    void unary(Op op, Kind kind, int to, const Operand& a, int width);
    void binary(Op op, Kind kind, int to, int a, const Operand& b);
    void compare(Op op, Kind kind, int to, int a, const Operand& b, int width);
    void select(Kind kind, int to, int condition, const Operand& b, int c);
    void select_or_zero(Kind kind, int to, int condition, const Operand& b);
    void join(Kind result, int to, int a, const Operand& b, int half);  // `half`: numbers in each
    void part(Kind from, int to, int a, int number);
    // Sets the flags; "not zero" where the condition holds in any of its numbers.
    void test_any(Kind kind, int condition, int width);

    template <class... Operands>
    void emit(asmjit::InstId id, const Operands&... operands) {
        assembler_.emit(id, operands...);
        ++instructions_;
    }
    std::size_t instructions() const { return instructions_; }
    ConstantTable& constants() { return constants_; }

private:
    // The same instruction for packed or single doubles or singles.
    struct Forms {
        asmjit::InstId pd, ps, sd, ss;
    };
    asmjit::InstId form(const Forms& forms, Kind kind) const;
    bool is_legacy() const { return target_.set == InstructionSet::sse2; }
    void bitwise(Op op, Kind kind, int to, int a, const Operand& b);
    void in_two_operands(const Forms& forms, Kind kind, int to, int a, const Operand& b, bool commutes, int predicate);
    void square_root(Kind kind, int to, const Operand& a);
    void mask_logic(Op op, int to, int a, int b);
    void mask_opposite(int to, int a, int width);
    asmjit::InstId mask_form(asmjit::InstId of_8, asmjit::InstId of_16) const {
        return target_.lanes() > 8 ? of_16 : of_8;
    }

    static constexpr int sse2_scratch = 15;
    Target target_;
    asmjit::x86::Assembler& assembler_;
    ConstantTable constants_{target_};
    std::size_t instructions_ = 0;
};

}  // namespace hamilcar::program::x86
