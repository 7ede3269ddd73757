// The recording number: the nodes that arithmetic, select and the rare branch of `unless` leave in the graph.
#include "hamilcar/scalar/traced.hpp"

#include <gtest/gtest.h>

#include "hamilcar/math/traced.hpp"
#include "hamilcar/program/executable.hpp"
#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {
namespace {

using Number = Traced<>;
using Pair = Traced<2>;
using program::Op;

class Recording : public testing::Test {
protected:
    Number input(int place) { return Number::of(graph_.input(0, place)); }
    Op op(const Number& number) const { return graph_.node(number.id()).op; }
    // Of one car.
    double run(const Number& result, std::vector<double> inputs) {
        program::Graph graph = graph_;
        graph.output(1, 0, result.id());
        double found = 0;
        program::Frame frame;
        frame.arrays[0] = inputs.data(), frame.arrays[1] = &found;
        program::backends().back().compile(graph, false)->run(frame);
        return found;
    }

    program::Graph graph_;
    Tracing tracing_{graph_};
};

TEST_F(Recording, StartsFromZeroAndFoldsConstants) {
    EXPECT_EQ(Number().id(), Number(0).id());
    EXPECT_EQ((Number(2) * Number(3)).id(), Number(6).id());
    EXPECT_EQ((input(0) * Number(1) + Number(0)).id(), input(0).id());
    EXPECT_EQ((input(0) + input(1)).id(), (input(1) + input(0)).id()) << "equal expressions are one";
    EXPECT_EQ(op(sqrt(input(0))), Op::square_root);
}

TEST_F(Recording, DecidesOnlyConstantConditions) {
    EXPECT_FALSE(any(Number(1) < Number(0)));
    EXPECT_TRUE(any(Number(0) < Number(1)));
    EXPECT_TRUE(any(input(0) < Number(0))) << "it may be";
    EXPECT_EQ(select(Number(0) < Number(1), input(0), input(1)).id(), input(0).id());
    const Number least = select(input(0) < input(1), input(0), input(1));
    EXPECT_EQ(run(least, {3, -4}), -4);
    EXPECT_EQ(run(least, {-5, -4}), -5);
}

TEST_F(Recording, RecordsTheRareBranchAsARegion) {
    const Number x = input(0);
    const auto found = unless(
        x > Number(10), [&] { return std::array{x * x}; }, [&] { return std::array{x * x * Number(1)}; });
    EXPECT_EQ(graph_.regions().size(), 1u);
    const Number angle = input(1);
    const Number sine = sincos(angle).sine;
    ASSERT_EQ(graph_.regions().size(), 2u);
    for (const double a : {0.1, -0.7, 2.0, -40.0}) EXPECT_EQ(run(sine, {0, a}), sincos(a).sine) << a;
    EXPECT_EQ(run(found[0], {11, 0}), 121);
    unless(
        Number(1) > Number(2), [&] { return std::array{x}; }, [&] { return std::array{sqrt(x)}; });
    EXPECT_EQ(graph_.regions().size(), 2u) << "known to be false";
}

TEST_F(Recording, HoldsTwoNumbersSideBySide) {
    const Pair both(std::array{input(0), input(1)});
    const Pair result = both * Pair(3.0) + Pair(input(2));
    EXPECT_EQ(graph_.node(result.id()).width, 2);
    EXPECT_EQ(run(lane(result, 0), {1, 2, 10}), 13);
    EXPECT_EQ(run(lane(result, 1), {1, 2, 10}), 16);
    Pair changed = result;
    set_lane(changed, 1, input(0));
    EXPECT_EQ(lane(changed, 1).id(), input(0).id());
}

TEST_F(Recording, WorksInEigenMatrices) {
    Matrix<Number, 2, 2> A;
    A << input(0), Number(0), Number(1), input(1);
    const Vector<Number, 2> b = A * Vector<Number, 2>(Number(1), input(2));
    EXPECT_EQ(b[0].id(), input(0).id()) << "zeros and ones are gone";
    EXPECT_EQ(run(b[1], {0, 5, 7}), 36);
}

TEST(Tracing, EndsWithItsScope) {
    program::Graph outer, inner;
    const Tracing first(outer);
    {
        const Tracing second(inner);
        EXPECT_EQ(&Tracing::graph(), &inner);
    }
    EXPECT_EQ(&Tracing::graph(), &outer);
}

}  // namespace
}  // namespace hamilcar
