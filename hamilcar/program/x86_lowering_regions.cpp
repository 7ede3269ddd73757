// Regions: a test and a jump on the main line, the body behind all other code.
//
// On the main line a merge is its default: the default's own register where nothing else needs it there, else a copy. The
// body begins with every register's value in memory, too; so it is written by the same walk, evicts for nothing, and at its
// end only what it has overwritten is loaded again, and the merges with its results.
#if defined(__x86_64__)

#include "hamilcar/program/x86_lowering.hpp"

namespace hamilcar::program::x86 {

void Lowering::lower_region(int which) {
    const Region& region = graph_.regions()[static_cast<std::size_t>(which)];
    const std::vector<Id>& merges = merges_[static_cast<std::size_t>(which)];
    position_ = region.first;
    const int condition = in_register(region.condition);
    // The flags last to the jump: between them values are moved, nothing else.
    encoder_.test_any(value(region.condition).kind, condition, graph_.node(region.condition).width);
    consume(region.condition);
    renamed_.clear();
    for (std::size_t i = 0; i < merges.size(); ++i) place_merge(which, merges[i], region.defaults[i]);
    release_dead_scratch();
    const asmjit::Label body = assembler_.newLabel(), behind = assembler_.newLabel();
    encoder_.emit(asmjit::x86::Inst::kIdJnz, body);
    assembler_.bind(behind);

    assembler_.section(code_.sectionById(1));
    assembler_.bind(body);
    lower_body(region, merges);
    encoder_.emit(asmjit::x86::Inst::kIdJmp, behind);
    assembler_.section(code_.textSection());

    position_ = region.last;
    for (const Id merge : merges) {
        if (merge == none) continue;
        store_outputs(merge);
        if (uses_.is_dead(merge)) release(merge);
    }
    release_dead_in(region);
    release_dead_scratch();
}

bool Lowering::is_needed(Id merge) const {
    return merge != none && (!uses_.is_dead(merge) || first_output_[static_cast<std::size_t>(merge)] >= 0);
}

void Lowering::place_merge(int which, Id merge, Id from) {
    if (!is_needed(merge)) return consume(from);
    const Kind kind = value(merge).kind;
    Value &old = value(from), &merged = value(merge);
    uses_.consume(from, false);
    const bool is_dead = uses_.is_dead(from) && !is_available_anywhere(from);
    const bool is_for_body_alone = !is_available_anywhere(from) && uses_.is_for_body_alone(from, which);
    if (is_for_body_alone && old.reg >= 0) {
        merged.reg = old.reg;
        old.reg = -1;
        if (!is_dead) renamed_.push_back({from, merge});
        file(kind).assign(merged.reg, merge, next_use(merge));
    } else if (is_dead && old.reg < 0) {
        std::swap(merged.offset, old.offset);
    } else {
        const int source = old.reg, to = take_register(kind);
        source >= 0 ? encoder_.copy(kind, to, source) : load_value(from, to);
        merged.reg = to;
        file(kind).assign(to, merge, next_use(merge));
        if (old.reg >= 0) file(kind).set_next_use(old.reg, next_use(from));
    }
    if (uses_.is_dead(from)) release(from);
}

void Lowering::lower_body(const Region& region, const std::vector<Id>& merges) {
    const RegisterFile vectors_before = vectors_, masks_before = masks_;
    in_body_ = true;
    body_first_ = region.first;
    saved_.clear();
    results_.clear();
    save_renamed();
    save_registers(vectors_before);
    save_registers(masks_before);
    vectors_.forget_overwritten();
    masks_.forget_overwritten();

    for (Id id = region.first; id < region.last; ++id) lower(id);
    position_ = region.last;
    store_results(region, merges);

    restore_registers(vectors_, vectors_before);
    restore_registers(masks_, masks_before);
    for (const Saved& result : results_) {
        Value& merged = value(result.id);
        encoder_.load(merged.kind, merged.reg, scratch_at(result.offset));
        scratch_.release(result.offset, target_.bytes(merged.kind));
    }
    for (const Saved& saved : saved_) {
        scratch_.release(saved.offset, target_.bytes(value(saved.id).kind));
        value(saved.id).offset = -1;
    }
    in_body_ = false;
}

// Defaults that the body needs are in their merges' registers, or where those were evicted to. Their stack slots belong to the body
// alone, like the saved ones.
void Lowering::save_renamed() {
    for (const auto& [id, merge] : renamed_) {
        if (value(id).offset >= 0) continue;
        const Kind kind = value(id).kind;
        const int bytes = target_.bytes(kind), offset = scratch_.take(bytes);
        if (value(merge).reg >= 0) {
            encoder_.store(kind, scratch_at(offset), value(merge).reg);
        } else {
            for (int at = 0; at < bytes; at += 4) {
                encoder_.emit(asmjit::x86::Inst::kIdMov, asmjit::x86::eax, scratch_at(value(merge).offset + at));
                encoder_.emit(asmjit::x86::Inst::kIdMov, scratch_at(offset + at), asmjit::x86::eax);
            }
        }
        value(id).offset = offset;
        saved_.push_back({id, offset});
    }
}

void Lowering::save_registers(const RegisterFile& registers) {
    for (int reg = 0; reg < RegisterFile::size; ++reg) {
        const Id id = registers.occupant(reg);
        if (id == none) continue;
        const Kind kind = value(id).kind;
        if (id >= body_first_) {  // a merge, whose register the body may have
            file(kind).release(reg);
            continue;
        }
        if (!is_in_memory(id)) {
            value(id).offset = scratch_.take(target_.bytes(kind));
            encoder_.store(kind, memory_of(id), reg);
            saved_.push_back({id, value(id).offset});
        }
        file(kind).set_next_use(reg, next_use(id));
    }
}

// A result may be a default of another merge, even cross over: all are stored before any merge's register changes.
void Lowering::store_results(const Region& region, const std::vector<Id>& merges) {
    for (std::size_t i = 0; i < merges.size(); ++i) {
        const Id result = region.results[i];
        if (is_needed(merges[i])) {
            const Value& merged = value(merges[i]);
            const int reg = in_register(result);
            int offset = merged.offset;
            if (merged.reg >= 0) {
                offset = scratch_.take(target_.bytes(merged.kind));
                results_.push_back({merges[i], offset});
            }
            encoder_.store(merged.kind, scratch_at(offset), reg);
        }
        consume(result);
    }
    release_dead_scratch();
}

void Lowering::restore_registers(RegisterFile& registers, const RegisterFile& before) {
    for (int reg = 0; reg < RegisterFile::size; ++reg) {
        if (registers.occupant(reg) != none) value(registers.occupant(reg)).reg = -1;
    }
    const std::uint32_t overwritten = registers.overwritten();
    registers = before;
    for (int reg = 0; reg < RegisterFile::size; ++reg) {
        const Id id = registers.occupant(reg);
        if (id == none) continue;
        value(id).reg = reg;
        if (id < body_first_ && (overwritten >> reg & 1) != 0) load_value(id, reg);
    }
}

// Values of the main line whose last use was in the body.
void Lowering::release_dead_in(const Region& region) {
    const auto release_dead = [&](Id id) {
        if (id < region.first && uses_.is_dead(id)) release(id);
    };
    for (Id id = region.first; id < region.last; ++id) for_each_operand(graph_, graph_.node(id), release_dead);
    for (const Id result : region.results) release_dead(result);
}

}  // namespace hamilcar::program::x86

#endif
