// The rack's force by other routes: the energy that it brings in, the work of what gives way to it at rest, the balance of
// moments about a kingpin, and the same car by the other program.
#include "hamilcar/analysis/rack_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/analysis/linear_model.hpp"
#include "support/fleet.hpp"
#include "support/hardpoints.hpp"

namespace hamilcar {
namespace {

using Vec = Vec3<double>;

// A car at one instant.
struct Instant {
    const Model<double>& model;
    State<double> state;
    Input<double> input;
    Velocity<double> velocity = velocity_block(model, state, input);
    Momenta<double> momenta = momenta_block(model, state, input, velocity);

    double rack_force() const { return hamilcar::rack_force(model, state, input, velocity, momenta); }
    double stored() const {  // [J]
        const Energy<double> e = energy(model, state, velocity, momenta);
        return e.kinetic + e.potential;
    }
};

// Springs and dampers between chassis and knuckle, off the strut: the rack moves them.
VehicleDescription sprung_at_the_knuckle() {
    VehicleDescription car = test::shipped("bmw_323i");
    for (std::size_t s = 0; s < 2; ++s) {
        SuspensionDescription& suspension = car.suspensions[s];
        const Point& c = suspension.wheels[0].wheel.center;
        const LineDescription line{
            suspension.wheels[0].part, 0, {c[0] + 0.05, 0.8 * c[1], 0.35}, {-0.02, 0.75 * c[1], 0.7}, {}};
        suspension.springs[0].line = suspension.dampers[0].line = line;
    }
    return car;
}

// Driven by the drive torque alone.
VehicleDescription without_engine(VehicleDescription car) {
    car.power_units.clear(), car.differentials.clear();
    return car;
}

VehicleDescription car_named(const std::string& name) {
    return without_engine(name == "knuckle" ? sprung_at_the_knuckle() : test::shipped(name));
}

VehicleDescription conservative(const std::string& name) {
    VehicleDescription car = test::made_conservative(car_named(name));
    car.aerodynamics = {};
    return car;
}

// Struts, wishbones and beam axles.
class RackForce : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Cars, RackForce,
                         testing::Values("bmw_323i", "hatchback", "knuckle", "formula", "offroader",
                                         "truck_semitrailer"));

// Nothing but the rack brings energy in.
TEST_P(RackForce, WorksWhatTheCarGains) {
    constexpr double step = 5e-4, w = 2 * std::numbers::pi * 1.5, amplitude = 0.01;
    constexpr int steps = 1200;
    const Simulation start(conservative(GetParam()), test::scenario(1, 12));
    const Model<double>& model = start.model();
    const auto driver = [](double t) {
        Input<double> input;
        input.rack = {amplitude * (1 - std::cos(w * t)), amplitude * w * std::sin(w * t),
                      amplitude * w * w * std::cos(w * t)};
        return input;
    };
    Integrator<State<double>> integrator(*find_method("rk4"), step, model.vehicle.state_size);
    State<double> state = start.state();
    const double before = Instant{model, state, driver(0)}.stored();
    double work = 0, gained = 0, most = 0, worst = 0, last = 0, middle = 0;
    for (int i = 1; i <= steps; ++i) {
        integration_block(model, integrator, driver, (i - 1) * step, state);
        const Instant now{model, state, driver(i * step)};
        const double power = now.rack_force() * now.input.rack.rate;
        if (i % 2 == 1) {
            middle = power;
            continue;
        }
        work += step / 3 * (last + 4 * middle + power);  // Simpson
        last = power;
        gained = now.stored() - before;
        most = std::max(most, std::abs(gained)), worst = std::max(worst, std::abs(work - gained));
    }
    std::printf("%s: gains up to %.3f J, work differs by %.1e J\n", GetParam().c_str(), most, worst);
    EXPECT_LT(worst, 5e-9 * most);
}

// Power of everything that is neither in the potential nor the rack's.
double lost(const Instant& at) {
    const Vehicle<double>& vehicle = at.model.vehicle;
    double power = vehicle.aerodynamics.evaluate(at.velocity.chassis, Vec::Zero()).power;
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = vehicle.suspensions[s];
        const SuspensionVelocity<double>& moving = at.velocity.suspensions[s];
        const SuspensionMomenta<double>& forces = at.momenta.suspensions[s];
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            const auto& wheel = suspension.wheels[i];
            const auto& f = forces.wheels[i];
            const auto turning = [&](int frame) {
                return moving.axis[i].dot(angular(moving.motion[static_cast<std::size_t>(frame)]));
            };
            for (int k = 0; k < wheel.tires; ++k) power += lost_in_tire(f.tires[static_cast<std::size_t>(k)]);
            power +=
                f.drive_torque * (f.spin + turning(wheel.frame) - turning(wheel.reaction)) + f.brake_torque * f.spin;
        }
        for (std::size_t i = 0; i < suspension.dampers.size(); ++i)
            power += forces.dampers[i].force * forces.dampers[i].rate;
    }
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<double>& trailer = vehicle.trailers[i];
        const double rate = at.velocity.trailers[i].own.V_rate[static_cast<std::size_t>(trailer.yaw)];
        power -= trailer.yaw_damping * rate * rate;
    }
    return power;
}

// The whole car under drive, brake and steering, instant by instant: T' + U' = lost power + F beta'.
TEST_P(RackForce, ClosesTheBalanceOfPowers) {
    const VehicleDescription car = car_named(GetParam());
    Simulation simulation(car, test::everything_moves(car));
    const Model<double>& model = simulation.model();
    constexpr double delta = 4e-4;
    int looked = 0;
    double most = 0, worst = 0;
    while (!simulation.finished()) {
        ASSERT_FALSE(simulation.advance());
        if (simulation.steps_taken() % 50 != 0) continue;
        const Instant at{model, simulation.state(), simulation.schedule()(simulation.time())};
        if (std::abs(at.input.rack.rate) < 1e-3) continue;  // no power to see it by
        State<double> rate;
        rate_of_state(model, at.state, at.velocity, at.momenta, rate);
        const auto stored = [&](double time) {
            return Instant{model, state_after(model, at.state, rate, time), input_after(at.input, time)}.stored();
        };
        const double gain =
            (8 * (stored(delta) - stored(-delta)) - stored(2 * delta) + stored(-2 * delta)) / (12 * delta);
        const double force = at.rack_force(), wanted = (gain - lost(at)) / at.input.rack.rate;
        ++looked;
        most = std::max(most, std::abs(force)), worst = std::max(worst, std::abs(force - wanted));
    }
    std::printf("%s: up to %.1f N, differs by %.1e N at %d instants\n", GetParam().c_str(), most, worst, looked);
    EXPECT_GT(looked, 10);
    EXPECT_LT(worst, 1e-5 * most);
}

// At rest the rack is held against the energy that everything else, giving way, would find.
TEST_P(RackForce, OfACarAtRestIsTheSlopeOfItsEnergy) {
    const Simulation start(conservative(GetParam()), test::scenario(1));
    const Model<double>& model = start.model();
    const auto settled = [&](double displacement) {
        Instant at{model, start.state(), {}};
        for (int i = 1; i <= 8; ++i) {  // led there
            at.input.rack.displacement = displacement * i / 8;
            EXPECT_TRUE(assemble(model, at.input.rack, at.state).assembled);
        }
        EXPECT_TRUE(settle(model, at.input, at.state).found);
        return Instant{model, at.state, at.input};
    };
    constexpr double displacement = 0.02, delta = 5e-4;
    const double wanted = (8 * (settled(displacement + delta).stored() - settled(displacement - delta).stored()) -
                           settled(displacement + 2 * delta).stored() + settled(displacement - 2 * delta).stored()) /
                          (12 * delta);
    const double force = settled(displacement).rack_force();
    std::printf("%s: %.6f N at rest, slope of the energy %.6f N\n", GetParam().c_str(), force, wanted);
    EXPECT_NEAR(force, wanted, 1e-7 * std::abs(wanted));
}

// Moments on a spindle about its steering axis, from the strut's top to the ball joint: strut, spring and control arm have
// no lever there. What holds the rest is the tie rod, and the rack holds that.
double force_of_rod(const Instant& at, const SuspensionDescription& suspension, int i) {
    const test::MacPhersonPoints points = test::strut_points(suspension);
    const auto frame =
        static_cast<std::size_t>(at.model.vehicle.suspensions[static_cast<std::size_t>(i)].wheels[0].frame);
    const Pose<double> pose = at.velocity.suspensions[static_cast<std::size_t>(i)].at.pose[frame].pose();
    const auto& f = at.momenta.suspensions[static_cast<std::size_t>(i)].wheels[0];
    const Vec top = vec3(points.strut_top), ball = pose.point(vec3(points.ball_joint));
    const Vec rack = vec3(points.rack_axis), outer = pose.point(vec3(points.tie_rod_outer));
    const Vec rod = (outer - vec3(points.rack_end) - rack * at.input.rack.displacement).normalized();
    const Vec center = pose.point(vec3(suspension.wheels[0].wheel.center)),
              axis = pose.direction(vec3(suspension.wheels[0].wheel.spin_axis));
    const Vec mass_center = pose.point(vec3(suspension.bodies[0].body.center_of_mass)),
              w = angular(at.velocity.chassis);

    Vec moment = f.tire.Mx * f.frame.longitudinal + f.tire.Mz * f.frame.normal;
    const Vec push = f.tire.Fx * f.frame.longitudinal + f.tire.Fy * f.frame.lateral + f.tire.Fz * f.frame.normal;
    moment += (f.frame.point - center).cross(push);
    moment -= axis * axis.dot(moment);  // the bearing passes none of it on
    moment += (center - ball).cross(push + Vec(0, 0, f.stop + f.bar));
    const Vec acceleration = w.cross(velocity_at<double>(at.velocity.chassis, mass_center));  // on a circle
    const Vec gravity = -at.model.vehicle.gravity * at.velocity.R_GC.row(2).transpose();
    moment += (mass_center - ball).cross(suspension.bodies[0].body.mass * (gravity - acceleration));
    const Mat3<double> inertia = pose.R * vec3(suspension.bodies[0].body.inertia).asDiagonal() * pose.R.transpose();
    moment -= w.cross(inertia * w + axis * suspension.wheels[0].wheel.spin_inertia * (f.spin + axis.dot(w)));
    const Vec kingpin = (top - ball).normalized();
    const double along_rod = -kingpin.dot(moment) / kingpin.dot((outer - ball).cross(rod));
    return along_rod * rod.dot(rack);
}

TEST(RackForceOnACircle, IsWhatBothTieRodsNeed) {
    const Linearizer linearizer(car_named("bmw_323i"));
    for (const double lateral : {-5.0, 2.0, 6.0}) {
        const OperatingPoint circle = linearizer.operating_point({20, lateral});
        ASSERT_TRUE(circle.found) << circle.problem;
        const Instant at{linearizer.model(), circle.state, circle.input};
        const auto& corners = linearizer.vehicle().suspensions;
        const double wanted = force_of_rod(at, corners[0], 0) + force_of_rod(at, corners[1], 1);
        const double force = at.rack_force();
        std::printf("%.0f m/s^2: %.6f N, by the tie rods %.6f N\n", lateral, force, wanted);
        EXPECT_NEAR(force, wanted, 1e-7 * std::abs(wanted));
        // caster and the tires' own moment turn the wheels back: the rack, that steers to the left, has to push there
        EXPECT_GT(force * lateral, 0);
    }
}

TEST(RackForceStraightAhead, OfAParkedCarIsZero) {
    for (const char* name : {"bmw_323i", "bmw_e21_320i", "bmw_e90_330i", "hatchback", "formula", "pickup"}) {
        const Simulation parked(car_named(name), test::scenario(1));
        const double force = Instant{parked.model(), parked.state(), parked.schedule()(0)}.rack_force();
        EXPECT_NEAR(force, 0, 1e-5) << name;
    }
}

// The hands put in what the rack takes out.
TEST(SteeringTorque, HasTheRacksPower) {
    SteeringDescription steering;
    steering.rack_per_revolution = 0.05;
    steering.angle = {0, 1.5, 4, 8}, steering.rack = {0, 0.010, 0.031, 0.072};
    constexpr double force = 700;
    for (const double angle : {-5.0, -0.3, 0.0, 2.0, 9.0}) {
        const Column column(steering);
        const SignalValue<double> motion = column.rack_motion({angle, 1.7, 0});
        EXPECT_NEAR(1.7 * steering_torque(column, motion.value, force), force * motion.rate, 1e-9);
    }
    steering.angle.clear(), steering.rack.clear();
    EXPECT_NEAR(steering_torque(Column(steering), 0.02, force), force * 0.05 / (2 * std::numbers::pi), 1e-9);
}

}  // namespace
}  // namespace hamilcar
