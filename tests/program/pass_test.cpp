#include "hamilcar/program/pass.hpp"

#include <gtest/gtest.h>

#include "program/running.hpp"

namespace hamilcar::program {
namespace {

using namespace test;

constexpr Precision precisions[] = {Precision::double_precision, Precision::single_precision};

// Whether two graphs compute the same, in three lanes.
template <class Number>
::testing::AssertionResult same_in(const Graph& graph, const Graph& other, unsigned seed) {
    const Arrays<Number> expected(graph, 3, seed), found(graph, 3, seed);
    PlainEvaluator<Number>(graph, 3, expected.frame()).run();
    PlainEvaluator<Number>(other, 3, found.frame()).run();
    return same_outputs<Number>(graph, 3, found.outputs(), expected.outputs());
}

::testing::AssertionResult same(const Graph& graph, const Graph& other, unsigned seed) {
    return graph.precision() == Precision::double_precision ? same_in<double>(graph, other, seed)
                                                            : same_in<float>(graph, other, seed);
}

bool has_zero_constant(const Graph& graph) {
    return std::ranges::any_of(graph.nodes(), [&](const Node& node) {
        return node.op == Op::constant && std::ranges::count(graph.constants(node), 0.0) > 0;
    });
}

std::size_t count(const Graph& graph, Op op) {
    return static_cast<std::size_t>(std::ranges::count(graph.nodes(), op, &Node::op));
}

TEST(Pass, WithoutDeadCodeKeepsTheBits) {
    for (unsigned seed = 0; seed < 3000; ++seed) {
        const Graph graph =
            random_graph(seed, {.precision = precisions[seed % 2], .size = 20 + static_cast<int>(seed) % 150});
        const Graph live = without_dead_code(graph);
        ASSERT_TRUE(same(graph, live, seed)) << "seed " << seed;
        ASSERT_LE(live.size(), graph.size());
        ASSERT_TRUE(without_dead_code(live) == live) << "twice is more than once, seed " << seed;
    }
}

// Single numbers fold where a wide node could not, and folding a constant zero drops its sign: graphs without such alone keep
// all bits.
TEST(Pass, InSingleNumbersKeepsTheBits) {
    int compared = 0;
    for (unsigned seed = 0; seed < 4000; ++seed) {
        const Graph graph = random_graph(
            seed, {.precision = precisions[seed % 2], .size = 20 + static_cast<int>(seed) % 150, .with_zeros = false});
        const Graph single = in_single_numbers(graph);
        ASSERT_TRUE(std::ranges::all_of(single.nodes(), [](const Node& node) { return node.width == 1; }));
        ASSERT_EQ(count(single, Op::join) + count(single, Op::part), 0U);
        ASSERT_TRUE(in_single_numbers(single) == single) << "twice is more than once, seed " << seed;
        if (has_zero_constant(single)) continue;
        ++compared;
        ASSERT_TRUE(same(graph, single, seed)) << "seed " << seed;
        ASSERT_TRUE(same(graph, without_dead_code(single), seed)) << "seed " << seed;
    }
    EXPECT_GT(compared, 1000);
}

TEST(Pass, InSingleNumbersLeavesSingleNumbersAlone) {
    for (unsigned seed = 0; seed < 500; ++seed) {
        const Graph graph = random_graph(seed, {.precision = precisions[seed % 2], .size = 100, .max_width = 1});
        ASSERT_TRUE(same(graph, in_single_numbers(graph), seed)) << "seed " << seed;
    }
}

TEST(Pass, DeadNodesGo) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    const Id sum = graph.add(Op::add, x, y);
    graph.add(Op::divide, sum, graph.constant(3));
    graph.output(output_array, 1, sum);
    graph.output(output_array, 0, x);
    const Graph live = without_dead_code(graph);
    EXPECT_EQ(live.size(), 3);
    EXPECT_EQ(live.outputs(), graph.outputs()) << "their order stays";
    EXPECT_EQ(without_dead_code(Graph()).size(), 0);
}

// A region with two merged values and a call within.
Graph graph_with_region(int first_merge, int last_merge) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    const std::array defaults{graph.add(Op::negate, x), graph.add(Op::absolute, y)};
    graph.begin_region(graph.add(Op::less, x, y));
    const std::array arguments{graph.add(Op::divide, x, y)};
    const Id called = graph.call(1, 2, arguments, 2);
    const std::array results{graph.add(Op::multiply, x, y), called + 1};
    const std::vector<Id> merged = graph.end_region(defaults, results);
    for (int i = first_merge; i < last_merge; ++i) graph.output(output_array, i, merged[static_cast<std::size_t>(i)]);
    graph.output(output_array, 2, y);
    return graph;
}

TEST(Pass, ARegionThatNothingNeedsGoesAsAWhole) {
    const Graph live = without_dead_code(graph_with_region(0, 0));
    EXPECT_EQ(live.size(), 1);
    EXPECT_TRUE(live.regions().empty() && live.calls().empty());
}

TEST(Pass, OfARegionTheNeededResultsStay) {
    const Graph first = without_dead_code(graph_with_region(0, 1));
    ASSERT_EQ(first.regions().size(), 1U);
    EXPECT_EQ(first.regions()[0].results.size(), 1U);
    EXPECT_EQ(first.regions()[0].defaults.size(), 1U);
    EXPECT_EQ(count(first, Op::absolute), 0U) << "an unused default";
    EXPECT_TRUE(first.calls().empty());
    const Graph second = without_dead_code(graph_with_region(1, 2));
    EXPECT_EQ(count(second, Op::negate) + count(second, Op::multiply), 0U);
    ASSERT_EQ(second.calls().size(), 1U);
    EXPECT_EQ(second.calls()[0].result_count, 2) << "a call stays as a whole";
    EXPECT_EQ(without_dead_code(graph_with_region(0, 2)), graph_with_region(0, 2));
}

TEST(Pass, ARegionWithoutResultsGoesWithItsCalls) {
    Graph graph;
    const Id x = graph.input(0, 0);
    graph.begin_region(graph.add(Op::less, x, graph.constant(2)));
    const std::array arguments{x};
    graph.call(0, 0, arguments, 1);
    graph.end_region({}, {});
    graph.output(output_array, 0, x);
    EXPECT_TRUE(without_dead_code(graph).calls().empty());
    EXPECT_TRUE(in_single_numbers(graph).calls().empty());
}

TEST(Pass, AWideConditionEntersForAnyOfItsNumbers) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    graph.begin_region(graph.add(Op::less, graph.add(Op::join, x, y), graph.constant(0, 2)));
    const std::array defaults{x}, results{graph.add(Op::multiply, x, y)};
    graph.output(output_array, 0, graph.end_region(defaults, results)[0]);
    const Graph single = in_single_numbers(graph);
    ASSERT_EQ(single.regions().size(), 1U);
    EXPECT_EQ(single.node(single.regions()[0].condition).op, Op::either);
    for (unsigned seed = 0; seed < 50; ++seed) EXPECT_TRUE(same(graph, single, seed));
}

TEST(Pass, NodesKeepTheirBlocks) {
    Graph graph;
    const Id x = graph.input(0, 0);
    graph.set_block(Block::momenta);
    const Id wide = graph.add(Op::join, x, graph.add(Op::square_root, x));
    graph.set_block(Block::integration);
    graph.output(output_array, 0, graph.add(Op::part, graph.add(Op::multiply, wide, wide), 1));
    for (const Graph& passed : {without_dead_code(graph), in_single_numbers(graph)}) {
        for (const Node& node : passed.nodes()) {
            if (node.op == Op::square_root) {
                EXPECT_EQ(node.block, Block::momenta);
            }
            if (node.op == Op::multiply) {
                EXPECT_EQ(node.block, Block::integration);
            }
        }
    }
}

}  // namespace
}  // namespace hamilcar::program
