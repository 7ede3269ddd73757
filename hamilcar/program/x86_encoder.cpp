// Operations on numbers; conditions, parts and joins are in x86_encoder_conditions.cpp.
#if defined(__x86_64__)

#include "hamilcar/program/x86_encoder.hpp"

#include <stdexcept>

namespace hamilcar::program::x86 {

using asmjit::InstId;
using asmjit::Operand;
namespace Inst = asmjit::x86::Inst;

bool takes_memory(const Target& target, Op op, Kind kind) {
    switch (op) {
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::divide:
        case Op::minimum:
        case Op::maximum:
        case Op::less:
        case Op::less_equal:
        case Op::equal:
        case Op::not_less:
        case Op::not_less_equal:
        case Op::not_equal: return true;
        // These read whole registers, which a single number in memory does not fill.
        case Op::square_root:
        case Op::select: return kind != Kind::scalar;
        case Op::both:
        case Op::either: return kind != Kind::mask;
        case Op::join: return kind == Kind::ymm || (kind == Kind::xmm && target.is_double());
        default: return false;
    }
}

Operand Encoder::reg(Kind kind, int index) {
    const auto id = static_cast<std::uint32_t>(index);
    switch (kind) {
        case Kind::ymm: return asmjit::x86::ymm(id);
        case Kind::zmm: return asmjit::x86::zmm(id);
        case Kind::mask: return asmjit::x86::k(id);
        default: return asmjit::x86::xmm(id);
    }
}

InstId Encoder::form(const Forms& forms, Kind kind) const {
    if (kind == Kind::scalar) return target_.is_double() ? forms.sd : forms.ss;
    return target_.is_double() ? forms.pd : forms.ps;
}

void Encoder::load(Kind kind, int to, const Mem& from) {
    if (kind == Kind::mask) return emit(Inst::kIdKmovw, reg(kind, to), from);
    static constexpr Forms legacy{Inst::kIdMovaps, Inst::kIdMovaps, Inst::kIdMovsd, Inst::kIdMovss};
    static constexpr Forms vex{Inst::kIdVmovaps, Inst::kIdVmovaps, Inst::kIdVmovsd, Inst::kIdVmovss};
    emit(form(is_legacy() ? legacy : vex, kind), reg(kind, to), from);
}

void Encoder::load_spread(Kind kind, int to, const Mem& from) {
    Mem number = from;
    number.resetBroadcast();
    emit(target_.is_double() ? Inst::kIdVbroadcastsd : Inst::kIdVbroadcastss, reg(kind, to), number);
}

void Encoder::load_zero(int to) {
    const Operand all = reg(Kind::xmm, to);  // the rest of a wider register becomes zero with it
    is_legacy() ? emit(Inst::kIdXorps, all, all) : emit(Inst::kIdVxorps, all, all, all);
}

void Encoder::store(Kind kind, const Mem& to, int from) {
    if (kind == Kind::mask) return emit(Inst::kIdKmovw, to, reg(kind, from));
    static constexpr Forms legacy{Inst::kIdMovaps, Inst::kIdMovaps, Inst::kIdMovsd, Inst::kIdMovss};
    static constexpr Forms vex{Inst::kIdVmovaps, Inst::kIdVmovaps, Inst::kIdVmovsd, Inst::kIdVmovss};
    emit(form(is_legacy() ? legacy : vex, kind), to, reg(kind, from));
}

void Encoder::copy(Kind kind, int to, int from) {
    if (to == from) return;
    const InstId id = kind == Kind::mask ? Inst::kIdKmovw : is_legacy() ? Inst::kIdMovaps : Inst::kIdVmovaps;
    emit(id, reg(kind, to), reg(kind, from));
}

// Instructions that overwrite their first operand.
void Encoder::in_two_operands(const Forms& forms, Kind kind, int to, int a, const Operand& b, bool commutes,
                              int predicate) {
    Operand first = reg(kind, a), second = b;
    const bool second_is_overwritten = to != a && second == reg(kind, to);
    if (second_is_overwritten && commutes) {
        std::swap(first, second);
        a = to;
    } else if (second_is_overwritten) {
        copy(kind, sse2_scratch, to);
        second = reg(kind, sse2_scratch);
    }
    copy(kind, to, a);
    const InstId id = form(forms, kind);
    predicate < 0 ? emit(id, reg(kind, to), second) : emit(id, reg(kind, to), second, asmjit::imm(predicate));
}

void Encoder::binary(Op op, Kind kind, int to, int a, const Operand& b) {
    struct Arithmetic {
        Forms legacy, vex;
    };
    static constexpr Arithmetic sum{{Inst::kIdAddpd, Inst::kIdAddps, Inst::kIdAddsd, Inst::kIdAddss},
                                    {Inst::kIdVaddpd, Inst::kIdVaddps, Inst::kIdVaddsd, Inst::kIdVaddss}};
    static constexpr Arithmetic difference{{Inst::kIdSubpd, Inst::kIdSubps, Inst::kIdSubsd, Inst::kIdSubss},
                                           {Inst::kIdVsubpd, Inst::kIdVsubps, Inst::kIdVsubsd, Inst::kIdVsubss}};
    static constexpr Arithmetic product{{Inst::kIdMulpd, Inst::kIdMulps, Inst::kIdMulsd, Inst::kIdMulss},
                                        {Inst::kIdVmulpd, Inst::kIdVmulps, Inst::kIdVmulsd, Inst::kIdVmulss}};
    static constexpr Arithmetic quotient{{Inst::kIdDivpd, Inst::kIdDivps, Inst::kIdDivsd, Inst::kIdDivss},
                                         {Inst::kIdVdivpd, Inst::kIdVdivps, Inst::kIdVdivsd, Inst::kIdVdivss}};
    // Both give the second operand where the numbers do not compare or are both zero, as the graph's choices do.
    static constexpr Arithmetic minimum{{Inst::kIdMinpd, Inst::kIdMinps, Inst::kIdMinsd, Inst::kIdMinss},
                                        {Inst::kIdVminpd, Inst::kIdVminps, Inst::kIdVminsd, Inst::kIdVminss}};
    static constexpr Arithmetic maximum{{Inst::kIdMaxpd, Inst::kIdMaxps, Inst::kIdMaxsd, Inst::kIdMaxss},
                                        {Inst::kIdVmaxpd, Inst::kIdVmaxps, Inst::kIdVmaxsd, Inst::kIdVmaxss}};
    const Arithmetic* found = nullptr;
    switch (op) {
        case Op::add: found = &sum; break;
        case Op::subtract: found = &difference; break;
        case Op::multiply: found = &product; break;
        case Op::divide: found = &quotient; break;
        case Op::minimum: found = &minimum; break;
        case Op::maximum: found = &maximum; break;
        case Op::both:
        case Op::either: return bitwise(op, kind, to, a, b);
        default: throw std::logic_error("x86 encoder: no operation on two numbers");
    }
    if (is_legacy()) {
        const bool commutes = op == Op::add || op == Op::multiply;
        return in_two_operands(found->legacy, kind, to, a, b, commutes, -1);
    }
    emit(form(found->vex, kind), reg(kind, to), reg(kind, a), b);
}

void Encoder::unary(Op op, Kind kind, int to, const Operand& a, int width) {
    if (op == Op::square_root) return square_root(kind, to, a);
    const int from = static_cast<int>(a.as<asmjit::BaseReg>().id());
    if (kind == Kind::mask) return mask_opposite(to, from, width);
    const Kind whole = kind == Kind::scalar ? Kind::xmm : kind;
    const std::uint64_t sign = target_.is_double() ? std::uint64_t{1} << 63 : std::uint64_t{1} << 31;
    switch (op) {
        case Op::negate: return bitwise(Op::negate, whole, to, from, constants_.bits(sign, whole));
        case Op::absolute: return bitwise(Op::both, whole, to, from, constants_.bits(sign - 1, whole));
        case Op::opposite: return bitwise(Op::negate, whole, to, from, constants_.bits(~std::uint64_t{0}, whole));
        default: throw std::logic_error("x86 encoder: no operation on one number");
    }
}

void Encoder::square_root(Kind kind, int to, const Operand& a) {
    if (kind != Kind::scalar) {
        const InstId id = is_legacy() ? form({Inst::kIdSqrtpd, Inst::kIdSqrtps, 0, 0}, kind)
                                      : form({Inst::kIdVsqrtpd, Inst::kIdVsqrtps, 0, 0}, kind);
        return emit(id, reg(kind, to), a);
    }
    // The rest of the result's register is copied from the operand, to avoid a dependency on anything else.
    if (is_legacy()) {
        copy(kind, to, static_cast<int>(a.as<asmjit::BaseReg>().id()));
        return emit(form({0, 0, Inst::kIdSqrtsd, Inst::kIdSqrtss}, kind), reg(kind, to), reg(kind, to));
    }
    emit(form({0, 0, Inst::kIdVsqrtsd, Inst::kIdVsqrtss}, kind), reg(kind, to), a, a);
}

// `negate` stands for exclusive or.
void Encoder::bitwise(Op op, Kind kind, int to, int a, const Operand& b) {
    if (kind == Kind::mask) return mask_logic(op, to, a, static_cast<int>(b.as<asmjit::BaseReg>().id()));
    static constexpr Forms legacy_and{Inst::kIdAndpd, Inst::kIdAndps, 0, 0},
        vex_and{Inst::kIdVandpd, Inst::kIdVandps, 0, 0};
    static constexpr Forms legacy_or{Inst::kIdOrpd, Inst::kIdOrps, 0, 0}, vex_or{Inst::kIdVorpd, Inst::kIdVorps, 0, 0};
    static constexpr Forms legacy_xor{Inst::kIdXorpd, Inst::kIdXorps, 0, 0},
        vex_xor{Inst::kIdVxorpd, Inst::kIdVxorps, 0, 0};
    if (is_legacy()) {
        const Forms& forms = op == Op::both ? legacy_and : op == Op::either ? legacy_or : legacy_xor;
        return in_two_operands(forms, kind, to, a, b, true, -1);
    }
    const Forms& forms = op == Op::both ? vex_and : op == Op::either ? vex_or : vex_xor;
    emit(form(forms, kind), reg(kind, to), reg(kind, a), b);
}

}  // namespace hamilcar::program::x86

#endif
