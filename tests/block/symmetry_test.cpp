// What must not affect results: left or right, position, chart, repetition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/joint_channels.hpp"
#include "hamilcar/tire/mirrored.hpp"
#include "support/allocation_guard.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

ScenarioDescription lane_change(double sign = 1) {
    ScenarioDescription s = test::scenario(5, 15);
    s.drive = test::table({0, 0.5}, {0, 300});
    s.brake = test::table({3.5, 4, 5}, {0, 0.2, 0.2});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0.5, 1.2, 2, 2.7, 3.4}, {0, sign * 0.005, 0, -sign * 0.005, 0});
    return s;
}

// A channel of the mirrored car: left for right, and the sign that the mirror gives it.
struct Mirrored {
    std::string name;
    double sign;
};
Mirrored mirror(const std::string& name) {
    std::string other = name;
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"_left", "_right"}, {"_right", "_left"}}) {
        const auto at = name.find(from);
        if (at != std::string::npos) other = name.substr(0, at) + to + name.substr(at + from.size());
    }
    for (const char* odd : {".y", ".qx", ".qz", "lateral", "roll", "yaw", "input.rack", "steering_wheel",
                            "steering_torque", "wheel.steer", "bryant.1", "bryant.3", "slip_angle", "inclination",
                            "aligning_moment", "overturning_moment", "sideslip"}) {
        const bool bar = name.find("anti_roll_bar") != std::string::npos;
        if (!bar && name.find(odd) != std::string::npos) return {other, -1};
    }
    return {other, 1};
}

void expect_mirrored(const VehicleDescription& car) {
    Simulation left(car, lane_change(1)), right(car, lane_change(-1));
    const auto channels = all_channels(car);
    std::vector<Channel> of_joints;
    add_joint_channels(car, of_joints);
    const auto contains = [](const std::vector<Channel>& list, const std::string& name) {
        return std::ranges::any_of(list, [&](const Channel& one) { return one.column.name == name; });
    };
    double worst = 0;
    while (!left.finished()) {
        for (int i = 0; i < 100; ++i) ASSERT_FALSE(left.advance() || right.advance());
        const Sample a = left.sample(), b = right.sample();
        for (const Channel& channel : channels) {
            // The energy balance and the constraint violations are round-off themselves, so they need not mirror.
            if (channel.column.name.starts_with("constraints") || channel.column.name == "energy.balance") continue;
            // A difference along the path, which round-off enters more.
            const std::string& name = channel.column.name;
            const bool is_difference = name == "input.steering_torque" || name == "input.rack_force" ||
                                       name.starts_with("seat.acceleration") || contains(of_joints, name);
            const double tolerance = is_difference ? 1e-7 : 1e-10;
            const Mirrored twin = mirror(channel.column.name);
            const auto found = std::find_if(channels.begin(), channels.end(),
                                            [&](const Channel& c) { return c.column.name == twin.name; });
            ASSERT_NE(found, channels.end()) << twin.name;
            const double value = channel.read(a), expected = twin.sign * found->read(b);
            const double error = std::abs(value - expected) / std::max(1.0, std::abs(value));
            if (tolerance == 1e-10) worst = std::max(worst, error);
            EXPECT_LT(error, tolerance) << channel.column.name << " at " << a.time;
        }
    }
    std::printf("largest relative difference: %.1e\n", worst);
}

TEST(Mirror, SteeringTheOtherWayMirrorsEveryChannel) {
    expect_mirrored(test::paper_car());
}

// Tires with ply steer and conicity: the right one is the left one's mirror image.
TEST(Mirror, SkewTiresAreMirroredFromSideToSide) {
    std::ostringstream file;
    file << std::ifstream(test::source_path("vehicles/tires/pacejka_205_60_r15.tir")).rdbuf();
    std::string text = file.str();
    text.replace(text.find("'SYMMETRIC'"), 11, "'LEFT'");
    const MagicFormulaDescription left = io::tir_from(io::parse_property_file(text, "left.tir")).tire;
    ASSERT_NE(left.coefficients[PHY1], 0);
    VehicleDescription car = test::shipped_car();
    for (std::size_t i = 0; i < car.suspensions.size(); ++i) {
        car.suspensions[i].wheels[0].tire = i % 2 == 0 ? TireDescription(left) : mirrored(TireDescription(left));
    }
    expect_mirrored(car);
}

TEST(FarAway, ChangesNothing) {
    ScenarioDescription far = lane_change();
    far.initial.position = {10e3, -10e3};
    Simulation here(test::paper_car(), lane_change()), there(test::paper_car(), far);
    test::run_to_end(here);
    test::run_to_end(there);
    const Vec3<double> moved = Vec3<double>(there.state().position()) - Vec3<double>(here.state().position());
    EXPECT_NEAR(moved[0], 10e3, 1e-9);
    EXPECT_NEAR(moved[1], -10e3, 1e-9);
    EXPECT_NEAR(moved[2], 0, 1e-9);
    for (int i = 3; i < here.model().vehicle.state_size; ++i) {
        if (i == 13) continue;  // work [J], compared with the energy's size below
        const double a = here.state().values[static_cast<std::size_t>(i)],
                     b = there.state().values[static_cast<std::size_t>(i)];
        EXPECT_NEAR(a, b, 1e-9 * std::max(1.0, std::abs(a))) << i;
    }
}

TEST(Charts, TakeTheSamePath) {
    ScenarioDescription bryant = lane_change();
    bryant.solver.chart = ChassisChart::bryant;
    ScenarioDescription quaternion = lane_change();
    bryant.solver.integrator = quaternion.solver.integrator = "rk4";
    Simulation a(test::paper_car(), bryant), b(test::paper_car(), quaternion);
    test::run_to_end(a);
    test::run_to_end(b);
    EXPECT_LT((a.state().position() - b.state().position()).norm(), 1e-8);
}

TEST(ConstraintModes, TakeTheSamePath) {
    ScenarioDescription stabilized = lane_change();
    stabilized.solver.constraints = ConstraintMode::stabilized;
    Simulation a(test::paper_car(), stabilized), b(test::paper_car(), lane_change());
    test::run_to_end(a);
    test::run_to_end(b);
    EXPECT_LT((a.state().position() - b.state().position()).norm(), 1e-6);
    EXPECT_LT(b.sample().violation, 1e-14) << "exact mode: round-off";
}

TEST(Repeatability, TwoRunsGiveTheSameBytes) {
    Simulation a(test::paper_car(), lane_change()), b(test::paper_car(), lane_change());
    test::run_to_end(a);
    test::run_to_end(b);
    EXPECT_EQ(std::memcmp(&a.state(), &b.state(), sizeof(State<double>)), 0);
}

TEST(Step, AllocatesNothing) {
    for (const Method& method : methods) {
        ScenarioDescription s = lane_change();
        s.solver.integrator = method.name;
        Simulation simulation(test::paper_car(), s);
        simulation.prepare();
        const test::AllocationGuard guard;
        for (int i = 0; i < 50; ++i) simulation.advance();
        EXPECT_EQ(guard.allocations(), 0) << method.name;
    }
    const test::AllocationGuard guard;
    ::operator delete(::operator new(1));
    EXPECT_EQ(guard.allocations(), 1) << "the guard itself must see an allocation";
}

TEST(State, IsPlainMemory) {
    static_assert(std::is_trivially_copyable_v<State<double>>);
}

}  // namespace
}  // namespace hamilcar
