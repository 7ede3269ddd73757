// The shipped car in MuJoCo against the same car in Simbody, from the design position at 20 m/s. What parts them is
// MuJoCo's soft loops: with its most accurate method the gap is in proportion to how far a load opens them.
#include <gtest/gtest.h>

#include "oracle/mujoco_car.hpp"
#include "support/car.hpp"

namespace hamilcar::oracle {
namespace {

constexpr double duration = 2, look_every = 0.1;  // [s]
constexpr int looks = 20;

// From 0 to 1 over unit time with two continuous derivatives.
double smooth_step(double x, int derivative) {
    if (x <= 0 || x >= 1) return derivative == 0 && x >= 1 ? 1 : 0;
    if (derivative == 0) return x * x * x * (10 + x * (6 * x - 15));
    if (derivative == 1) return 30 * x * x * (1 - x) * (1 - x);
    return 60 * x * (1 - x) * (1 - 2 * x);
}

Inputs straight(double t) {
    return {.drive_torque = 500 * smooth_step((t - 0.2) / 0.5, 0)};
}

// Left, then right by as much, and the brake at the end.
Inputs bend(double t) {
    constexpr double rack = 0.004, takes = 0.5;
    const auto steering = [&](int derivative) {
        return rack / std::pow(takes, derivative) *
               (smooth_step((t - 0.3) / takes, derivative) - 2 * smooth_step((t - 1) / takes, derivative));
    };
    return {steering(0), steering(1), steering(2), straight(t).drive_torque, 0.2 * smooth_step((t - 1.5) / 0.2, 0)};
}

CarState at_design(const VehicleDescription& car, double speed) {
    CarState state;
    state.velocity = {speed, 0, 0};
    for (const SuspensionDescription& suspension : car.suspensions) {
        const std::vector<double> zeros(static_cast<std::size_t>(suspension.linkage.coordinate_count()), 0.0);
        const double spin = speed / casing_of(suspension.wheels[0].tire).rolling_radius;
        state.suspensions.push_back({zeros, zeros, {{.spin = spin, .tires = {{}}}}});
    }
    return state;
}

struct Case {
    VehicleDescription car = test::paper_car();
    Road road;
    double speed = 20;
    Inputs (*inputs)(double) = straight;
};

// At design, with the loops closed: where links are not as long as their points are apart the struts turn a little.
CarState start_of(const Case& run) {
    MujocoCar car(run.car, run.road, {});
    car.set_inputs(run.inputs(0));
    car.set_state(at_design(run.car, run.speed));
    return car.state();
}

using Path = std::vector<std::array<double, 3>>;

template <class Car, class Advance>
Path drive(const Case& run, Car& car, const Advance& advance) {
    car.set_inputs(run.inputs(0));
    car.set_state(start_of(run));
    Path path;
    for (int i = 0; i < looks; ++i) {
        advance(i * look_every);
        path.push_back(car.state().position);
    }
    return path;
}

// Its own error at this step is below 1e-10 m.
Path simbody_path(const Case& run) {
    SimbodyCar car(run.car, run.road);
    constexpr double step = 1e-3;
    return drive(run, car,
                 [&](double t) { car.advance(t, step, static_cast<int>(std::lround(look_every / step)), run.inputs); });
}

struct Gap {
    double path = 0, loops = 0;  // largest distance between the paths, largest opening [m]
};

Gap gap_to(const Path& reference, const Case& run, const MujocoOptions& options) {
    MujocoCar car(run.car, run.road, options);
    const Path path = drive(run, car, [&](double t) {
        car.advance(t, static_cast<int>(std::lround(look_every / options.step)), run.inputs);
    });
    Gap gap{.loops = car.worst_loop_opening()};
    for (std::size_t i = 0; i < path.size(); ++i)
        gap.path = std::max(gap.path, (Vec3<double>(path[i].data()) - Vec3<double>(reference[i].data())).norm());
    std::printf("%d at %g s: paths apart %.2e m, loops open %.2e m\n", static_cast<int>(options.integrator),
                options.step, gap.path, gap.loops);
    return gap;
}

MujocoOptions stiff(MujocoIntegrator integrator, double step) {
    return {integrator, step, MujocoLoops::stiffest(integrator, step)};
}

// The front loops carry the car's weight, so they are open a little even here: 6e-9 m, and the paths part by as much.
TEST(Mujoco, RunsStraightWithSimbody) {
    const Case run;
    const Gap gap = gap_to(simbody_path(run), run, stiff(MujocoIntegrator::rk4, 1e-3));
    EXPECT_LT(gap.path, 1e-7);
    EXPECT_LT(gap.loops, 1e-7);
}

// A load opens a loop by (1 - impedance) / stiffness, and the stiffness a step allows is as 1 / step^2: 2.4e-6 m and
// 6.0e-7 m. Runge-Kutta's own error has no part in it that shows.
TEST(Mujoco, ComesCloserInABendAsTheSquareOfTheStepWithTheStiffestLoops) {
    const Case run{.inputs = bend};
    const Path reference = simbody_path(run);
    const Gap coarse = gap_to(reference, run, stiff(MujocoIntegrator::rk4, 2e-3));
    const Gap fine = gap_to(reference, run, stiff(MujocoIntegrator::rk4, 1e-3));
    EXPECT_LT(fine.path, 2e-6);
    EXPECT_NEAR(coarse.path / fine.path, 4, 0.4);
    EXPECT_NEAR(coarse.loops / fine.loops, 4, 0.4);
}

// A tenth of the impedance's lack, a tenth of the gap. With the library's own softness the front wheels' toe gives way by
// a millimeter or two, and the car is 0.6 m elsewhere after 41 m.
TEST(Mujoco, ComesCloserInABendWithImpedanceAlone) {
    const Case run{.inputs = bend};
    const Path reference = simbody_path(run);
    MujocoOptions options = stiff(MujocoIntegrator::rk4, 2e-3);
    const Gap hardest = gap_to(reference, run, options);
    options.loops.impedance[0] = options.loops.impedance[1] = 0.999;
    const Gap softer = gap_to(reference, run, options);
    EXPECT_NEAR(softer.path / hardest.path, 10, 1);
    options.loops = {};
    const Gap library = gap_to(reference, run, options);
    EXPECT_GT(library.path, 0.1);
}

TEST(Mujoco, IsOfFirstOrderWithEuler) {
    const Case run{.inputs = bend};
    const Path reference = simbody_path(run);
    for (const MujocoIntegrator integrator : {MujocoIntegrator::euler, MujocoIntegrator::implicit}) {
        const Gap coarse = gap_to(reference, run, stiff(integrator, 2e-3));
        const Gap fine = gap_to(reference, run, stiff(integrator, 1e-3));
        EXPECT_NEAR(coarse.path / fine.path, 2, 0.2);
    }
}

// With an arm and a tie rod that are not as long as their points are apart.
TEST(Mujoco, AgreesOnASlopeFromRest) {
    Case run{.road = {.grade = 0.05, .bank = 0.02, .friction = 0.9}, .speed = 0, .inputs = bend};
    for (SuspensionDescription& suspension : run.car.suspensions) {
        if (suspension.keyword != "macpherson") continue;
        suspension.linkage.cuts.at(0).length = 0.337;  // control arm
        suspension.linkage.cuts.at(1).length = 0.375;  // tie rod
    }
    const Gap gap = gap_to(simbody_path(run), run, stiff(MujocoIntegrator::rk4, 1e-3));
    EXPECT_LT(gap.path, 1e-6);
}

TEST(Mujoco, ReportsPositionsThatTheLinkageCannotReach) {
    const Case run;
    MujocoCar car(run.car, run.road, {});
    CarState state = at_design(run.car, run.speed);
    state.suspensions[0].coordinates.back() += 1;
    EXPECT_THROW(car.set_state(state), std::runtime_error);
}

TEST(Mujoco, RejectsWhatCannotBe) {
    Case run;
    run.car.chassis.mass = -1;
    EXPECT_THROW(MujocoCar(run.car, run.road, {}), std::runtime_error);
}

}  // namespace
}  // namespace hamilcar::oracle
