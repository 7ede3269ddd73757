#include "hamilcar/program/portable_code.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/base/assert.hpp"

namespace hamilcar::program::portable {

namespace {

template <class Number, Op op>
Number computed(Number a, Number b) {
    if constexpr (op == Op::add) return a + b;
    if constexpr (op == Op::subtract) return a - b;
    if constexpr (op == Op::multiply) return a * b;
    if constexpr (op == Op::divide) return a / b;
    if constexpr (op == Op::minimum) return a < b ? a : b;
    if constexpr (op == Op::maximum) return b < a ? a : b;
    if constexpr (op == Op::less) return truth_number<Number>(a < b);
    if constexpr (op == Op::less_equal) return truth_number<Number>(a <= b);
    if constexpr (op == Op::equal) return truth_number<Number>(a == b);
    if constexpr (op == Op::not_less) return truth_number<Number>(!(a < b));
    if constexpr (op == Op::not_less_equal) return truth_number<Number>(!(a <= b));
    if constexpr (op == Op::not_equal) return truth_number<Number>(!(a == b));
    if constexpr (op == Op::both) return std::bit_cast<Number>(bits(a) & bits(b));
    if constexpr (op == Op::either) return std::bit_cast<Number>(bits(a) | bits(b));
}

template <class Number, Op op>
Number computed(Number a) {
    if constexpr (op == Op::square_root) return std::sqrt(a);
    if constexpr (op == Op::negate) return -a;
    if constexpr (op == Op::absolute) return std::fabs(a);
    if constexpr (op == Op::opposite) return std::bit_cast<Number>(~bits(a));
}

// The loops in functions of their own: compilers rely on `__restrict` only for parameters.
template <class Number, int count, Op op>
void compute(Number* __restrict result, const Number* __restrict a) {
    for (int i = 0; i < count; ++i) result[i] = computed<Number, op>(a[i]);
}

template <class Number, int count, Op op>
void compute(Number* __restrict result, const Number* __restrict a, const Number* __restrict b) {
    for (int i = 0; i < count; ++i) result[i] = computed<Number, op>(a[i], b[i]);
}

template <class Number, int count>
void choose(Number* __restrict result, const Number* __restrict condition, const Number* __restrict b,
            const Number* __restrict c) {
    for (int i = 0; i < count; ++i) {
        const Bits<Number> holds = bits(condition[i]);
        result[i] = std::bit_cast<Number>((holds & bits(b[i])) | (~holds & bits(c[i])));
    }
}

template <class Number, int count, Op op>
void unary(const Memory<Number>& memory, const Operation* first, const Operation* last) {
    for (; first != last; ++first) compute<Number, count, op>(memory.scratch + first->result, memory[first->a]);
}

template <class Number, int count, Op op>
void binary(const Memory<Number>& memory, const Operation* first, const Operation* last) {
    for (; first != last; ++first) {
        compute<Number, count, op>(memory.scratch + first->result, memory[first->a], memory[first->b]);
    }
}

template <class Number, int count>
void select(const Memory<Number>& memory, const Operation* first, const Operation* last) {
    for (; first != last; ++first) {
        choose<Number, count>(memory.scratch + first->result, memory[first->a], memory[first->b], memory[first->c]);
    }
}

template <class Number, int count>
void copy(const Memory<Number>& memory, const Operation* first, const Operation* last) {
    for (; first != last; ++first) std::copy_n(memory[first->a], count, memory.scratch + first->result);
}

template <class Number, int count>
Work<Number> work_on(Op op) {
    switch (op) {
        case Op::add: return binary<Number, count, Op::add>;
        case Op::subtract: return binary<Number, count, Op::subtract>;
        case Op::multiply: return binary<Number, count, Op::multiply>;
        case Op::divide: return binary<Number, count, Op::divide>;
        case Op::square_root: return unary<Number, count, Op::square_root>;
        case Op::negate: return unary<Number, count, Op::negate>;
        case Op::absolute: return unary<Number, count, Op::absolute>;
        case Op::minimum: return binary<Number, count, Op::minimum>;
        case Op::maximum: return binary<Number, count, Op::maximum>;
        case Op::less: return binary<Number, count, Op::less>;
        case Op::less_equal: return binary<Number, count, Op::less_equal>;
        case Op::equal: return binary<Number, count, Op::equal>;
        case Op::not_less: return binary<Number, count, Op::not_less>;
        case Op::not_less_equal: return binary<Number, count, Op::not_less_equal>;
        case Op::not_equal: return binary<Number, count, Op::not_equal>;
        case Op::both: return binary<Number, count, Op::both>;
        case Op::either: return binary<Number, count, Op::either>;
        case Op::opposite: return unary<Number, count, Op::opposite>;
        case Op::select: return select<Number, count>;
        default: return copy<Number, count>;  // of joins, merges and arguments
    }
}

}  // namespace

template <class Number>
Work<Number> work(Op op, int count) {
    switch (count) {
        case 1: return work_on<Number, 1>(op);
        case 2: return work_on<Number, 2>(op);
        case 4: return work_on<Number, 4>(op);
        case 8: return work_on<Number, 8>(op);
        default: HAMILCAR_ASSERT(count == 16); return work_on<Number, 16>(op);
    }
}

namespace {

// Whether the condition holds in any number.
template <class Number>
bool holds(const Number* condition, int numbers) {
    Bits<Number> found = 0;
    for (int i = 0; i < numbers; ++i) found |= bits(condition[i]);
    return found != 0;
}

}  // namespace

template <class Number>
void Code<Number>::walk(const Frame& frame, Number* scratch) const {
    Memory<Number> memory{scratch, {}};
    memory.bases[scratch_base] = scratch;
    memory.bases[constants_base] = constants.data();
    for (std::size_t i = 0; i < max_arrays; ++i) {
        memory.bases[arrays_base + i] = static_cast<const Number*>(frame.arrays[i]);
    }
    for (std::size_t i = 0; i < steps.size();) {
        const Step& step = steps[i];
        for (std::size_t k = step.first; k < step.last; ++k) {
            groups[k].work(memory, operations.data() + groups[k].first, operations.data() + groups[k].last);
        }
        ++i;
        if (step.then == Step::Then::call) {
            frame.functions[step.function](frame.context, step.detail, lanes, scratch + step.arguments,
                                           scratch + step.results);
        } else if (step.then == Step::Then::go_to ||
                   (step.then == Step::Then::enter_region && !holds(memory[step.condition], step.numbers))) {
            i = step.target;
        }
    }
    for (const Store& store : stores) {
        Number* to = static_cast<Number*>(frame.arrays[store.array]) + store.offset;
        std::copy_n(memory[store.from], lanes, to);
    }
}

template void Code<double>::walk(const Frame& frame, double* scratch) const;
template void Code<float>::walk(const Frame& frame, float* scratch) const;
template Work<double> work<double>(Op op, int count);
template Work<float> work<float>(Op op, int count);

}  // namespace hamilcar::program::portable
