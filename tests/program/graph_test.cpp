#include "hamilcar/program/graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "program/running.hpp"

namespace hamilcar::program {
namespace {

using namespace test;

// What building gives for an expression of x and y, what it should give, and what the expression is.
struct Folding {
    std::string name;
    Id (*build)(Graph& graph, Id x, Id y);
    Id (*expected)(Graph& graph, Id x, Id y);
    double (*plain)(double x, double y);
    bool times_zero = false;  // an infinity or a NaN times zero is zero
};

const std::vector<Folding>& foldings() {
    using G = Graph;
    static const std::vector<Folding> all{
        {"x + 0", [](G& g, Id x, Id) { return g.add(Op::add, x, g.constant(0)); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return x + 0.0; }},
        {"0 + x", [](G& g, Id x, Id) { return g.add(Op::add, g.constant(0), x); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return 0.0 + x; }},
        {"x + -0", [](G& g, Id x, Id) { return g.add(Op::add, x, g.constant(-0.0)); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return x + -0.0; }},
        {"x - 0", [](G& g, Id x, Id) { return g.add(Op::subtract, x, g.constant(0)); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return x - 0.0; }},
        {"0 - x", [](G& g, Id x, Id) { return g.add(Op::subtract, g.constant(0), x); },
         [](G& g, Id x, Id) { return g.add(Op::negate, x); }, [](double x, double) { return 0.0 - x; }},
        {"x * 1", [](G& g, Id x, Id) { return g.add(Op::multiply, x, g.constant(1)); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return x * 1.0; }},
        {"1 * x", [](G& g, Id x, Id) { return g.add(Op::multiply, g.constant(1), x); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return 1.0 * x; }},
        {"x * -1", [](G& g, Id x, Id) { return g.add(Op::multiply, x, g.constant(-1)); },
         [](G& g, Id x, Id) { return g.add(Op::negate, x); }, [](double x, double) { return x * -1.0; }},
        {"x * 0", [](G& g, Id x, Id) { return g.add(Op::multiply, x, g.constant(0)); },
         [](G& g, Id, Id) { return g.constant(0); }, [](double x, double) { return x * 0.0; }, true},
        {"0 * x", [](G& g, Id x, Id) { return g.add(Op::multiply, g.constant(0), x); },
         [](G& g, Id, Id) { return g.constant(0); }, [](double x, double) { return 0.0 * x; }, true},
        {"x / 1", [](G& g, Id x, Id) { return g.add(Op::divide, x, g.constant(1)); }, [](G&, Id x, Id) { return x; },
         [](double x, double) { return x / 1.0; }},
        {"x + (-y)", [](G& g, Id x, Id y) { return g.add(Op::add, x, g.add(Op::negate, y)); },
         [](G& g, Id x, Id y) { return g.add(Op::subtract, x, y); }, [](double x, double y) { return x + (-y); }},
        {"(-x) + y", [](G& g, Id x, Id y) { return g.add(Op::add, g.add(Op::negate, x), y); },
         [](G& g, Id x, Id y) { return g.add(Op::subtract, y, x); }, [](double x, double y) { return (-x) + y; }},
        {"x - (-y)", [](G& g, Id x, Id y) { return g.add(Op::subtract, x, g.add(Op::negate, y)); },
         [](G& g, Id x, Id y) { return g.add(Op::add, x, y); }, [](double x, double y) { return x - (-y); }},
        {"-(-x)", [](G& g, Id x, Id) { return g.add(Op::negate, g.add(Op::negate, x)); },
         [](G&, Id x, Id) { return x; }, [](double x, double) { return -(-x); }},
        {"||x||", [](G& g, Id x, Id) { return g.add(Op::absolute, g.add(Op::absolute, x)); },
         [](G& g, Id x, Id) { return g.add(Op::absolute, x); },
         [](double x, double) { return std::fabs(std::fabs(x)); }},
        {"|-x|", [](G& g, Id x, Id) { return g.add(Op::absolute, g.add(Op::negate, x)); },
         [](G& g, Id x, Id) { return g.add(Op::absolute, x); }, [](double x, double) { return std::fabs(-x); }},
        {"x < y ? x : x", [](G& g, Id x, Id y) { return g.add(Op::select, g.add(Op::less, x, y), x, x); },
         [](G&, Id x, Id) { return x; }, [](double x, double y) { return x < y ? x : x; }},
        {"true ? x : y", [](G& g, Id x, Id y) { return g.add(Op::select, g.truth(true, 1), x, y); },
         [](G&, Id x, Id) { return x; }, [](double x, double) { return x; }},
        {"false ? x : y", [](G& g, Id x, Id y) { return g.add(Op::select, g.truth(false, 1), x, y); },
         [](G&, Id, Id y) { return y; }, [](double, double y) { return y; }},
    };
    return all;
}

bool same_but_zeros(double a, double b) {
    return (a == 0 && b == 0) || same_bits(a, b);
}

TEST(Graph, FoldsWhatIsExactForAllNumbers) {
    for (const Folding& folding : foldings()) {
        Graph graph;
        const Id x = graph.input(0, 0), y = graph.input(1, 0), found = folding.build(graph, x, y);
        EXPECT_EQ(found, folding.expected(graph, x, y)) << folding.name;
        graph.output(output_array, 0, found);
        for (const double a : special_numbers<double>()) {
            for (const double b : special_numbers<double>()) {
                const Arrays<double> run(graph, 1, 0);
                run.inputs(0)[0] = a;
                if (!run.inputs(1).empty()) run.inputs(1)[0] = b;
                PlainEvaluator<double>(graph, 1, run.frame()).run();
                const double plain = folding.times_zero && !std::isfinite(a) ? 0 : folding.plain(a, b);
                EXPECT_TRUE(same_but_zeros(run.outputs()[0], plain))
                    << folding.name << " for " << a << ", " << b << ": " << run.outputs()[0] << ", not " << plain;
            }
        }
    }
}

TEST(Graph, FoldsWideOperandsAsItFoldsSingleOnes) {
    Graph graph;
    const Id x = graph.add(Op::join, graph.input(0, 0), graph.input(0, 1));
    EXPECT_EQ(graph.add(Op::add, x, graph.constant(0, 2)), x);
    EXPECT_EQ(graph.add(Op::multiply, x, graph.constant(1, 2)), x);
    EXPECT_EQ(graph.node(graph.add(Op::multiply, x, graph.constant(0, 2))).width, 2);
    const std::array mixed{0.0, 1.0};
    EXPECT_NE(graph.add(Op::add, x, graph.constant(mixed)), x);
    EXPECT_NE(graph.add(Op::multiply, x, graph.constant(mixed)), x);
    EXPECT_EQ(graph.add(Op::join, graph.constant(0), graph.constant(1)), graph.constant(mixed));
    EXPECT_EQ(graph.add(Op::part, graph.constant(mixed), 1), graph.constant(1));
    EXPECT_EQ(graph.add(Op::part, x, 1), graph.input(0, 1));
    EXPECT_EQ(graph.add(Op::part, graph.input(0, 0), 0), graph.input(0, 0));
}

template <class Number>
void expect_folds_constants(Precision precision) {
    for (const Number a : special_numbers<Number>()) {
        for (const Number b : special_numbers<Number>()) {
            for (int op = static_cast<int>(Op::add); op <= static_cast<int>(Op::not_equal); ++op) {
                if (static_cast<Op>(op) == Op::truth) continue;
                Graph graph(precision);
                const Id x = graph.constant(a), y = graph.constant(b);
                const Id found = graph.add(static_cast<Op>(op), x, y);
                const bool condition = is_condition(static_cast<Op>(op));
                ASSERT_EQ(graph.node(found).op, condition ? Op::truth : Op::constant) << op << ": " << a << ", " << b;
                // The same by inputs; sqrt and others of one operand leave y aside.
                Graph run_graph(precision);
                const Id run_found = run_graph.add(static_cast<Op>(op), run_graph.input(0, 0), run_graph.input(1, 0));
                run_graph.output(
                    output_array, 0,
                    condition ? run_graph.add(Op::select, run_found, run_graph.constant(1), run_graph.constant(0))
                              : run_found);
                const Arrays<Number> run(run_graph, 1, 0);
                run.inputs(0)[0] = a;
                run.inputs(1)[0] = b;
                PlainEvaluator<Number>(run_graph, 1, run.frame()).run();
                const double folded = condition ? graph.node(found).a : graph.constants(graph.node(found))[0];
                const double plain = run.outputs()[0];
                const bool is_times_zero = static_cast<Op>(op) == Op::multiply && (a == 0 || b == 0);
                EXPECT_TRUE(same_but_zeros(folded, plain) || (is_times_zero && folded == 0))
                    << op << ": " << a << ", " << b << " is " << folded << ", not " << plain;
            }
        }
    }
}

TEST(Graph, ComputesConstantsAsARunDoes) {
    expect_folds_constants<double>(Precision::double_precision);
    expect_folds_constants<float>(Precision::single_precision);
}

TEST(Graph, RoundsConstantsToItsPrecision) {
    Graph graph(Precision::single_precision);
    EXPECT_EQ(graph.constant(0.1), graph.constant(0.1F));
    const Id third = graph.add(Op::divide, graph.constant(1), graph.constant(3));
    EXPECT_EQ(graph.constants(graph.node(third))[0], static_cast<double>(1.0F / 3.0F));
}

TEST(Graph, KnowsConditions) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    const Id less = graph.add(Op::less, x, y), equal = graph.add(Op::equal, x, y);
    const Id yes = graph.truth(true, 1), no = graph.truth(false, 1);
    EXPECT_EQ(graph.add(Op::both, less, yes), less);
    EXPECT_EQ(graph.add(Op::both, no, less), no);
    EXPECT_EQ(graph.add(Op::either, less, yes), yes);
    EXPECT_EQ(graph.add(Op::either, no, less), less);
    EXPECT_EQ(graph.add(Op::either, less, less), less);
    EXPECT_EQ(graph.add(Op::opposite, no), yes);
    for (const Op op : {Op::less, Op::less_equal, Op::equal}) {
        const Id condition = graph.add(op, x, y), opposite = graph.add(Op::opposite, condition);
        EXPECT_NE(graph.node(opposite).op, Op::opposite);
        EXPECT_EQ(graph.add(Op::opposite, opposite), condition);
    }
    const Id any = graph.add(Op::either, less, equal), neither = graph.add(Op::opposite, any);
    EXPECT_EQ(graph.node(neither).op, Op::opposite);
    EXPECT_EQ(graph.add(Op::opposite, neither), any);
    const std::array mixed{0.0, 2.0};
    const Id open = graph.add(Op::less, graph.constant(mixed), graph.constant(1, 2));
    EXPECT_EQ(graph.node(open).op, Op::less) << "a truth is one throughout";
}

TEST(Graph, SharesEqualNodes) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    EXPECT_EQ(graph.input(0, 0), x);
    EXPECT_EQ(graph.add(Op::add, x, y), graph.add(Op::add, y, x));
    EXPECT_EQ(graph.add(Op::multiply, x, y), graph.add(Op::multiply, y, x));
    EXPECT_NE(graph.add(Op::subtract, x, y), graph.add(Op::subtract, y, x));
    EXPECT_NE(graph.add(Op::minimum, x, y), graph.add(Op::minimum, y, x)) << "they differ where they do not compare";
    EXPECT_NE(graph.constant(0.0), graph.constant(-0.0));
    EXPECT_EQ(graph.constant(std::nan("")), graph.constant(std::nan("")));
    EXPECT_NE(graph.constant(2), graph.constant(2, 2));
    const Id before = graph.size();
    const std::array arguments{x};
    EXPECT_NE(graph.call(0, 0, arguments, 1), graph.call(0, 0, arguments, 1));
    EXPECT_EQ(graph.size(), before + 4);
}

TEST(Graph, SharesNothingOutOfARegion) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    const Id sum = graph.add(Op::add, x, y), condition = graph.add(Op::less, x, y);
    graph.begin_region(condition);
    EXPECT_EQ(graph.add(Op::add, x, y), sum) << "what was there before may be read in it";
    const Id inside = graph.add(Op::multiply, x, y);
    EXPECT_EQ(graph.add(Op::multiply, y, x), inside);
    EXPECT_TRUE(graph.node(inside).in_region);
    for (int i = 0; i < 10000; ++i) graph.constant(i + 0.5);  // the table grows meanwhile
    EXPECT_EQ(graph.add(Op::multiply, x, y), inside);
    const std::array defaults{x}, results{inside};
    const Id merged = graph.end_region(defaults, results)[0];
    EXPECT_EQ(graph.node(merged).op, Op::merge);
    EXPECT_EQ(merged, graph.regions()[0].last);
    EXPECT_EQ(graph.add(Op::add, x, y), sum);
    const Id outside = graph.add(Op::multiply, x, y);
    EXPECT_NE(outside, inside);
    EXPECT_FALSE(graph.node(outside).in_region);
}

// No two nodes that may be read at the same point are equal, however often the table grew.
TEST(Graph, SharesAllThatMayBeShared) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Graph graph = random_graph(seed, {.size = 4000, .with_calls = false});
        std::map<std::array<int, 5>, Id> seen;
        for (const Node& node : graph.nodes()) {
            if (node.in_region || node.op == Op::constant || node.op == Op::merge) continue;
            const std::array<int, 5> key{static_cast<int>(node.op), node.width, node.a, node.b, node.c};
            EXPECT_TRUE(seen.emplace(key, 0).second) << "seed " << seed;
        }
    }
}

TEST(Graph, RemembersTheBlockOfANode) {
    Graph graph;
    graph.set_block(Block::momenta);
    const Id x = graph.input(0, 0);
    graph.set_block(Block::velocity);
    EXPECT_EQ(graph.node(graph.input(0, 0)).block, Block::momenta) << "the first one";
    EXPECT_EQ(graph.node(graph.add(Op::negate, x)).block, Block::velocity);
}

TEST(Graph, EqualsOneBuiltTheSameWay) {
    const RandomGraphOptions options{.size = 200};
    EXPECT_EQ(random_graph(1, options), random_graph(1, options));
    EXPECT_FALSE(random_graph(1, options) == random_graph(2, options));
}

}  // namespace
}  // namespace hamilcar::program
