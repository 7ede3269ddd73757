#if defined(__x86_64__)

#include "hamilcar/program/x86_lowering.hpp"

#include <stdexcept>

namespace hamilcar::program::x86 {

namespace {

bool commutes(Op op) {
    return op == Op::add || op == Op::multiply || op == Op::equal || op == Op::not_equal || op == Op::both ||
           op == Op::either;
}

bool is_comparison(Op op) {
    return op >= Op::less && op <= Op::not_equal;
}

}  // namespace

Lowering::Lowering(const Graph& graph, const Target& target, asmjit::CodeHolder& code)
    : graph_(graph),
      target_(target),
      code_(code),
      assembler_(&code),
      encoder_(target, assembler_),
      uses_(graph),
      vectors_(0, encoder_.vector_count()),
      masks_(1, encoder_.mask_end()) {
    // Displacements of one byte are signed, and AVX-512 counts them in the operand's size.
    const int unit = !target.has_masks()       ? 1
                     : target.car_in_each_lane ? target.register_bytes()
                                               : target.number_bytes();
    scratch_bias_ = 128 * unit;
    describe_values();
}

// Kinds of values, outputs of nodes, merges of regions, arrays in use.
void Lowering::describe_values() {
    const auto size = static_cast<std::size_t>(graph_.size());
    values_.resize(size);
    for (const Region& region : graph_.regions()) merges_.emplace_back(region.defaults.size(), none);
    for (Id id = 0; id < graph_.size(); ++id) {
        const Node& node = graph_.node(id);
        if (target_.car_in_each_lane && node.width != 1) throw std::logic_error("a wide node among cars in lanes");
        bool is_condition = program::is_condition(node.op);
        if (node.op == Op::part || node.op == Op::join) is_condition = value(node.a).is_condition;
        if (node.op == Op::merge) {
            is_condition =
                value(graph_.regions()[static_cast<std::size_t>(node.a)].defaults[static_cast<std::size_t>(node.b)])
                    .is_condition;
            merges_[static_cast<std::size_t>(node.a)][static_cast<std::size_t>(node.b)] = id;
        }
        if (node.op == Op::input) arrays_used_ |= 1u << node.a;
        value(id).is_condition = is_condition;
        value(id).kind = is_condition ? target_.kind_of_condition(node.width) : target_.kind_of_numbers(node.width);
        uses_wide_registers_ |= value(id).kind == Kind::ymm || value(id).kind == Kind::zmm;
    }
    first_output_.assign(size, -1);
    for (const Output& output : graph_.outputs()) {
        int& first = first_output_[static_cast<std::size_t>(output.node)];
        next_output_.push_back(first);
        first = static_cast<int>(next_output_.size()) - 1;
        arrays_used_ |= 1u << output.array;
    }
}

void Lowering::run() {
    asmjit::Section* cold = nullptr;
    code_.newSection(&cold, ".cold", SIZE_MAX, asmjit::SectionFlags::kExecutable, 1);
    write_prologue();
    Id done = 0;
    for (std::size_t which = 0; which < graph_.regions().size(); ++which) {
        const Region& region = graph_.regions()[which];
        for (Id id = done; id < region.first; ++id) lower(id);
        lower_region(static_cast<int>(which));
        done = region.last;
    }
    for (Id id = done; id < graph_.size(); ++id) lower(id);
    store_unchanged_outputs();
    write_epilogue();
    write_constants();
    report_.instructions = encoder_.instructions();
    report_.constant_bytes = encoder_.constants().bytes().size();
    report_.scratch_bytes = static_cast<std::size_t>(scratch_.size());
}

void Lowering::lower(Id id) {
    position_ = id;
    switch (graph_.node(id).op) {
        case Op::constant:
        case Op::input:
        case Op::truth:          // materialized where they are needed
        case Op::merge: return;  // computed with its region
        case Op::call: return lower_call(id);
        case Op::result: return lower_result(id);
        case Op::square_root:
        case Op::negate:
        case Op::absolute:
        case Op::opposite: return lower_unary(id);
        case Op::select: return lower_select(id);
        case Op::join: return lower_join(id);
        case Op::part: return lower_part(id);
        default: return lower_binary(id);
    }
}

void Lowering::lower_unary(Id id) {
    const Node& node = graph_.node(id);
    const Kind kind = value(node.a).kind;
    const asmjit::Operand a = operand(node.a, node.op, kind);
    const int preferred = value(node.a).reg;
    consume(node.a);
    const int to = result_register(kind, preferred);
    encoder_.unary(node.op, kind, to, a, node.width);
    define(id, to);
}

void Lowering::lower_binary(Id id) {
    const Node& node = graph_.node(id);
    Id a = node.a, b = node.b;
    if (commutes(node.op)) {
        const bool a_is_in = value(a).reg >= 0, b_is_in = value(b).reg >= 0;
        const auto later = [&](Id one) { return uses_.next_but_one(one, in_body_); };
        // What is in a register comes first, as the second may be in memory; if neither is, what is needed sooner again.
        bool swap = a_is_in == b_is_in ? later(b) < later(a) : b_is_in;
        if (a_is_in && b_is_in) swap = encoder_.overwrites_first() && later(b) > later(a);
        if (swap) std::swap(a, b);
    }
    const Kind kind = value(a).kind;
    const int first = in_register(a);
    const asmjit::Operand second = operand(b, node.op, kind);
    consume(a);
    const Kind result = value(id).kind;
    const bool same_file = (result == Kind::mask) == (kind == Kind::mask);
    int to = same_file && value(a).reg < 0 ? first : -1;
    // A result in the second operand's register costs two more copies where instructions overwrite the first.
    if (to < 0 && encoder_.overwrites_first() && !commutes(node.op)) to = file(result).free_register();
    consume(b);
    if (to < 0) to = take_register(result);
    if (is_comparison(node.op)) {
        encoder_.compare(node.op, kind, to, first, second, node.width);
    } else {
        encoder_.binary(node.op, kind, to, first, second);
    }
    define(id, to);
}

void Lowering::lower_select(Id id) {
    const Node& node = graph_.node(id);
    const Kind kind = value(id).kind;
    const bool or_zero = target_.has_masks() && is_zero(node.c);
    const int condition = in_register(node.a);
    const int c = or_zero ? -1 : in_register(node.c);
    const bool is_spread = graph_.node(node.b).op == Op::constant && target_.has_masks();
    const asmjit::Operand b =
        or_zero && is_spread ? Encoder::reg(kind, in_register(node.b)) : operand(node.b, Op::select, kind);
    const int b_register = value(node.b).reg;
    consume(node.a);
    consume(node.b);
    consume(node.c);
    const int to = result_register(kind, c >= 0 && value(node.c).reg < 0 ? c : b_register);
    or_zero ? encoder_.select_or_zero(kind, to, condition, b) : encoder_.select(kind, to, condition, b, c);
    define(id, to);
}

void Lowering::lower_join(Id id) {
    const Node& node = graph_.node(id);
    const Kind kind = value(id).kind;
    const int half = graph_.node(node.a).width;
    const int a = in_register(node.a);
    // A condition of one number takes more memory than the number that `join` would read.
    const bool is_condition = value(id).is_condition;
    const asmjit::Operand b =
        is_condition ? Encoder::reg(value(node.b).kind, in_register(node.b)) : operand(node.b, Op::join, kind);
    int to = encoder_.needs_own_result(Op::join, kind) ? take_register(kind) : -1;
    consume(node.a);
    consume(node.b);
    if (to < 0) to = result_register(kind, a);
    encoder_.join(kind, to, a, b, half);
    define(id, to);
}

void Lowering::lower_part(Id id) {
    const Node& node = graph_.node(id);
    const Value& from = value(node.a);
    const Kind kind = value(id).kind;
    const int reg = from.reg;
    if (reg < 0 && from.offset >= 0 && kind != Kind::mask) {  // the number alone
        const Mem number = scratch_at(from.offset + node.b * target_.number_bytes());
        consume(node.a);
        const int to = result_register(kind, -1);
        encoder_.load(Kind::scalar, to, number);
        return define(id, to);
    }
    const int whole = in_register(node.a);
    const Kind kind_of_whole = from.kind;
    consume(node.a);
    const int to = result_register(kind, whole);
    encoder_.part(kind_of_whole, to, whole, node.b);
    define(id, to);
}

void Lowering::define(Id id, int reg) {
    value(id).reg = reg;
    file(value(id).kind).assign(reg, id, next_use(id));
    release_dead_scratch();
    store_outputs(id);
    if (uses_.is_dead(id)) release(id);
}

void Lowering::store_outputs(Id id) {
    for (int at = first_output_[static_cast<std::size_t>(id)]; at >= 0;) {
        const Output& output = graph_.outputs()[static_cast<std::size_t>(at)];
        const int number_bytes = target_.lanes() * target_.number_bytes();
        const int reg = in_register(id);
        encoder_.store(value(id).kind, array_at(output.array, output.index * number_bytes), reg);
        at = next_output_[static_cast<std::size_t>(at)];
    }
}

// Inputs and constants, which are no operation that an output could follow.
void Lowering::store_unchanged_outputs() {
    position_ = graph_.size();
    for (Id id = 0; id < graph_.size(); ++id) {
        if (!is_available_anywhere(id) || first_output_[static_cast<std::size_t>(id)] < 0) continue;
        store_outputs(id);
        release(id);
    }
}

}  // namespace hamilcar::program::x86

#endif
