#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <thread>

#include "hamilcar/program/pass.hpp"
#include "program/running.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar::program {
namespace {

using namespace test;

constexpr Precision precisions[] = {Precision::double_precision, Precision::single_precision};

struct Machine {
    const Backend* backend;
    Precision precision;
    bool car_in_each_lane;

    int max_width() const {
        if (car_in_each_lane) return 1;
        return std::clamp(backend->lanes(precision), 1, 4);
    }
    std::unique_ptr<Executable> compile(const Graph& graph) const { return backend->compile(graph, car_in_each_lane); }
};

std::vector<Machine> machines() {
    std::vector<Machine> all;
    for (const Backend& backend : backends()) {
        if (!backend.is_available()) continue;
        for (const Precision precision : precisions) {
            for (const bool lanes : {false, true}) all.push_back({&backend, precision, lanes});
        }
    }
    return all;
}

std::ostream& operator<<(std::ostream& out, const Machine& machine) {
    return out << machine.backend->name << (machine.precision == Precision::double_precision ? "_double" : "_single")
               << (machine.car_in_each_lane ? "_car_in_each_lane" : "_one_car");
}

class BackendOn : public ::testing::TestWithParam<Machine> {
protected:
    const Machine& machine() const { return GetParam(); }
    Graph random(unsigned seed, int size) const {
        Graph graph =
            random_graph(seed, {.precision = machine().precision, .size = size, .max_width = machine().max_width()});
        return seed % 2 == 0 ? without_dead_code(graph) : graph;
    }
};

INSTANTIATE_TEST_SUITE_P(Backend, BackendOn, ::testing::ValuesIn(machines()), ::testing::PrintToStringParamName());

TEST_P(BackendOn, HasTheStatedNumberOfLanes) {
    Graph graph(machine().precision);
    graph.output(output_array, 0, graph.input(0, 0));
    const auto executable = machine().compile(graph);
    EXPECT_EQ(executable->lanes(), machine().car_in_each_lane ? machine().backend->lanes(machine().precision) : 1);
    EXPECT_EQ(executable->precision(), machine().precision);
    EXPECT_TRUE(computes(*executable, graph, 1));
}

TEST_P(BackendOn, ComputesRandomGraphsBitForBit) {
    for (unsigned seed = 0; seed < 700; ++seed) {
        const Graph graph = random(seed, 20 + static_cast<int>(seed) % 8 * 40);
        const auto executable = machine().compile(graph);
        for (unsigned run = 0; run < 2; ++run) ASSERT_TRUE(computes(*executable, graph, seed + run)) << "seed " << seed;
    }
}

// The results of every operation on a and b, whichever of them are constants.
void all_operations(Graph& graph, Id a, Id b) {
    int index = static_cast<int>(graph.outputs().size());
    const auto output = [&](Id id) {
        for (int i = 0; i < graph.node(id).width; ++i) graph.output(output_array, index++, graph.add(Op::part, id, i));
    };
    const Id one = graph.constant(1, graph.node(a).width), two = graph.constant(2, graph.node(a).width);
    for (const Op op : {Op::add, Op::subtract, Op::multiply, Op::divide, Op::minimum, Op::maximum}) {
        output(graph.add(op, a, b));
        output(graph.add(op, a, a));
    }
    for (const Op op : {Op::square_root, Op::negate, Op::absolute}) output(graph.add(op, a));
    const Id a_positive = graph.add(Op::less, graph.constant(0, graph.node(a).width), a);
    for (const Op op : {Op::less, Op::less_equal, Op::equal, Op::not_less, Op::not_less_equal, Op::not_equal}) {
        const Id condition = graph.add(op, a, b);
        output(graph.add(Op::select, condition, a, b));
        output(graph.add(Op::select, condition, one, two));
        for (const Op with : {Op::both, Op::either}) {
            output(graph.add(Op::select, graph.add(with, condition, a_positive), two, b));
            output(graph.add(Op::select, graph.add(Op::opposite, graph.add(with, condition, a_positive)), a, one));
        }
    }
}

template <class Number>
void fill_with_pairs(const Arrays<Number>& run, std::size_t first) {
    const std::vector<Number>& special = special_numbers<Number>();
    const std::size_t size = special.size();
    for (std::size_t i = 0; i < run.inputs(0).size(); ++i) {
        run.inputs(0)[i] = special[(first + i) % size];
        run.inputs(1)[i] = special[(first + i) / size % size];
    }
}

template <class Number>
void check_pairs(const Machine& machine) {
    const std::size_t size = special_numbers<Number>().size();
    for (int width = 1; width <= machine.max_width(); width *= 2) {
        Graph graph(machine.precision);
        std::array<Id, 2> wide{};
        for (int which = 0; which < 2; ++which) {
            std::vector<Id> parts;
            for (int i = 0; i < width; ++i) parts.push_back(graph.input(which, i));
            while (parts.size() > 1) {
                for (std::size_t i = 0; i < parts.size() / 2; ++i) {
                    parts[i] = graph.add(Op::join, parts[2 * i], parts[2 * i + 1]);
                }
                parts.resize(parts.size() / 2);
            }
            wide[static_cast<std::size_t>(which)] = parts[0];
        }
        all_operations(graph, wide[0], wide[1]);
        const auto executable = machine.compile(graph);
        const int lanes = executable->lanes();
        for (std::size_t first = 0; first < size * size; first += static_cast<std::size_t>(lanes * width)) {
            const Arrays<Number> found(graph, lanes, 0), expected(graph, lanes, 0);
            fill_with_pairs(found, first);
            fill_with_pairs(expected, first);
            executable->run(found.frame());
            PlainEvaluator<Number>(graph, lanes, expected.frame()).run();
            ASSERT_TRUE(same_outputs<Number>(graph, lanes, found.outputs(), expected.outputs()))
                << "pairs from " << first;
        }
    }
}

TEST_P(BackendOn, ComputesEveryOperationOnEveryPairOfSpecialNumbers) {
    machine().precision == Precision::double_precision ? check_pairs<double>(machine()) : check_pairs<float>(machine());
}

TEST_P(BackendOn, ComputesEveryOperationWithAConstantOnEitherSide) {
    for (const double special : special_numbers<double>()) {
        Graph graph(machine().precision);
        const Id constant = graph.constant(special);
        for (int i = 0; i < 4; ++i) {
            all_operations(graph, graph.input(0, i), constant);
            all_operations(graph, constant, graph.input(1, i));
        }
        const auto executable = machine().compile(graph);
        for (unsigned run = 0; run < 4; ++run) ASSERT_TRUE(computes(*executable, graph, run)) << special;
    }
}

// So many numbers are computed before the first of them is needed.
Graph graph_with_alive(Precision precision, int count) {
    Graph graph(precision);
    std::vector<Id> alive;
    for (int i = 0; i < count; ++i) {
        const Id product = graph.add(Op::multiply, graph.input(0, i % 6), graph.constant(i));
        alive.push_back(graph.add(Op::add, product, graph.input(1, i % 5)));
    }
    Id sum = alive[0];
    for (const int stride : {1, 7}) {  // first to last, and last to first in another order
        for (int i = 0; i < count; ++i) {
            const auto which = static_cast<std::size_t>(stride == 1 ? i : (count - 1 - i) * stride % count);
            sum = graph.add(Op::subtract, graph.add(Op::multiply, sum, graph.constant(0.5)), alive[which]);
            if (i % 5 == 0) graph.output(output_array, static_cast<int>(graph.outputs().size()), sum);
        }
    }
    return graph;
}

TEST_P(BackendOn, KeepsMoreNumbersAliveThanThereAreRegisters) {
    for (const int count : {10, 40, 100, 5000}) {
        const Graph graph = graph_with_alive(machine().precision, count);
        const auto executable = machine().compile(graph);
        for (unsigned run = 0; run < 4; ++run) ASSERT_TRUE(computes(*executable, graph, run)) << count;
    }
}

TEST_P(BackendOn, KeepsMoreConditionsAliveThanThereAreMasks) {
    for (int width = 1; width <= machine().max_width(); width *= 2) {
        Graph graph(machine().precision);
        const auto input = [&](int array, int i) {
            const Id first = graph.input(array, i % 6);
            if (width == 1) return first;
            const Id pair = graph.add(Op::join, first, graph.input(array, (i + 1) % 6));
            return width == 2 ? pair
                              : graph.add(Op::join, pair, graph.add(Op::join, graph.input(array, (i + 2) % 6), first));
        };
        std::vector<Id> alive;
        for (int i = 0; i < 30; ++i) {
            alive.push_back(
                graph.add(Op::less, input(0, i), graph.add(Op::multiply, input(1, i), graph.constant(i, width))));
        }
        Id value = input(0, 0), condition = alive[0];
        for (const int stride : {1, 7}) {
            for (int i = 0; i < 30; ++i) {
                const Id one = alive[static_cast<std::size_t>(stride == 1 ? i : (29 - i) * stride % 30)];
                condition = graph.add(Op::opposite, graph.add(i % 2 == 0 ? Op::both : Op::either, condition, one));
                value = graph.add(Op::select, one, graph.add(Op::add, value, input(1, i)), value);
                value = graph.add(Op::select, condition, value, graph.add(Op::multiply, value, input(0, i)));
            }
        }
        for (int i = 0; i < width; ++i) graph.output(output_array, i, graph.add(Op::part, value, i));
        const auto executable = machine().compile(graph);
        for (unsigned run = 0; run < 20; ++run) ASSERT_TRUE(computes(*executable, graph, run)) << width;
    }
}

// A condition that holds in one lane alone enters a region for all lanes; in none, for none.
TEST_P(BackendOn, EntersARegionIfItsConditionHoldsInAnyLane) {
    Graph graph(machine().precision);
    const Id x = graph.input(0, 0);
    graph.begin_region(graph.add(Op::less, graph.input(1, 0), graph.constant(0)));
    const std::array results{graph.add(Op::multiply, x, x)}, defaults{x};
    graph.output(output_array, 0, graph.end_region(defaults, results)[0]);
    const auto executable = machine().compile(graph);
    const auto check = [&]<class Number>(Number) {
        const int lanes = executable->lanes();
        for (int which = -1; which < lanes; ++which) {
            const Arrays<Number> run(graph, lanes, 0);
            std::ranges::fill(run.inputs(0), Number(3));
            std::ranges::fill(run.inputs(1), std::numeric_limits<Number>::quiet_NaN());
            if (which >= 0) run.inputs(1)[static_cast<std::size_t>(which)] = -1;
            executable->run(run.frame());
            EXPECT_THAT(run.outputs(), ::testing::Each(which < 0 ? 3 : 9)) << "lane " << which;
        }
    };
    machine().precision == Precision::double_precision ? check(1.0) : check(1.0F);
}

TEST_P(BackendOn, ComputesAProgramOfAHundredThousandOperations) {
    const Graph graph = random_graph(
        5,
        {.precision = machine().precision, .size = 170000, .max_width = machine().max_width(), .with_regions = false});
    EXPECT_GT(graph.size(), 100000);
    const auto executable = machine().compile(graph);
    EXPECT_TRUE(computes(*executable, graph, 3));
    EXPECT_TRUE(computes(*executable, graph, 4));
}

TEST_P(BackendOn, RunsWithoutAllocation) {
    for (const Graph& graph : {random(8, 300), graph_with_alive(machine().precision, 5000)}) {
        const auto executable = machine().compile(graph);
        const auto check = [&]<class Number>(Number) {
            const Arrays<Number> run(graph, executable->lanes(), 1);
            const hamilcar::test::AllocationGuard guard;
            executable->run(run.frame());
            EXPECT_EQ(guard.allocations(), 0);
        };
        machine().precision == Precision::double_precision ? check(1.0) : check(1.0F);
    }
}

TEST_P(BackendOn, RunsAndCompilesOnTwoThreadsAtOnce) {
    const Graph shared_graph = random(31, 300), large_graph = graph_with_alive(machine().precision, 3000);
    const auto shared = machine().compile(shared_graph), large = machine().compile(large_graph);
    std::array<int, 2> wrong{};
    const auto work = [&](unsigned which) {
        for (unsigned i = 0; i < 40; ++i) {
            const Graph graph = random(1000 + 2 * i + which, 100);
            wrong[which] += !computes(*machine().compile(graph), graph, i);
            wrong[which] += !computes(*shared, shared_graph, i + which);
            if (i % 20 == 0) wrong[which] += !computes(*large, large_graph, i + which);
        }
    };
    std::thread one(work, 0), other(work, 1);
    one.join();
    other.join();
    EXPECT_EQ(wrong[0] + wrong[1], 0);
}

// The tests above rely on this: an operation that random graphs rarely contain would hardly be tested.
TEST(Backend, RandomGraphsHaveAllOperations) {
    std::map<Op, int> counts;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Graph graph = random_graph(seed, {.size = 100});
        for (const Node& node : graph.nodes()) ++counts[node.op];
    }
    for (int op = 0; op <= static_cast<int>(Op::merge); ++op)
        EXPECT_GT(counts[static_cast<Op>(op)], 100) << "operation " << op;
}

TEST(Backend, TheLastIsPortable) {
    EXPECT_EQ(backends().back().name, "portable");
    EXPECT_TRUE(backends().back().is_available());
}

}  // namespace
}  // namespace hamilcar::program
