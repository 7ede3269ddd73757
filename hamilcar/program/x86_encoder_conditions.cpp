// Comparisons, choices, conditions in mask registers, and the numbers of one car beside each other.
//
// Outside of the lanes of cars a mask has no bits set beyond its condition's width.
#if defined(__x86_64__)

#include <stdexcept>

#include "hamilcar/program/x86_encoder.hpp"

namespace hamilcar::program::x86 {

using asmjit::imm;
using asmjit::InstId;
namespace Inst = asmjit::x86::Inst;

namespace {

// Comparisons are false where numbers do not compare, their opposites true.
int predicate_of(Op op) {
    switch (op) {
        case Op::less: return 1;            // LT_OS
        case Op::less_equal: return 2;      // LE_OS
        case Op::equal: return 0;           // EQ_OQ
        case Op::not_less: return 5;        // NLT_US
        case Op::not_less_equal: return 6;  // NLE_US
        case Op::not_equal: return 4;       // NEQ_UQ
        default: throw std::logic_error("x86 encoder: no comparison");
    }
}

}  // namespace

void Encoder::compare(Op op, Kind kind, int to, int a, const Operand& b, int width) {
    static constexpr Forms legacy{Inst::kIdCmppd, Inst::kIdCmpps, Inst::kIdCmpsd, Inst::kIdCmpss};
    static constexpr Forms vex{Inst::kIdVcmppd, Inst::kIdVcmpps, Inst::kIdVcmpsd, Inst::kIdVcmpss};
    const int predicate = predicate_of(op);
    if (is_legacy()) {
        return in_two_operands(legacy, kind, to, a, b, op == Op::equal || op == Op::not_equal, predicate);
    }
    const Operand result = reg(target_.has_masks() ? Kind::mask : kind, to);
    emit(form(vex, kind), result, reg(kind, a), b, imm(predicate));
    const bool is_half_used = kind == Kind::xmm && width * target_.number_bytes() < 16;  // two singles
    if (!target_.has_masks() || !is_half_used) return;
    emit(Inst::kIdKshiftlb, result, result, imm(8 - width));
    emit(Inst::kIdKshiftrb, result, result, imm(8 - width));
}

void Encoder::select(Kind kind, int to, int condition, const Operand& b, int c) {
    const Kind whole = kind == Kind::scalar ? Kind::xmm : kind;
    if (target_.has_masks()) {
        assembler_.setExtraReg(asmjit::x86::k(static_cast<std::uint32_t>(condition)));
        const InstId id = target_.is_double() ? Inst::kIdVblendmpd : Inst::kIdVblendmps;
        return emit(id, reg(whole, to), reg(whole, c), b);
    }
    if (!is_legacy()) {
        const InstId id = target_.is_double() ? Inst::kIdVblendvpd : Inst::kIdVblendvps;
        return emit(id, reg(whole, to), reg(whole, c), b, reg(whole, condition));
    }
    // (c andnot condition) or (b and condition), in the scratch register until no operand is needed any more.
    const Operand scratch = reg(whole, sse2_scratch), result = reg(whole, to);
    if (to == condition) {
        emit(Inst::kIdMovaps, scratch, result);
        emit(Inst::kIdAndps, scratch, b);
        emit(Inst::kIdAndnps, result, reg(whole, c));
        return emit(Inst::kIdOrps, result, scratch);
    }
    emit(Inst::kIdMovaps, scratch, reg(whole, condition));
    emit(Inst::kIdAndnps, scratch, reg(whole, c));
    if (b == result) {
        emit(Inst::kIdAndps, result, reg(whole, condition));
    } else {
        emit(Inst::kIdMovaps, result, reg(whole, condition));
        emit(Inst::kIdAndps, result, b);
    }
    emit(Inst::kIdOrps, result, scratch);
}

// With masks alone.
void Encoder::select_or_zero(Kind kind, int to, int condition, const Operand& b) {
    const Kind whole = kind == Kind::scalar ? Kind::xmm : kind;
    assembler_.setExtraReg(asmjit::x86::k(static_cast<std::uint32_t>(condition)));
    assembler_.addInstOptions(asmjit::InstOptions::kX86_ZMask);
    emit(target_.is_double() ? Inst::kIdVmovapd : Inst::kIdVmovaps, reg(whole, to), b);
}

void Encoder::load_truth(Kind kind, int to, bool value, int width) {
    if (kind != Kind::mask) {
        if (!value) return load_zero(to);
        const Operand all = reg(kind, to);
        return is_legacy() ? emit(Inst::kIdPcmpeqd, all, all) : emit(Inst::kIdVpcmpeqd, all, all, all);
    }
    const Operand mask = reg(kind, to);
    if (!value) return emit(Inst::kIdKxorw, mask, mask, mask);
    emit(mask_form(Inst::kIdKxnorb, Inst::kIdKxnorw), mask, mask, mask);
    if (!target_.car_in_each_lane) emit(Inst::kIdKshiftrb, mask, mask, imm(8 - width));
}

void Encoder::mask_logic(Op op, int to, int a, int b) {
    const InstId id =
        op == Op::both ? mask_form(Inst::kIdKandb, Inst::kIdKandw) : mask_form(Inst::kIdKorb, Inst::kIdKorw);
    emit(id, reg(Kind::mask, to), reg(Kind::mask, a), reg(Kind::mask, b));
}

void Encoder::mask_opposite(int to, int a, int width) {
    const Operand result = reg(Kind::mask, to), from = reg(Kind::mask, a);
    if (target_.car_in_each_lane) return emit(mask_form(Inst::kIdKnotb, Inst::kIdKnotw), result, from);
    emit(Inst::kIdKshiftlb, result, from, imm(8 - width));
    emit(Inst::kIdKnotb, result, result);
    emit(Inst::kIdKshiftrb, result, result, imm(8 - width));
}

void Encoder::test_any(Kind kind, int condition, int width) {
    const Operand from = reg(kind, condition);
    if (kind == Kind::mask) return emit(mask_form(Inst::kIdKortestb, Inst::kIdKortestw), from, from);
    const InstId legacy = target_.is_double() ? Inst::kIdMovmskpd : Inst::kIdMovmskps;
    const InstId vex = target_.is_double() ? Inst::kIdVmovmskpd : Inst::kIdVmovmskps;
    emit(is_legacy() ? legacy : vex, asmjit::x86::eax, from);
    const int numbers = target_.car_in_each_lane ? target_.lanes() : width;
    emit(Inst::kIdTest, asmjit::x86::eax, imm((1 << numbers) - 1));
}

void Encoder::join(Kind result, int to, int a, const Operand& b, int half) {
    if (result == Kind::mask) {
        emit(Inst::kIdKshiftlb, reg(result, to), b, imm(half));
        return emit(Inst::kIdKorb, reg(result, to), reg(result, to), reg(result, a));
    }
    if (result == Kind::ymm) {
        const InstId id = target_.has_masks() ? Inst::kIdVinsertf64x2 : Inst::kIdVinsertf128;
        return emit(id, reg(result, to), reg(result, a), b, imm(1));
    }
    const bool is_pair_of_singles = !target_.is_double() && half == 1;
    const Forms legacy{Inst::kIdUnpcklpd, is_pair_of_singles ? Inst::kIdUnpcklps : Inst::kIdMovlhps, 0, 0};
    if (b.isMem()) {  // one double
        const Operand number = reg(Kind::xmm, to);
        if (!is_legacy()) return emit(Inst::kIdVmovhpd, number, reg(Kind::xmm, a), b);
        copy(Kind::xmm, to, a);
        return emit(Inst::kIdMovhpd, number, b);
    }
    if (is_legacy()) return in_two_operands(legacy, Kind::xmm, to, a, b, false, -1);
    const Forms vex{Inst::kIdVunpcklpd, is_pair_of_singles ? Inst::kIdVunpcklps : Inst::kIdVmovlhps, 0, 0};
    emit(form(vex, Kind::xmm), reg(Kind::xmm, to), reg(Kind::xmm, a), b);
}

void Encoder::part(Kind from, int to, int a, int number) {
    const Operand result = reg(Kind::xmm, to);
    if (from == Kind::mask) {
        emit(Inst::kIdKshiftlb, reg(from, to), reg(from, a), imm(7 - number));
        return emit(Inst::kIdKshiftrb, reg(from, to), reg(from, to), imm(7));
    }
    int source = a;
    const int in_xmm = 16 / target_.number_bytes();
    if (number >= in_xmm) {
        const InstId id = target_.has_masks() ? Inst::kIdVextractf64x2 : Inst::kIdVextractf128;
        emit(id, result, reg(from, a), imm(number / in_xmm));
        source = to;
    }
    const int element = number % in_xmm;
    if (element == 0) return copy(Kind::xmm, to, source);
    const Operand whole = reg(Kind::xmm, source);
    if (is_legacy()) return emit(Inst::kIdPshufd, result, whole, imm(target_.is_double() ? 0xee : 0x55 * element));
    if (target_.is_double()) return emit(Inst::kIdVunpckhpd, result, whole, whole);
    emit(Inst::kIdVshufps, result, whole, whole, imm(0x55 * element));
}

}  // namespace hamilcar::program::x86

#endif
