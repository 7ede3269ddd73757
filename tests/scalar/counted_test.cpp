// The counting scalar counts what is done and changes nothing: known expressions cost what they cost on paper, and the
// whole right-hand side of the shipped car, whose spokes a double runs abreast and the counting scalar one by one, gives
// the same bits.
#include "hamilcar/math/counted.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "hamilcar/block/ring.hpp"
#include "hamilcar/math/small_solve.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

template <class F>
OperationCount cost_of(F&& f) {
    Counted::count() = {};
    f();
    return Counted::count();
}

TEST(Counted, CountsEveryKindOfOperation) {
    Counted a(3), b(4), c(5), result;
    OperationCount cost = cost_of([&] { result = sqrt(a * a + b * b) / c - a; });
    EXPECT_EQ(cost.multiplications, 2);
    EXPECT_EQ(cost.additions, 2);
    EXPECT_EQ(cost.divisions, 1);
    EXPECT_EQ(cost.roots, 1);
    EXPECT_EQ(cost.choices, 0);
    EXPECT_EQ(cost.total(), 6);
    EXPECT_EQ(result.value(), -2);

    cost = cost_of([&] { result = a, result += b, result *= c, result -= a, result /= b; });
    EXPECT_EQ(cost.additions, 2);
    EXPECT_EQ(cost.multiplications, 1);
    EXPECT_EQ(cost.divisions, 1);
    EXPECT_EQ(result.value(), (7.0 * 5 - 3) / 4);

    cost = cost_of([&] { result = min(max(a, b), abs(-c)); });
    EXPECT_EQ(cost.choices, 3);
    EXPECT_EQ(cost.total(), 0) << "choices are no arithmetic";
    EXPECT_EQ(result.value(), 4);
}

TEST(Counted, ComparesLikeADouble) {
    const Counted small(-1), large(2);
    EXPECT_TRUE(small < large && large > small && small <= large && large >= small && small <= small && small >= small);
    EXPECT_FALSE(large < small || small > large || large <= small || small >= large || small == large);
    EXPECT_TRUE(small != large && small == Counted(-1));
    EXPECT_EQ(value_of(large), 2);
}

// Products of matrices cost what the schoolbook says: nothing hidden in Eigen, nothing lost.
TEST(Counted, CountsInsideMatrices) {
    const Mat3<Counted> A = Mat3<Counted>::Constant(Counted(2));
    const Vec3<Counted> v = Vec3<Counted>::Constant(Counted(3));
    OperationCount cost = cost_of([&] {
        const Vec3<Counted> w = A * v;
        EXPECT_EQ(w[0].value(), 18);
    });
    EXPECT_EQ(cost.multiplications, 9);
    EXPECT_EQ(cost.additions, 6);
    cost = cost_of([&] {
        const Vec3<Counted> w = v.cross(Vec3<Counted>(A.col(0)));
        EXPECT_EQ(w[0].value(), 0);
    });
    EXPECT_EQ(cost.multiplications, 6);
    EXPECT_EQ(cost.additions, 3);
    cost = cost_of([&] {
        const Mat3<Counted> one = inverse<Counted>(Mat3<Counted>(Mat3<Counted>::Identity())).matrix;
        EXPECT_EQ(one(0, 0).value(), 1);
    });
    EXPECT_EQ(cost.divisions, 1);
    EXPECT_EQ(cost.multiplications, 3 * 6 + 3 + 9);
}

// A car on the move with everything at work: open to every branch of the tire, steered, braked, driven.
State<double> on_the_move(const Model<double>& model, const Input<double>& input) {
    State<double> state = design_state(model, Vec3<double>(3, -2, 0.002), Mat3<double>::Identity());
    EXPECT_TRUE(assemble(model, input.rack, state).assembled);
    Spatial<double> v;
    v << 14, 1.5, -0.1, 0.2, -0.1, 0.4;
    set_velocities(model, input, v, state);
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        state.spoke(i).spin_momentum *= 0.9 + 0.06 * i;
        state.spoke(i).deflection_x = 0.006 * (i - 1), state.spoke(i).deflection_y = 0.01 * (2 - i);
        state.spoke(i).brake_windup = 0.01 * i;
    }
    return state;
}

// In mode and chart of the given kind, the rate of every number of the state with both scalars.
void expect_same_bits(ChassisChart chart, double gain) {
    const VehicleDescription car = test::paper_car();
    Model<double> model = test::make_model(car);
    model.chart = chart, model.stabilization_gain = gain;
    const Model<Counted> counting{.vehicle = Vehicle<Counted>(car),
                                  .road = PlaneRoad<Counted>(0, 0, 1),
                                  .chart = chart,
                                  .stabilization_gain = gain};
    Input<double> input;
    input.rack = {0.01, 0.05, -0.3};
    input.drive_torque = 250, input.brake = 0.1;
    const Input<Counted> same_input{.rack = {0.01, 0.05, -0.3}, .drive_torque = 250, .brake = 0.1};
    const State<double> state = on_the_move(model, input);
    State<Counted> same_state;
    for (std::size_t i = 0; i < state.values.size(); ++i) same_state.values[i] = state.values[i];

    State<double> rate;
    State<Counted> same_rate;
    const Health<double> health = evaluate(model, input, state, rate).health;
    Health<Counted> same_health;
    const OperationCount cost =
        cost_of([&] { same_health = evaluate(counting, same_input, same_state, same_rate).health; });
    for (std::size_t i = 0; i < static_cast<std::size_t>(hub_size + 4 * spoke_size); ++i) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(rate.values[i]),
                  std::bit_cast<std::uint64_t>(same_rate.values[i].value()))
            << "number " << i << " of the state: " << rate.values[i] << " and " << same_rate.values[i].value();
    }
    EXPECT_EQ(health.violation, same_health.violation.value());
    EXPECT_EQ(health.mobility, same_health.mobility.value());
    std::printf("one right-hand side: %ld additions, %ld multiplications, %ld divisions, %ld roots, %ld choices\n",
                cost.additions, cost.multiplications, cost.divisions, cost.roots, cost.choices);
    for (const std::int64_t kind : {cost.additions, cost.multiplications, cost.divisions, cost.roots, cost.choices}) {
        EXPECT_GT(kind, 0);
    }
}

TEST(Counted, ComputesTheWholeCarToTheSameBits) {
    expect_same_bits(ChassisChart::quaternion, 0);
}
TEST(Counted, ComputesThePapersFormToTheSameBits) {
    expect_same_bits(ChassisChart::bryant, 400);
}

}  // namespace
}  // namespace hamilcar
