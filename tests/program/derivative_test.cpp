// Derivatives of graphs: against differences of what the graphs compute, tangents against adjoints, and what has none.
#include "hamilcar/program/derivative.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/program/pass.hpp"
#include "program/running.hpp"

namespace hamilcar::program::test {
namespace {

// Array 0 is read, array 1 written; tangents lie behind the numbers, or adjoints in arrays 2 (of what was read) and 1.
DerivativeOptions behind(int inputs, int outputs) {
    DerivativeOptions options{.call_offset = 1};
    options.places[0] = {0, inputs};
    options.places[1] = {1, outputs};
    return options;
}
DerivativeOptions backwards() {
    DerivativeOptions options{.call_offset = 2};
    options.places[0] = {2, 0};
    options.places[1] = {1, 0};
    return options;
}

// x -> x^2 + detail, by a call; its tangent and its adjoint.
void square(const void*, int detail, int lanes, const void* arguments, void* results) {
    const auto* x = static_cast<const double*>(arguments);
    for (int i = 0; i < lanes; ++i) static_cast<double*>(results)[i] = x[i] * x[i] + detail;
}
void square_derivative(const void*, int, int lanes, const void* arguments, void* results) {
    const auto* x = static_cast<const double*>(arguments);
    for (int i = 0; i < lanes; ++i) static_cast<double*>(results)[i] = 2 * x[i] * x[lanes + i];
}
constexpr CallFunction functions[] = {square, square_derivative, square_derivative};

// One number after the other in every array, in one lane.
std::vector<double> run(const Graph& graph, std::vector<double> in, std::size_t outputs,
                        std::vector<double> results = {}) {
    std::vector<double> read_adjoint(in.size());
    results.resize(outputs);
    Frame frame{.functions = functions};
    frame.arrays[0] = in.data(), frame.arrays[1] = results.data(), frame.arrays[2] = read_adjoint.data();
    backends().back().compile(graph, false)->run(frame);
    return graph.outputs().empty() || graph.outputs()[0].array == 2 ? read_adjoint : results;
}

struct Operation {
    const char* name;
    Graph (*graph)();  // of inputs 0 and 1 and output 0
};

template <class Build>
Graph of_two(const Build& build) {
    Graph graph;
    const Id x = graph.input(0, 0), y = graph.input(0, 1);
    graph.output(1, 0, build(graph, x, y));
    return graph;
}

const Operation operations[] = {
    {"sum", [] { return of_two([](Graph& g, Id x, Id y) { return g.add(Op::add, g.add(Op::multiply, x, x), y); }); }},
    {"difference",
     [] { return of_two([](Graph& g, Id x, Id y) { return g.add(Op::subtract, x, g.add(Op::multiply, y, y)); }); }},
    {"product", [] { return of_two([](Graph& g, Id x, Id y) { return g.add(Op::multiply, x, y); }); }},
    {"quotient", [] { return of_two([](Graph& g, Id x, Id y) { return g.add(Op::divide, x, y); }); }},
    {"reciprocal",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             return g.add(Op::multiply, y, g.add(Op::divide, g.constant(1), g.add(Op::add, x, y)));
         });
     }},
    {"root",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             return g.add(Op::square_root, g.add(Op::add, g.add(Op::multiply, x, x), g.add(Op::multiply, y, y)));
         });
     }},
    {"magnitude and sign",
     [] {
         return of_two(
             [](Graph& g, Id x, Id y) { return g.add(Op::multiply, g.add(Op::absolute, x), g.add(Op::negate, y)); });
     }},
    {"extremes",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             const Id product = g.add(Op::multiply, x, y);
             return g.add(Op::multiply, g.add(Op::minimum, product, y), g.add(Op::maximum, x, y));
         });
     }},
    {"selection",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             return g.add(Op::select, g.add(Op::less, x, y), g.add(Op::multiply, x, y), g.add(Op::divide, x, y));
         });
     }},
    {"region",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             const Id condition = g.add(Op::less, x, g.constant(0.5));
             const Id otherwise = g.add(Op::multiply, x, y);
             g.begin_region(condition);
             const Id inside = g.add(Op::select, condition, g.add(Op::divide, y, x), otherwise);
             return g.end_region(std::array{otherwise}, std::array{inside})[0];
         });
     }},
    {"call",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             const Id argument = g.add(Op::multiply, x, y);
             return g.add(Op::multiply, g.call(0, 3, std::array{argument}, 1), y);
         });
     }},
    {"numbers side by side",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             const Id both = g.add(Op::join, x, y), swapped = g.add(Op::join, y, x);
             const Id product = g.add(Op::multiply, both, g.add(Op::add, both, swapped));
             return g.add(Op::multiply, g.add(Op::part, product, 0), g.add(Op::part, product, 1));
         });
     }},
    {"rounding",
     [] {
         return of_two([](Graph& g, Id x, Id y) {
             const Id big = g.constant(6755399441055744.0);
             const Id whole = g.add(Op::subtract, g.add(Op::add, g.add(Op::multiply, x, g.constant(7)), big), big);
             return g.add(Op::multiply, g.add(Op::add, whole, x), y);
         });
     }},
};

class Derivative : public testing::TestWithParam<Operation> {
protected:
    double value(double x, double y) const { return run(GetParam().graph(), {x, y}, 1)[0]; }
    std::array<double, 2> differences(double x, double y) const {
        constexpr double h = 1e-6;
        return {(value(x + h, y) - value(x - h, y)) / (2 * h), (value(x, y + h) - value(x, y - h)) / (2 * h)};
    }
};
INSTANTIATE_TEST_SUITE_P(Operations, Derivative, testing::ValuesIn(operations), [](const auto& test) {
    std::string name = test.param.name;
    std::ranges::replace(name, ' ', '_');
    return name;
});

constexpr std::array<std::array<double, 2>, 4> places{{{0.3, 0.9}, {0.91, 0.4}, {-0.7, 1.3}, {-1.2, -0.35}}};

TEST_P(Derivative, TangentsAreThoseOfDifferences) {
    const Graph graph = with_tangents(GetParam().graph(), behind(2, 1));
    for (const auto& [x, y] : places) {
        const auto expected = differences(x, y);
        for (const std::array<double, 2> direction : {std::array{1.0, 0.0}, {0.0, 1.0}, {-2.0, 0.5}}) {
            const std::vector<double> out = run(graph, {x, y, direction[0], direction[1]}, 2);
            EXPECT_EQ(out[0], value(x, y));
            EXPECT_NEAR(out[1], expected[0] * direction[0] + expected[1] * direction[1], 1e-7) << x << ", " << y;
        }
    }
}

TEST_P(Derivative, AdjointsAreThoseOfDifferences) {
    const Graph graph = adjoint(GetParam().graph(), backwards());
    for (const auto& [x, y] : places) {
        const auto expected = differences(x, y);
        const std::vector<double> found = run(graph, {x, y}, 1, {1.5});
        EXPECT_NEAR(found[0], 1.5 * expected[0], 1e-7) << x << ", " << y;
        EXPECT_NEAR(found[1], 1.5 * expected[1], 1e-7) << x << ", " << y;
    }
}

TEST(Derivatives, OfARootOfZeroAreZero) {
    const Graph root = of_two([](Graph& g, Id x, Id y) { return g.add(Op::square_root, g.add(Op::multiply, x, y)); });
    EXPECT_EQ(run(with_tangents(root, behind(2, 1)), {0, 2, 1, 1}, 2)[1], 0);
    EXPECT_EQ(run(adjoint(root, backwards()), {0, 2}, 1, {1}), (std::vector<double>{0, 0}));
}

TEST(Derivatives, OfWhatIsNotAskedForAreNotComputed) {
    const Graph product = of_two([](Graph& g, Id x, Id y) { return g.add(Op::multiply, x, y); });
    DerivativeOptions options = behind(2, 1);
    options.places[1] = {};
    EXPECT_EQ(with_tangents(product, options), without_dead_code(product));
    options = backwards();
    options.places[0] = {};
    EXPECT_TRUE(adjoint(product, options).outputs().empty());
}

// v^ (J v) = (J^T v^) v, whatever the graph.
TEST(Derivatives, TangentsAndAdjointsBelongTogether) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Graph graph = in_single_numbers(
            random_graph(seed, {.max_width = 2, .with_calls = false, .with_regions = false, .with_zeros = false}));
        std::array<int, max_arrays> count{};
        for (int i = 0; i <= output_array; ++i)
            count[static_cast<std::size_t>(i)] = static_cast<int>(array_size(graph, i));
        DerivativeOptions forwards, back;
        for (int i = 0; i <= output_array; ++i) {
            forwards.places[static_cast<std::size_t>(i)] = {i, count[static_cast<std::size_t>(i)]};
            back.places[static_cast<std::size_t>(i)] = {i == output_array ? i : output_array + 1 + i, 0};
        }
        std::mt19937 random(seed);
        const auto numbers = [&](int size) {
            std::vector<double> out(static_cast<std::size_t>(size));
            std::ranges::generate(out, [&] { return 0.2 + static_cast<double>(random()) / 4e9; });
            return out;
        };
        std::array<std::vector<double>, max_arrays> values, tangents, adjoints, both;
        Frame forward_frame, back_frame;
        for (std::size_t i = 0; i <= output_array; ++i) {
            values[i] = numbers(count[i]), tangents[i] = numbers(count[i]), both[i] = values[i];
            both[i].insert(both[i].end(), tangents[i].begin(), tangents[i].end());
            forward_frame.arrays[i] = both[i].data(), back_frame.arrays[i] = values[i].data();
        }
        for (std::size_t i = 0; i < output_array; ++i) {
            adjoints[i].resize(values[i].size());
            back_frame.arrays[output_array + 1 + i] = adjoints[i].data();
        }
        backends().back().compile(with_tangents(graph, forwards), false)->run(forward_frame);
        backends().back().compile(adjoint(graph, back), false)->run(back_frame);
        double forward = 0, backward = 0, size = 0;
        for (const Output& output : graph.outputs()) {
            const auto i = static_cast<std::size_t>(output.index);
            const double term = values[output_array][i] * both[output_array][values[output_array].size() + i];
            forward += term, size += std::abs(term);
        }
        for (std::size_t a = 0; a < output_array; ++a) {
            for (std::size_t i = 0; i < adjoints[a].size(); ++i) {
                backward += adjoints[a][i] * tangents[a][i], size += std::abs(adjoints[a][i] * tangents[a][i]);
            }
        }
        if (!std::isfinite(size)) continue;  // a graph of these numbers may divide by zero
        EXPECT_NEAR(forward, backward, 1e-9 * size) << "seed " << seed;
    }
}

}  // namespace
}  // namespace hamilcar::program::test
