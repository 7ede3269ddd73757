#include "hamilcar/program/derivative.hpp"

#include <cmath>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/program/pass.hpp"

namespace hamilcar::program {

namespace {

std::size_t at(Id id) {
    return static_cast<std::size_t>(id);
}

// Sums and products in which `none` is a zero.
class Terms {
public:
    explicit Terms(Graph& graph) : graph_(graph) {}

    Id zero() const { return graph_.constant(0); }
    Id number(Id id) const { return id == none ? zero() : id; }
    Id negated(Id x) const { return x == none ? none : graph_.add(Op::negate, x); }
    Id sum(Id x, Id y) const {
        if (x == none) return y;
        return y == none ? x : graph_.add(Op::add, x, y);
    }
    Id product(Id x, Id y) const { return x == none || y == none ? none : graph_.add(Op::multiply, x, y); }
    Id quotient(Id x, Id y) const { return x == none ? none : graph_.add(Op::divide, x, y); }
    Id chosen(Id condition, Id x, Id y) const {
        return x == none && y == none ? none : graph_.add(Op::select, condition, number(x), number(y));
    }
    // d sqrt(x) / dx of a root, by its reciprocal, which is there already where the graph divides by the root.
    Id slope_of_root(Id root) const {
        const Id positive = graph_.add(Op::less, zero(), root);
        const Id reciprocal = graph_.add(Op::divide, graph_.constant(1), root);
        return graph_.add(Op::select, positive, graph_.add(Op::multiply, graph_.constant(0.5), reciprocal), zero());
    }
    bool is_one(Id id) const { return graph_.node(id).op == Op::constant && graph_.constants(graph_.node(id))[0] == 1; }
    // Whether an operation on numbers takes its first operand.
    Id takes_first(Op op, Id a, Id b) const {
        if (op == Op::absolute) return graph_.add(Op::not_less, a, zero());
        return op == Op::minimum ? graph_.add(Op::less, a, b) : graph_.add(Op::less, b, a);
    }

private:
    Graph& graph_;
};

// A sum with so large a constant has no digits left behind the point: it is the way to round here, and a staircase has slope zero.
bool rounds(const Graph& graph, const Node& node) {
    const double smallest = graph.precision() == Precision::single_precision ? 0x1p23 : 0x1p52;
    for (const Id operand : {node.a, node.b}) {
        if (graph.node(operand).op != Op::constant) continue;
        if (std::abs(graph.constants(graph.node(operand))[0]) >= smallest) return true;
    }
    return false;
}

// Rebuilds a graph node by node, regions entered throughout.
class Differentiation {
public:
    Differentiation(const Graph& from, const DerivativeOptions& options)
        : from_(from), options_(options), to_(from.precision()), terms_(to_), values_(at(from.size()), none) {}

protected:
    Id value(Id id) const { return values_[at(id)]; }
    DerivativePlace place(int array) const { return options_.places[at(array)]; }

    void copy(Id id) {
        const Node& node = from_.node(id);
        HAMILCAR_ASSERT(node.width == 1);
        to_.set_block(node.block);
        values_[at(id)] = copied(node);
    }
    std::vector<Id> arguments(const Call& call) const {
        std::vector<Id> out;
        for (const Id argument : call.arguments) out.push_back(value(argument));
        return out;
    }

    const Graph& from_;
    const DerivativeOptions& options_;
    Graph to_;
    Terms terms_;
    std::vector<Id> values_;  // of each old node; of a call, its first result

private:
    Id copied(const Node& node) {
        switch (node.op) {
            case Op::constant: return to_.constant(from_.constants(node));
            case Op::input: return to_.input(node.a, node.b);
            case Op::truth: return to_.truth(node.a != 0, 1);
            case Op::call: {
                const Call& call = from_.calls()[at(node.a)];
                return to_.call(call.function, call.detail, arguments(call), call.result_count);
            }
            case Op::result: return value(node.a) + node.b;
            case Op::merge: return value(from_.regions()[at(node.a)].results[at(node.b)]);
            default: break;
        }
        const int count = operand_count(node.op);
        return to_.add(node.op, value(node.a), count > 1 ? value(node.b) : none, count > 2 ? value(node.c) : none);
    }
};

class Tangents : Differentiation {
public:
    using Differentiation::Differentiation;

    Graph result() && {
        tangents_.resize(at(from_.size()), none);
        for (Id id = 0; id < from_.size(); ++id) {
            copy(id);
            tangents_[at(id)] = tangent(id);
        }
        for (const Output& output : from_.outputs()) {
            to_.output(output.array, output.index, value(output.node));
            const DerivativePlace to = place(output.array);
            if (to.array != none) to_.output(to.array, to.first + output.index, terms_.number(of(output.node)));
        }
        return std::move(to_);
    }

private:
    Id of(Id id) const { return tangents_[at(id)]; }

    Id tangent(Id id) {
        const Node& node = from_.node(id);
        switch (node.op) {
            case Op::input: {
                const DerivativePlace from = place(node.a);
                return from.array == none ? none : to_.input(from.array, from.first + node.b);
            }
            case Op::add: return rounds(from_, node) ? none : terms_.sum(of(node.a), of(node.b));
            case Op::subtract: return rounds(from_, node) ? none : terms_.sum(of(node.a), terms_.negated(of(node.b)));
            case Op::multiply:
                return terms_.sum(terms_.product(of(node.a), value(node.b)), terms_.product(value(node.a), of(node.b)));
            case Op::divide: {
                const Id numerator = terms_.sum(of(node.a), terms_.negated(terms_.product(value(id), of(node.b))));
                return terms_.is_one(value(node.a)) ? terms_.product(numerator, value(id))
                                                    : terms_.quotient(numerator, value(node.b));
            }
            case Op::square_root:
                return of(node.a) == none ? none : terms_.product(of(node.a), terms_.slope_of_root(value(id)));
            case Op::negate: return terms_.negated(of(node.a));
            case Op::absolute:
                return terms_.chosen(terms_.takes_first(node.op, value(node.a), none), of(node.a),
                                     terms_.negated(of(node.a)));
            case Op::minimum:
            case Op::maximum:
                return terms_.chosen(terms_.takes_first(node.op, value(node.a), value(node.b)), of(node.a), of(node.b));
            case Op::select: return terms_.chosen(value(node.a), of(node.b), of(node.c));
            case Op::call: return call(from_.calls()[at(node.a)]);
            case Op::result: return of(node.a) == none ? none : of(node.a) + node.b;
            case Op::merge: return of(from_.regions()[at(node.a)].results[at(node.b)]);
            default: return none;
        }
    }

    // The first tangent of its results.
    Id call(const Call& call) {
        std::vector<Id> all = arguments(call);
        bool constant = true;
        for (const Id argument : call.arguments) {
            constant = constant && of(argument) == none;
            all.push_back(terms_.number(of(argument)));
        }
        return constant ? none : to_.call(call.function + options_.call_offset, call.detail, all, call.result_count);
    }

    std::vector<Id> tangents_;
};

class Adjoints : Differentiation {
public:
    using Differentiation::Differentiation;

    Graph result() && {
        adjoints_.resize(at(from_.size()), none);
        for (Id id = 0; id < from_.size(); ++id) copy(id);
        for (const Output& output : from_.outputs()) {
            const DerivativePlace from = place(output.array);
            if (from.array != none) include(output.node, to_.input(from.array, from.first + output.index));
        }
        for (Id id = from_.size() - 1; id >= 0; --id) {
            to_.set_block(from_.node(id).block);
            if (of(id) != none || from_.node(id).op == Op::call) pass_on(id);
        }
        return std::move(to_);
    }

private:
    Id of(Id id) const { return adjoints_[at(id)]; }
    void include(Id id, Id term) { adjoints_[at(id)] = terms_.sum(of(id), term); }

    void pass_on(Id id) {
        const Node& node = from_.node(id);
        switch (node.op) {
            case Op::input: return write(node, of(id));
            case Op::add:
            case Op::subtract:
                if (rounds(from_, node)) return;
                include(node.a, of(id));
                return include(node.b, node.op == Op::add ? of(id) : terms_.negated(of(id)));
            case Op::multiply:
                include(node.a, terms_.product(of(id), value(node.b)));
                return include(node.b, terms_.product(of(id), value(node.a)));
            case Op::divide: {
                // Of a reciprocal r = 1 / b: -r r f^; no further division.
                const Id share = terms_.is_one(value(node.a)) ? terms_.product(of(id), value(id))
                                                              : terms_.quotient(of(id), value(node.b));
                include(node.a, share);
                return include(node.b, terms_.negated(terms_.product(share, value(id))));
            }
            case Op::square_root: return include(node.a, terms_.product(of(id), terms_.slope_of_root(value(id))));
            case Op::negate: return include(node.a, terms_.negated(of(id)));
            case Op::absolute: {
                const Id same = terms_.takes_first(node.op, value(node.a), none);
                return include(node.a, terms_.chosen(same, of(id), terms_.negated(of(id))));
            }
            case Op::minimum:
            case Op::maximum:
                return divide(terms_.takes_first(node.op, value(node.a), value(node.b)), id, node.a, node.b);
            case Op::select: return divide(value(node.a), id, node.b, node.c);
            case Op::call: return call(id, from_.calls()[at(node.a)]);
            case Op::merge: return include(from_.regions()[at(node.a)].results[at(node.b)], of(id));
            default: return;
        }
    }
    // To the one that is taken.
    void divide(Id condition, Id id, Id taken, Id other) {
        include(taken, terms_.chosen(condition, of(id), none));
        include(other, terms_.chosen(condition, none, of(id)));
    }

    void write(const Node& input, Id adjoint) {
        const DerivativePlace to = place(input.a);
        if (to.array != none) to_.output(to.array, to.first + input.b, adjoint);
    }
    void call(Id id, const Call& call) {
        std::vector<Id> all = arguments(call);
        bool needed = false;
        for (Id result = id + 1; result <= id + call.result_count; ++result) {
            needed = needed || of(result) != none;
            all.push_back(terms_.number(of(result)));
        }
        if (!needed) return;
        const auto count = static_cast<int>(call.arguments.size());
        Id adjoint = to_.call(call.function + options_.call_offset, call.detail, all, count);
        for (const Id argument : call.arguments) include(argument, adjoint++);
    }

    std::vector<Id> adjoints_;
};

}  // namespace

Graph with_tangents(const Graph& graph, const DerivativeOptions& options) {
    return without_dead_code(Tangents(in_single_numbers(graph), options).result());
}

Graph adjoint(const Graph& graph, const DerivativeOptions& options) {
    return without_dead_code(Adjoints(in_single_numbers(graph), options).result());
}

}  // namespace hamilcar::program
