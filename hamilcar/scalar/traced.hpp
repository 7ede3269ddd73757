// A number that records: what is done to it becomes nodes of a graph (program/graph.hpp), and nothing is computed. The core run
// with it once, for one vehicle, leaves the straight list of operations of that vehicle's step.
//
// Conditions never become a bool unless they are known while recording; `any` of one that is not is true, so that both ways are
// recorded and a `select` decides, except in `unless`, whose rare way becomes a region that is skipped.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hamilcar/program/graph.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Numbers of this thread record into the graph of the latest Tracing that is alive.
class Tracing {
public:
    explicit Tracing(program::Graph& graph) : before_(current()) {
        current() = &graph;
        graph.constant(0.0);  // so that node 0 is a zero: what numbers are until they are given something
    }
    ~Tracing() { current() = before_; }
    Tracing(const Tracing&) = delete;
    Tracing& operator=(const Tracing&) = delete;

    static program::Graph& graph() { return *current(); }

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

// `E`, double or float, is what the program will compute in; `width`: as many numbers side by side.
template <class E, int width = 1>
class Traced {
public:
    using Condition = TracedCondition<width>;

    Traced() = default;
    Traced(double same)
        : id_(Tracing::graph().constant(same, width)) {}  // implicit: constants enter formulas as numbers
    explicit Traced(const std::array<Traced<E, 1>, width>& numbers) requires(width == 2)
        : id_(Tracing::graph().add(program::Op::join, numbers[0].id(), numbers[1].id())) {}
    // The same number, side by side with itself.
    template <int single>
    requires(single == 1 && width == 2) explicit Traced(const Traced<E, single>& same)
        : Traced(std::array{same, same}) {}
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
template <class E, int width>
inline constexpr bool is_traced<Traced<E, width>> = true;

template <class E, int width>
struct Lanes<Traced<E, width>> {
    static constexpr int count = width;
    using Element = Traced<E, 1>;
    static Element get(const Traced<E, width>& number, int i) {
        return Element::of(Tracing::graph().add(program::Op::part, number.id(), i));
    }
    static void set(Traced<E, width>& number, int i, const Element& element) {
        if constexpr (width == 1) {
            number = element;
        } else {
            std::array<Element, width> numbers{get(number, 0), get(number, 1)};
            numbers[static_cast<std::size_t>(i)] = element;
            number = Traced<E, width>(numbers);
        }
    }
};

template <class E, int width>
struct RealOf<Traced<E, width>> {
    using type = E;
};

// The usual way is part of the list, the rare one a region. Regions do not nest: within one the rare way is good for all.
template <int width, class Usual, class Rare>
auto unless(TracedCondition<width> condition, const Usual& usual, const Rare& rare) {
    program::Graph& graph = Tracing::graph();
    if (graph.is_truth(condition.id(), false)) return usual();
    if (graph.is_truth(condition.id(), true) || graph.in_region()) return rare();
    const auto otherwise = usual();
    using Numbers = decltype(otherwise);
    graph.begin_region(condition.id());
    const Numbers found = rare();
    std::remove_const_t<Numbers> out = otherwise;
    std::vector<program::Id> defaults, results;
    std::vector<std::size_t> places;  // of what differs
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (otherwise[i].id() == found[i].id()) continue;
        defaults.push_back(otherwise[i].id()), results.push_back(found[i].id());
        places.push_back(i);
    }
    const std::vector<program::Id> merged = graph.end_region(defaults, results);
    for (std::size_t i = 0; i < places.size(); ++i) out[places[i]] = std::decay_t<decltype(out[0])>::of(merged[i]);
    return out;
}

}  // namespace hamilcar
