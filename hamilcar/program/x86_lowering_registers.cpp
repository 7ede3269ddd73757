// Register allocation: which value is in which register, and which is evicted.
#if defined(__x86_64__)

#include <algorithm>
#include <bit>

#include "hamilcar/program/x86_lowering.hpp"

namespace hamilcar::program::x86 {

int Lowering::in_register(Id id) {
    if (value(id).reg >= 0) return value(id).reg;
    const Kind kind = value(id).kind;
    const int reg = take_register(kind);
    load_value(id, reg);
    value(id).reg = reg;
    file(kind).assign(reg, id, next_use(id));
    return reg;
}

// A register where the value is in one or must be, else memory: a load within an instruction costs next to nothing, and to
// load what is needed again soon into a register was no faster (more instructions, and another value is evicted for it).
asmjit::Operand Lowering::operand(Id id, Op op, Kind kind) {
    const Value& found = value(id);
    const bool must = graph_.node(id).op == Op::truth || !takes_memory(target_, op, kind);
    if (found.reg >= 0 || must) return Encoder::reg(found.kind, in_register(id));
    return memory_of(id);
}

int Lowering::take_register(Kind kind) {
    RegisterFile& registers = file(kind);
    const int free = registers.free_register();
    if (free >= 0) return free;
    const int reg = registers.farthest();
    evict(registers, reg);
    return reg;
}

int Lowering::result_register(Kind kind, int preferred) {
    const bool is_free = preferred >= 0 && file(kind).occupant(preferred) == none;
    return is_free ? preferred : take_register(kind);
}

void Lowering::evict(RegisterFile& registers, int reg) {
    const Id id = registers.occupant(reg);
    if (!is_in_memory(id)) {
        value(id).offset = scratch_.take(target_.bytes(value(id).kind));
        encoder_.store(value(id).kind, memory_of(id), reg);
        ++report_.spills;
    }
    value(id).reg = -1;
    registers.release(reg);
}

void Lowering::load_value(Id id, int reg) {
    const Node& node = graph_.node(id);
    const Kind kind = value(id).kind;
    if (node.op == Op::truth) return encoder_.load_truth(kind, reg, node.a != 0, node.width);
    if (is_zero(id)) return encoder_.load_zero(reg);
    const Mem from = memory_of(id);
    if (from.hasBroadcast()) return encoder_.load_spread(kind, reg, from);
    encoder_.load(kind, reg, from);
    if (node.op != Op::constant && node.op != Op::input) ++report_.reloads;
}

bool Lowering::is_zero(Id id) const {
    if (graph_.node(id).op != Op::constant) return false;
    return std::ranges::all_of(graph_.constants(graph_.node(id)),
                               [](double x) { return std::bit_cast<std::uint64_t>(x) == 0; });
}

Lowering::Mem Lowering::memory_of(Id id) {
    const Node& node = graph_.node(id);
    Value& found = value(id);
    if (node.op == Op::input) return array_at(node.a, node.b * target_.lanes() * target_.number_bytes());
    if (node.op != Op::constant) return scratch_at(found.offset);
    if (found.constant < 0) {
        found.constant = static_cast<int>(constant_operands_.size());
        constant_operands_.push_back(encoder_.constants().numbers(graph_.constants(node), found.kind));
    }
    return constant_operands_[static_cast<std::size_t>(found.constant)];
}

// After one use. In a body the values of the main line stay: the code after it expects them where they were.
void Lowering::consume(Id id) {
    uses_.consume(id, in_body_);
    if (uses_.is_dead(id) && (!in_body_ || is_of_body(id))) {
        release(id);
    } else if (value(id).reg >= 0) {
        file(value(id).kind).set_next_use(value(id).reg, next_use(id));
    }
}

void Lowering::release(Id id) {
    Value& dead = value(id);
    if (dead.reg >= 0) file(dead.kind).release(dead.reg);
    if (dead.offset >= 0) dead_scratch_.push_back({id, dead.offset});
    dead.reg = dead.offset = -1;
}

void Lowering::release_dead_scratch() {
    for (const Saved& dead : dead_scratch_) scratch_.release(dead.offset, target_.bytes(value(dead.id).kind));
    dead_scratch_.clear();
}

}  // namespace hamilcar::program::x86

#endif
