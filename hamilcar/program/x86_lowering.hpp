// From a graph to machine code in one walk over the straight list.
//
// Registers are allocated by Belady's rule: if none is free, the value whose next use is farthest is evicted. It is stored only
// the first time; constants and inputs are in memory already. A second operand that is not in a register is read from memory.
//
// The code is a function of Executable::Entry's form. Its general registers: rbp scratch on the stack, rbx table of
// constants, the arrays' pointers in the eight that a call may change, rax free.
#pragma once

#include <asmjit/x86.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "hamilcar/program/executable.hpp"
#include "hamilcar/program/graph.hpp"
#include "hamilcar/program/x86_encoder.hpp"
#include "hamilcar/program/x86_registers.hpp"
#include "hamilcar/program/x86_scratch.hpp"
#include "hamilcar/program/x86_target.hpp"
#include "hamilcar/program/x86_uses.hpp"

namespace hamilcar::program::x86 {

class Lowering {
public:
    Lowering(const Graph& graph, const Target& target, asmjit::CodeHolder& code);
    void run();
    // Except code_bytes and seconds.
    const CompileReport& report() const { return report_; }

private:
    using Mem = asmjit::x86::Mem;

    // Where a value is: in a register, on the stack, or both.
    struct Value {
        Kind kind = Kind::scalar;
        bool is_condition = false;
        int reg = -1, offset = -1;
        int constant = -1;  // among constant_operands_
    };
    struct Saved {
        Id id;
        int offset;
    };

    // x86_lowering.cpp
    void describe_values();
    void lower(Id id);
    void lower_unary(Id id);
    void lower_binary(Id id);
    void lower_select(Id id);
    void lower_join(Id id);
    void lower_part(Id id);
    void define(Id id, int reg);
    void store_outputs(Id id);
    void store_unchanged_outputs();

    // x86_lowering_registers.cpp
    RegisterFile& file(Kind kind) { return kind == Kind::mask ? masks_ : vectors_; }
    int in_register(Id id);
    asmjit::Operand operand(Id id, Op op, Kind kind);
    int take_register(Kind kind);
    int result_register(Kind kind, int preferred);
    void evict(RegisterFile& registers, int reg);
    void load_value(Id id, int reg);
    void consume(Id id);
    void release(Id id);
    void release_dead_scratch();
    Mem memory_of(Id id);
    Mem array_at(int array, int offset) const;
    Mem scratch_at(int offset) const { return asmjit::x86::ptr(asmjit::x86::rbp, offset - scratch_bias_); }
    bool is_in_memory(Id id) const { return value(id).offset >= 0 || is_available_anywhere(id); }
    // Needs no offset: constants and inputs.
    bool is_available_anywhere(Id id) const {
        return graph_.node(id).op <= Op::input || graph_.node(id).op == Op::truth;
    }
    bool is_zero(Id id) const;
    int next_use(Id id) const { return uses_.next(id, in_body_); }

    // x86_lowering_regions.cpp
    void lower_region(int which);
    void place_merge(int which, Id merge, Id from);
    void lower_body(const Region& region, const std::vector<Id>& merges);
    void save_registers(const RegisterFile& registers);
    void save_renamed();
    void store_results(const Region& region, const std::vector<Id>& merges);
    void restore_registers(RegisterFile& registers, const RegisterFile& before);
    void release_dead_in(const Region& region);
    bool is_of_body(Id id) const { return in_body_ && id >= body_first_; }
    bool is_needed(Id merge) const;

    // x86_lowering_frame.cpp
    void write_prologue();
    void write_epilogue();
    void write_constants();
    void load_array_pointers();
    void lower_call(Id id);
    void lower_result(Id id);
    void empty_registers(RegisterFile& registers);
    void write_call(const Call& call, int results);

    Value& value(Id id) { return values_[static_cast<std::size_t>(id)]; }
    const Value& value(Id id) const { return values_[static_cast<std::size_t>(id)]; }

    const Graph& graph_;
    Target target_;
    asmjit::CodeHolder& code_;
    asmjit::x86::Assembler assembler_;
    Encoder encoder_;
    UseLists uses_;
    RegisterFile vectors_, masks_;
    Scratch scratch_;
    int scratch_bias_;
    std::vector<Value> values_;
    std::vector<Mem> constant_operands_;
    std::vector<int> first_output_, next_output_;  // of a node; of the same node
    std::vector<Saved> dead_scratch_;              // may still be read by the current instruction
    int position_ = 0;
    CompileReport report_;

    std::vector<std::vector<Id>> merges_;  // of a region, by result; none if unused
    bool in_body_ = false;
    Id body_first_ = 0;
    std::vector<Saved> saved_, results_;      // by the current body
    std::vector<std::pair<Id, Id>> renamed_;  // a default that the body needs, and the merge that has its register

    int call_arguments_ = 0;         // offset of the buffer
    std::vector<int> call_results_;  // offset of a call's buffer
    std::uint32_t arrays_used_ = 0;
    bool uses_wide_registers_ = false;
    std::size_t frame_size_at_ = 0;  // in the code
    int locals_ = 0;                 // offset of the caller's stack pointer, then of the frame's address
    asmjit::Label constants_label_;
};

}  // namespace hamilcar::program::x86
