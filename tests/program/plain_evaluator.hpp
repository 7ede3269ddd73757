// Evaluates a graph in the plainest way, by the comments of graph.hpp, one number at a time.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "hamilcar/program/executable.hpp"

namespace hamilcar::program::test {

template <class Number>
class PlainEvaluator {
public:
    PlainEvaluator(const Graph& graph, int lanes, const Frame& frame)
        : graph_(graph),
          lanes_(static_cast<std::size_t>(lanes)),
          frame_(frame),
          values_(graph.nodes().size(), std::vector<std::array<Value, 4>>(lanes_)) {}

    void run() {
        for (Id id = 0; id < graph_.size(); ++id) {
            if (!is_skipped(id)) evaluate(id);
        }
        for (const Output& output : graph_.outputs()) {
            for (std::size_t lane = 0; lane < lanes_; ++lane) {
                array(output.array)[at(output.index) * lanes_ + lane] = of(output.node)[lane][0].number;
            }
        }
    }

private:
    struct Value {
        Number number = 0;
        bool truth = false;
    };

    static std::size_t at(Id id) { return static_cast<std::size_t>(id); }
    std::vector<std::array<Value, 4>>& of(Id id) { return values_[at(id)]; }
    Number* array(int which) const { return static_cast<Number*>(frame_.arrays[which]); }

    bool is_entered(const Region& region) {
        for (const std::array<Value, 4>& lane : of(region.condition)) {
            for (int i = 0; i < graph_.node(region.condition).width; ++i) {
                if (lane[at(i)].truth) return true;
            }
        }
        return false;
    }

    bool is_skipped(Id id) {
        for (const Region& region : graph_.regions()) {
            if (region.first <= id && id < region.last) return !is_entered(region);
        }
        return false;
    }

    void evaluate(Id id) {
        const Node& node = graph_.node(id);
        if (node.op == Op::call) return call(id);
        if (node.op == Op::merge) {
            const Region& region = graph_.regions()[at(node.a)];
            of(id) = of((is_entered(region) ? region.results : region.defaults)[at(node.b)]);
            return;
        }
        if (node.op == Op::result) return;  // set by its call
        for (std::size_t lane = 0; lane < lanes_; ++lane) {
            for (int i = 0; i < node.width; ++i) of(id)[lane][at(i)] = value(node, lane, i);
        }
    }

    Value value(const Node& node, std::size_t lane, int i) {
        const auto number = [&](Id id) { return of(id)[lane][at(i)].number; };
        const auto truth = [&](Id id) { return of(id)[lane][at(i)].truth; };
        switch (node.op) {
            case Op::constant: return {.number = static_cast<Number>(graph_.constants(node)[at(i)])};
            case Op::input: return {.number = array(node.a)[at(node.b) * lanes_ + lane]};
            case Op::truth: return {.truth = node.a == 1};
            case Op::add: return {.number = number(node.a) + number(node.b)};
            case Op::subtract: return {.number = number(node.a) - number(node.b)};
            case Op::multiply: return {.number = number(node.a) * number(node.b)};
            case Op::divide: return {.number = number(node.a) / number(node.b)};
            case Op::square_root: return {.number = std::sqrt(number(node.a))};
            case Op::negate: return {.number = -number(node.a)};
            case Op::absolute: return {.number = std::abs(number(node.a))};
            case Op::minimum:
                if (number(node.a) < number(node.b)) return {.number = number(node.a)};
                return {.number = number(node.b)};
            case Op::maximum:
                if (number(node.b) < number(node.a)) return {.number = number(node.a)};
                return {.number = number(node.b)};
            case Op::less: return {.truth = number(node.a) < number(node.b)};
            case Op::less_equal: return {.truth = number(node.a) <= number(node.b)};
            case Op::equal: return {.truth = number(node.a) == number(node.b)};
            case Op::not_less: return {.truth = !(number(node.a) < number(node.b))};
            case Op::not_less_equal: return {.truth = !(number(node.a) <= number(node.b))};
            case Op::not_equal: return {.truth = !(number(node.a) == number(node.b))};
            case Op::both: return {.truth = truth(node.a) && truth(node.b)};
            case Op::either: return {.truth = truth(node.a) || truth(node.b)};
            case Op::opposite: return {.truth = !truth(node.a)};
            case Op::select: return of(truth(node.a) ? node.b : node.c)[lane][at(i)];
            case Op::join: {
                const int half = node.width / 2;
                return i < half ? of(node.a)[lane][at(i)] : of(node.b)[lane][at(i - half)];
            }
            case Op::part: return of(node.a)[lane][at(node.b)];
            default: return {};
        }
    }

    void call(Id id) {
        const Call& call = graph_.calls()[at(graph_.node(id).a)];
        std::vector<Number> arguments(call.arguments.size() * lanes_), results(at(call.result_count) * lanes_);
        for (std::size_t i = 0; i < call.arguments.size(); ++i) {
            for (std::size_t lane = 0; lane < lanes_; ++lane) {
                arguments[i * lanes_ + lane] = of(call.arguments[i])[lane][0].number;
            }
        }
        frame_.functions[call.function](frame_.context, call.detail, static_cast<int>(lanes_), arguments.data(),
                                        results.data());
        for (int i = 0; i < call.result_count; ++i) {
            for (std::size_t lane = 0; lane < lanes_; ++lane) {
                of(id + 1 + i)[lane][0].number = results[at(i) * lanes_ + lane];
            }
        }
    }

    const Graph& graph_;
    std::size_t lanes_;
    const Frame& frame_;
    std::vector<std::vector<std::array<Value, 4>>> values_;  // of each node, in each lane
};

}  // namespace hamilcar::program::test
