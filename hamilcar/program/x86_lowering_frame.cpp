// Entry and exit, calls, and the layout around the code: scratch on the stack, pointers of arrays, constants.
#if defined(__x86_64__)

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "hamilcar/program/x86_lowering.hpp"

namespace hamilcar::program::x86 {

using namespace asmjit::x86;

namespace {

// All of them caller-saved, without rax.
constexpr std::array<Gp, max_arrays> array_registers{rdi, rsi, rdx, rcx, r8, r9, r10, r11};

constexpr int alignment = 64;

}  // namespace

Mem Lowering::array_at(int array, int offset) const {
    return ptr(array_registers[static_cast<std::size_t>(array)], offset);
}

void Lowering::write_prologue() {
    encoder_.emit(Inst::kIdPush, rbx);
    encoder_.emit(Inst::kIdPush, rbp);
    encoder_.emit(Inst::kIdMov, rax, rsp);
    encoder_.emit(Inst::kIdSub, rsp, asmjit::imm(0x7fffffff));  // the scratch's size, known at the end
    frame_size_at_ = assembler_.offset() - 4;
    encoder_.emit(Inst::kIdAnd, rsp, asmjit::imm(-alignment));
    encoder_.emit(Inst::kIdLea, rbp, ptr(rsp, scratch_bias_));
    locals_ = scratch_.block(16, alignment);
    encoder_.emit(Inst::kIdMov, scratch_at(locals_), rax);
    encoder_.emit(Inst::kIdMov, scratch_at(locals_ + 8), rsi);
    constants_label_ = assembler_.newLabel();
    encoder_.emit(Inst::kIdLea, rbx, ptr(constants_label_, encoder_.constants().bias()));
    load_array_pointers();

    std::size_t max_arguments = 0;
    for (const Call& call : graph_.calls()) max_arguments = std::max(max_arguments, call.arguments.size());
    const int number_bytes = target_.lanes() * target_.number_bytes();
    if (max_arguments > 0) call_arguments_ = scratch_.block(static_cast<int>(max_arguments) * number_bytes, alignment);
    call_results_.assign(graph_.calls().size(), 0);
}

void Lowering::load_array_pointers() {
    encoder_.emit(Inst::kIdMov, rax, scratch_at(locals_ + 8));
    for (int array = 0; array < max_arrays; ++array) {
        if ((arrays_used_ >> array & 1) == 0) continue;
        const auto offset = static_cast<int>(offsetof(Frame, arrays)) + array * static_cast<int>(sizeof(void*));
        encoder_.emit(Inst::kIdMov, array_registers[static_cast<std::size_t>(array)], ptr(rax, offset));
    }
}

void Lowering::write_epilogue() {
    if (uses_wide_registers_ && target_.set != InstructionSet::sse2) encoder_.emit(Inst::kIdVzeroupper);
    encoder_.emit(Inst::kIdMov, rsp, scratch_at(locals_));
    encoder_.emit(Inst::kIdPop, rbp);
    encoder_.emit(Inst::kIdPop, rbx);
    encoder_.emit(Inst::kIdRet);
    scratch_.block(0, alignment);
    const auto frame_size = static_cast<std::uint32_t>(scratch_.size());
    std::memcpy(code_.textSection()->data() + frame_size_at_, &frame_size, sizeof frame_size);
}

void Lowering::write_constants() {
    asmjit::Section* section = nullptr;
    code_.newSection(&section, ".rodata", SIZE_MAX, asmjit::SectionFlags::kReadOnly, alignment);
    assembler_.section(section);
    assembler_.bind(constants_label_);
    const std::span<const char> bytes = encoder_.constants().bytes();
    assembler_.embed(bytes.data(), bytes.size());
}

// A call may change all registers, so live values are stored first; results stay in their buffer until they are needed.
void Lowering::lower_call(Id id) {
    const Node& node = graph_.node(id);
    const Call& call = graph_.calls()[static_cast<std::size_t>(node.a)];
    const int number_bytes = target_.lanes() * target_.number_bytes();
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
        const Id argument = call.arguments[i];
        const int reg = in_register(argument);
        encoder_.store(value(argument).kind, scratch_at(call_arguments_ + static_cast<int>(i) * number_bytes), reg);
        consume(argument);
    }
    release_dead_scratch();
    empty_registers(vectors_);
    empty_registers(masks_);
    const int results = scratch_.block(call.result_count * number_bytes, alignment);
    call_results_[static_cast<std::size_t>(node.a)] = results;
    write_call(call, results);
}

void Lowering::empty_registers(RegisterFile& registers) {
    for (int reg = 0; reg < RegisterFile::size; ++reg) {
        if (registers.occupant(reg) != none) evict(registers, reg);
    }
    registers.overwrite_all();
}

// By the System V calling convention.
void Lowering::write_call(const Call& call, int results) {
    encoder_.emit(Inst::kIdMov, rax, scratch_at(locals_ + 8));
    encoder_.emit(Inst::kIdMov, rdi, ptr(rax, static_cast<int>(offsetof(Frame, context))));
    encoder_.emit(Inst::kIdMov, rax, ptr(rax, static_cast<int>(offsetof(Frame, functions))));
    encoder_.emit(Inst::kIdMov, esi, asmjit::imm(call.detail));
    encoder_.emit(Inst::kIdMov, edx, asmjit::imm(target_.lanes()));
    encoder_.emit(Inst::kIdLea, rcx, scratch_at(call_arguments_));
    encoder_.emit(Inst::kIdLea, r8, scratch_at(results));
    if (uses_wide_registers_ && target_.set != InstructionSet::sse2) encoder_.emit(Inst::kIdVzeroupper);
    encoder_.emit(Inst::kIdCall, ptr(rax, call.function * static_cast<int>(sizeof(CallFunction)), 8));
    load_array_pointers();
}

void Lowering::lower_result(Id id) {
    const Node& node = graph_.node(id);
    const int number_bytes = target_.lanes() * target_.number_bytes();
    value(id).offset = call_results_[static_cast<std::size_t>(graph_.node(node.a).a)] + node.b * number_bytes;
    store_outputs(id);
    if (uses_.is_dead(id)) release(id);
}

}  // namespace hamilcar::program::x86

#endif
