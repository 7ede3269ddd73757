// Springs that carry: with the forces that are found the vehicle, left to itself, comes to rest at design.
#include "hamilcar/block/preload.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hamilcar/block/equilibrium.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

struct Heights {
    double contact, potential, length;  // of the tire's lowest point [m], of the masses [J], of the spring [m]
};

class Preload : public testing::TestWithParam<std::string> {};

bool is_twist_spring(const SuspensionSpringDescription& spring) {
    return spring.name.ends_with("_twist");
}

// Settling knows nothing of preloads: it moves every suspension until all forces balance.
TEST_P(Preload, LetsTheVehicleStandAtDesign) {
    VehicleDescription vehicle = test::shipped(GetParam());
    std::size_t carrying = 0;
    for (SuspensionDescription& suspension : vehicle.suspensions) {
        for (SuspensionSpringDescription& spring : suspension.springs) {
            if (is_twist_spring(spring)) continue;
            spring.spring.force_at_design = 1e4, spring.spring.carries = true;  // whatever it was is forgotten
            ++carrying;
        }
    }
    ASSERT_GE(carrying, 4u);
    ASSERT_EQ(find_preloads(vehicle), std::nullopt);
    const Model<double> model = test::make_model(vehicle);
    State<double> state = design_state(model, Vec3<double>(0, 0, 0.02), Mat3<double>::Identity());
    for (const Suspension<double>& suspension : model.vehicle.suspensions) {
        for (int j = 0; j < suspension.linkage.nV(); ++j)
            suspension.state(state.values.data()).independent[j] = 2e-3 * (j + 1);
    }
    ASSERT_TRUE(settle(model, Input<double>{}, state).found);
    for (const Suspension<double>& suspension : model.vehicle.suspensions) {
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            EXPECT_NEAR(suspension.state(state.values.data()).independent[j], 0, 1e-9) << suspension.first_wheel;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, Preload, testing::ValuesIn(test::fleet()), [](const auto& p) { return p.param; });

// By hand: the load of a wheel less what hangs on it, over how far the spring gives as the wheel rises (virtual work). On tires
// without friction, since a cambered one pushes sideways.
TEST(Preloads, AreTheWheelsLoadOverTheMotionRatio) {
    VehicleDescription car = test::made_conservative(test::shipped("formula"));
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionSpringDescription& spring : suspension.springs) spring.spring.carries = true;
    }
    ASSERT_EQ(find_preloads(car), std::nullopt);
    const Model<double> model = test::make_model(car);
    State<double> state = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    ASSERT_TRUE(settle(model, Input<double>{}, state).found);
    const auto velocity = velocity_block(model, state, Input<double>{});
    const auto momenta = momenta_block(model, state, Input<double>{}, velocity);
    for (std::size_t s = 0; s < car.suspensions.size(); ++s) {
        const Suspension<double>& suspension = model.vehicle.suspensions[s];
        ASSERT_EQ(suspension.linkage.nV(), 1);
        const double load = momenta.suspensions[s].wheels[0].tire.Fz;
        const double radius = std::get<SpringTireDescription>(car.suspensions[s].wheels[0].tire).radius;
        const Vec3<double> up = velocity.R_GC.transpose() * Vec3<double>::UnitZ();
        // Differences of the closed linkage: how wheel, masses and spring move with the coordinate.
        const auto at = [&](double V) {
            State<double> moved = state;
            const auto view = suspension.state(moved.values.data());
            view.independent[0] = V;
            for (int i = 0; i < 20; ++i)
                suspension.linkage.newton_step(view.independent, view.dependent, RackMotion<double>{});
            LinkagePosition<double> position;
            suspension.linkage.find_position(view.independent, view.dependent, RackMotion<double>{}, 0.0, position);
            Heights heights{};
            const SuspensionWheel<double>& wheel = suspension.wheels[0];
            const Placement<double>& carrier = position.pose[static_cast<std::size_t>(wheel.frame)];
            const double camber = up.dot(carrier.direction(wheel.wheel.axis));
            heights.contact = up.dot(carrier.point(wheel.wheel.center)) - std::sqrt(1 - camber * camber) * radius;
            for (const auto& body : suspension.bodies) {
                const Vec3<double> place = position.pose[static_cast<std::size_t>(body.frame)].point(body.body.center);
                heights.potential += body.body.mass * model.vehicle.gravity * up.dot(place);
            }
            heights.length =
                suspension.linkage.line(suspension.springs[0].line, position, view.independent, view.dependent).length;
            return heights;
        };
        constexpr double step = 1e-5;
        const auto above = at(step), below = at(-step);
        const double work = load * (above.contact - below.contact) - (above.potential - below.potential);
        EXPECT_NEAR(car.suspensions[s].springs[0].spring.force_at_design, -work / (above.length - below.length),
                    1e-5 * load)
            << car.suspensions[s].springs[0].name;
    }
}

TEST(Preloads, AreNotFoundWhereASpringDoesNotMoveWithItsWheel) {
    VehicleDescription car = test::shipped("formula");
    SuspensionSpringDescription& spring = car.suspensions[0].springs[0];
    spring.spring.carries = true;
    spring.line.part = spring.line.base = 0, spring.line.coordinate = {};  // from the chassis to the chassis
    spring.line.on_part = {0, 0, 0}, spring.line.on_base = {0, 0, 1};
    EXPECT_THAT(find_preloads(car).value_or(""), testing::HasSubstr("'front_left'"));
}

}  // namespace
}  // namespace hamilcar
