// Graphs of any shape, from a seed: all operations, wide ones, regions, calls, repeated expressions, and much dead code.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>
#include <vector>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program::test {

inline constexpr int input_arrays = 2, inputs_each = 6, output_array = 2;

struct RandomGraphOptions {
    Precision precision = Precision::double_precision;
    int size = 100;  // attempts
    int max_width = 4;
    bool with_calls = true, with_regions = true;
    bool with_zeros = true;  // among the constants
};

class RandomGraph {
public:
    RandomGraph(unsigned seed, const RandomGraphOptions& options)
        : random_(seed), options_(options), graph_(options.precision) {
        output_share_ = below(4) * 20;
        leaves();
    }

    Graph made() && {
        for (int i = 0; i < options_.size; ++i) {
            graph_.set_block(static_cast<Block>(below(4)));
            const int kind = below(100);
            if (kind < 4 && options_.with_regions && !graph_.in_region())
                region();
            else if (kind < 7 && options_.with_calls)
                call();
            else if (kind < 20)
                compare();
            else if (kind < 30)
                combine();
            else if (kind < 38)
                select();
            else if (kind < 48)
                join();
            else if (kind < 58)
                part();
            else if (kind < 64)
                repeat();
            else if (kind < 68)
                constant();
            else
                arithmetic();
        }
        for (int i = 0; i < 6; ++i) output(some(numbers_, width()));
        return std::move(graph_);
    }

private:
    using Pool = std::array<std::vector<Id>, 5>;  // by width

    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }
    int width() {
        const int kind = below(4);
        const int found = kind < 2 ? 1 : kind == 2 ? 2 : 4;
        return found > options_.max_width ? 1 : found;
    }

    // Often a leaf, so that not everything ends in infinities; often a recent one, so that chains come about.
    Id some(const Pool& pool, int width) {
        const std::vector<Id>& all = pool[static_cast<std::size_t>(width)];
        const int size = static_cast<int>(all.size()), kind = below(3);
        if (kind == 0) return all[static_cast<std::size_t>(below(std::min(size, 12)))];
        if (kind == 1) return all[static_cast<std::size_t>(size - 1 - below(std::min(size, 6)))];
        return all[static_cast<std::size_t>(below(size))];
    }

    void keep(Pool& pool, Id id) { pool[graph_.node(id).width].push_back(id); }
    void keep_number(Id id) {
        keep(numbers_, id);
        if (!graph_.in_region() && below(100) < output_share_) output(id);
    }

    // Number by number, of a number that may be read here.
    void output(Id id) {
        for (int i = 0; i < graph_.node(id).width; ++i) {
            graph_.output(output_array, output_places_++, graph_.add(Op::part, id, i));
        }
    }

    void leaves() {
        for (int i = 0; i < input_arrays * inputs_each; ++i) {
            keep(numbers_, graph_.input(i % input_arrays, i / input_arrays));
        }
        for (int width = 2; width <= options_.max_width; width *= 2) {
            for (int i = 0; i < 6; ++i) {
                const Id a = some(numbers_, width / 2), b = some(numbers_, width / 2);
                keep(numbers_, graph_.add(Op::join, a, b));
            }
        }
        for (int width = 1; width <= options_.max_width; width *= 2) {
            keep(conditions_, graph_.add(Op::less, some(numbers_, width), some(numbers_, width)));
        }
        for (int i = 0; i < 4; ++i) constant();
    }

    double number() {
        static constexpr double some[] = {0, -0.0, 1, -1, 2, 0.5, -3, 1e-3, 1e20, -1e-20, 1e300, 5e-324, 0.1};
        const double found = below(3) == 0 ? std::ldexp(static_cast<double>(random_()) - 2e9, below(60) - 60)
                                           : some[below(static_cast<int>(std::size(some)))];
        return found == 0 && !options_.with_zeros ? 7 : found;
    }
    void constant() {
        if (below(10) == 0) return keep(conditions_, graph_.truth(below(2) == 0, width()));
        std::vector<double> values;
        const int wide = width();
        for (int i = 0; i < wide; ++i) values.push_back(i > 0 && below(2) == 0 ? values[0] : number());
        keep_number(graph_.constant(values));
    }

    void arithmetic() {
        static constexpr Op ops[] = {Op::add,      Op::add,      Op::subtract, Op::multiply,
                                     Op::multiply, Op::multiply, Op::divide,   Op::square_root,
                                     Op::negate,   Op::absolute, Op::minimum,  Op::maximum};
        const Op op = ops[below(static_cast<int>(std::size(ops)))];
        const int wide = width();
        const Id a = some(numbers_, wide);
        const Id b = below(12) == 0 ? a : some(numbers_, wide);
        keep_number(operand_count(op) == 1 ? graph_.add(op, a) : graph_.add(op, a, b));
    }
    void compare() {
        static constexpr Op ops[] = {Op::less,     Op::less_equal,     Op::equal,
                                     Op::not_less, Op::not_less_equal, Op::not_equal};
        const int wide = width();
        keep(conditions_, graph_.add(ops[below(6)], some(numbers_, wide), some(numbers_, wide)));
    }
    void combine() {
        const int wide = width(), kind = below(3);
        const Id a = some(conditions_, wide), b = some(conditions_, wide);
        keep(conditions_,
             kind == 0 ? graph_.add(Op::opposite, a) : graph_.add(kind == 1 ? Op::both : Op::either, a, b));
    }
    void select() {
        const int wide = width();
        keep_number(graph_.add(Op::select, some(conditions_, wide), some(numbers_, wide), some(numbers_, wide)));
    }
    void join() {
        if (options_.max_width == 1) return;
        const int half = options_.max_width == 2 ? 1 : 1 + below(2);
        if (below(3) == 0)
            return keep(conditions_, graph_.add(Op::join, some(conditions_, half), some(conditions_, half)));
        keep_number(graph_.add(Op::join, some(numbers_, half), some(numbers_, half)));
    }
    void part() {
        const int wide = width();
        if (below(3) == 0) return keep(conditions_, graph_.add(Op::part, some(conditions_, wide), below(wide)));
        keep_number(graph_.add(Op::part, some(numbers_, wide), below(wide)));
    }
    // The same expression, in other words or in the same.
    void repeat() {
        const Id id = some(numbers_, width());
        const Node node = graph_.node(id);
        if (node.op < Op::add || node.op > Op::maximum) return;
        keep_number(operand_count(node.op) == 1 ? graph_.add(node.op, node.a) : graph_.add(node.op, node.b, node.a));
    }
    // As `test_functions` of running.hpp have it.
    void call() {
        static constexpr int argument_counts[] = {1, 3, 0, 2}, result_counts[] = {1, 2, 1, 3};
        const int function = below(4);
        std::vector<Id> arguments;
        for (int i = 0; i < argument_counts[function]; ++i) arguments.push_back(some(numbers_, 1));
        const Id first = graph_.call(function, below(10), arguments, result_counts[function]);
        for (int i = 0; i < result_counts[function]; ++i) keep_number(first + i);
    }

    void region() {
        const Pool numbers_before = numbers_, conditions_before = conditions_;
        graph_.begin_region(some(conditions_, width()));
        const int size = below(20);
        for (int i = 0; i < size; ++i) {
            const int kind = below(20);
            if (kind == 0)
                constant();
            else if (kind == 1 && options_.with_calls)
                call();
            else if (kind < 4)
                select();
            else if (kind < 7)
                compare();
            else if (kind < 8)
                combine();
            else if (kind < 10)
                join();
            else if (kind < 12)
                part();
            else
                arithmetic();
        }
        std::vector<Id> defaults, results;
        const int count = below(4);
        for (int i = 0; i < count; ++i) {
            const int wide = width();
            results.push_back(some(numbers_, wide));
            defaults.push_back(some(numbers_before, wide));
        }
        numbers_ = numbers_before;
        conditions_ = conditions_before;
        for (const Id merged : graph_.end_region(defaults, results)) keep_number(merged);
    }

    std::mt19937 random_;
    RandomGraphOptions options_;
    Graph graph_;
    Pool numbers_, conditions_;
    int output_share_, output_places_ = 0;
};

inline Graph random_graph(unsigned seed, const RandomGraphOptions& options) {
    return RandomGraph(seed, options).made();
}

}  // namespace hamilcar::program::test
