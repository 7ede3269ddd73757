// A recording number: every operation on it becomes a node of a graph (program/graph.hpp), and nothing is computed. Running the
// core once with it, for one vehicle, records the straight-line operations of that vehicle's step.
//
// Conditions never become a bool unless they are known while recording; otherwise `any` is true, so that both branches are
// recorded and a `select` decides, except in `unless`, whose rare branch becomes a region that can be skipped.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/program/graph.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Numbers of this thread record into the graph of the innermost Tracing in scope.
class Tracing {
public:
    explicit Tracing(program::Graph& graph) : before_(current()) {
        current() = &graph;
        graph.constant(0.0);  // node 0 is zero, the value of default-constructed numbers
    }
    ~Tracing() { current() = before_; }
    Tracing(const Tracing&) = delete;
    Tracing& operator=(const Tracing&) = delete;

    static program::Graph& graph() {
        HAMILCAR_ASSERT(current() != nullptr);
        return *current();
    }

private:
    static program::Graph*& current() {
        thread_local program::Graph* graph = nullptr;
        return graph;
    }
    program::Graph* before_;
};

// A condition for each of `width` numbers side by side.
template <int width>
class TracedCondition {
public:
    explicit TracedCondition(program::Id id) : id_(id) {}
    program::Id id() const { return id_; }
    explicit operator bool() const = delete;

    friend TracedCondition operator&&(TracedCondition a, TracedCondition b) {
        return TracedCondition(Tracing::graph().add(program::Op::both, a.id_, b.id_));
    }
    friend TracedCondition operator||(TracedCondition a, TracedCondition b) {
        return TracedCondition(Tracing::graph().add(program::Op::either, a.id_, b.id_));
    }
    friend TracedCondition operator!(TracedCondition a) {
        return TracedCondition(Tracing::graph().add(program::Op::opposite, a.id_));
    }
    friend bool any(TracedCondition a) { return !Tracing::graph().is_truth(a.id_, false); }

private:
    program::Id id_;
};

// `width` numbers side by side, in the precision of the graph.
template <int width = 1>
class Traced {
public:
    using Condition = TracedCondition<width>;

    Traced() = default;
    Traced(double same)
        : id_(Tracing::graph().constant(same, width)) {}  // implicit: constants enter formulas as numbers
    explicit Traced(const std::array<Traced<1>, width>& numbers) requires(width == 2)
        : id_(Tracing::graph().add(program::Op::join, numbers[0].id(), numbers[1].id())) {}
    // The same number in both lanes.
    template <int single>
    requires(single == 1 && width == 2) explicit Traced(const Traced<single>& same) : Traced(std::array{same, same}) {}
    static Traced of(program::Id id) {
        Traced out;
        out.id_ = id;
        return out;
    }
    program::Id id() const { return id_; }

    friend Traced operator+(Traced a, Traced b) { return of(program::Op::add, a, b); }
    friend Traced operator-(Traced a, Traced b) { return of(program::Op::subtract, a, b); }
    friend Traced operator*(Traced a, Traced b) { return of(program::Op::multiply, a, b); }
    friend Traced operator/(Traced a, Traced b) { return of(program::Op::divide, a, b); }
    friend Traced operator-(Traced a) { return of(program::Op::negate, a); }
    Traced& operator+=(Traced b) { return *this = *this + b; }
    Traced& operator-=(Traced b) { return *this = *this - b; }
    Traced& operator*=(Traced b) { return *this = *this * b; }
    Traced& operator/=(Traced b) { return *this = *this / b; }
    friend Condition operator<(Traced a, Traced b) { return compared(program::Op::less, a, b); }
    friend Condition operator>(Traced a, Traced b) { return compared(program::Op::less, b, a); }
    friend Condition operator<=(Traced a, Traced b) { return compared(program::Op::less_equal, a, b); }
    friend Condition operator>=(Traced a, Traced b) { return compared(program::Op::less_equal, b, a); }
    friend Condition operator==(Traced a, Traced b) { return compared(program::Op::equal, a, b); }
    friend Condition operator!=(Traced a, Traced b) { return compared(program::Op::not_equal, a, b); }

    friend Traced sqrt(Traced x) { return of(program::Op::square_root, x); }
    friend Traced abs(Traced x) { return of(program::Op::absolute, x); }
    friend Traced min(Traced a, Traced b) { return of(program::Op::minimum, a, b); }
    friend Traced max(Traced a, Traced b) { return of(program::Op::maximum, a, b); }
    friend Traced select(Condition condition, Traced yes, Traced no) {
        return of(Tracing::graph().add(program::Op::select, condition.id(), yes.id_, no.id_));
    }

private:
    static Traced of(program::Op op, Traced a) { return of(Tracing::graph().add(op, a.id_)); }
    static Traced of(program::Op op, Traced a, Traced b) { return of(Tracing::graph().add(op, a.id_, b.id_)); }
    static Condition compared(program::Op op, Traced a, Traced b) {
        return Condition(Tracing::graph().add(op, a.id_, b.id_));
    }

    program::Id id_ = 0;
};

template <class T>
inline constexpr bool is_traced = false;
template <int width>
inline constexpr bool is_traced<Traced<width>> = true;

template <int width>
struct Lanes<Traced<width>> {
    static constexpr int count = width;
    using Element = Traced<1>;
    static Element get(const Traced<width>& number, int i) {
        return Element::of(Tracing::graph().add(program::Op::part, number.id(), i));
    }
    static void set(Traced<width>& number, int i, const Element& element) {
        if constexpr (width == 1) {
            number = element;
        } else {
            std::array<Element, width> numbers{get(number, 0), get(number, 1)};
            numbers[static_cast<std::size_t>(i)] = element;
            number = Traced<width>(numbers);
        }
    }
};

template <int width>
struct PrecisionOf<Traced<width>> {
    template <class F>
    static auto choose(const F& f) {
        return Tracing::graph().precision() == program::Precision::single_precision ? f(float{}) : f(double{});
    }
};

// The common branch is recorded inline, the rare one as a region. Regions do not nest: within one the rare branch is always taken.
template <int width, class Common, class Rare>
auto unless(TracedCondition<width> condition, const Common& common, const Rare& rare) {
    program::Graph& graph = Tracing::graph();
    if (graph.is_truth(condition.id(), false)) return common();
    if (graph.is_truth(condition.id(), true) || graph.in_region()) return rare();
    const auto common_numbers = common();
    using Numbers = decltype(common_numbers);
    graph.begin_region(condition.id());
    const Numbers found = rare();
    std::remove_const_t<Numbers> out = common_numbers;
    std::vector<program::Id> defaults, results;
    std::vector<std::size_t> indices;  // indices of the differing numbers
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (common_numbers[i].id() == found[i].id()) continue;
        defaults.push_back(common_numbers[i].id()), results.push_back(found[i].id());
        indices.push_back(i);
    }
    const std::vector<program::Id> merged = graph.end_region(defaults, results);
    for (std::size_t i = 0; i < indices.size(); ++i) out[indices[i]] = std::decay_t<decltype(out[0])>::of(merged[i]);
    return out;
}

}  // namespace hamilcar
