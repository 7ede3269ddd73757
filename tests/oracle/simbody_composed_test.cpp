// Every shipped vehicle with composed suspensions in an independent engine: Simbody builds trees, cut joints, dual wheels,
// live axles and trailers from the same description. Driven, steered and braked for 3 s, chassis and trailers take the
// same path within 1e-5 m.
#include <gtest/gtest.h>

#include "oracle/hand_over.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

constexpr double path_tolerance = 1e-5;  // [m]
constexpr double duration = 3;           // [s]

struct Drive {
    const char* vehicle;
    double speed;   // [m/s]
    double rack;    // to either side [m]
    double torque;  // [N m]
    double brake;   // command
};

// So that a failure is told by the vehicle's name.
void PrintTo(const Drive& drive, std::ostream* to) {
    *to << drive.vehicle;
}

class SimbodyComposed : public testing::TestWithParam<Drive> {
protected:
    static VehicleDescription vehicle() {
        return io::read_vehicle(test::source_path("vehicles/" + std::string(GetParam().vehicle) + ".toml"));
    }
    static ScenarioDescription scenario() {
        const Drive& drive = GetParam();
        ScenarioDescription s = test::scenario(duration, drive.speed);
        s.solver.integrator = "rk4";
        s.solver.step = std::getenv("OUR") ? std::atof(std::getenv("OUR")) : 5e-4;
        s.drive = test::table({0, 0.3, 1.2, 1.5}, {0, drive.torque, drive.torque, 0});
        s.brake = test::table({1.8, 2.2}, {0, drive.brake});
        s.steering_input = SteeringInput::rack;
        s.steering = test::table({0.2, 0.8, 1.6, 2.4}, {0, drive.rack, -drive.rack, 0.5 * drive.rack});
        return s;
    }

    SimbodyComposed() {
        simbody.set_inputs(inputs(0));
        simbody.set_state(oracle::state_of(simulation));
    }

    // Of chassis and trailers at their centers of mass, and at a point beside, which sees their angles as well.
    double gap() const {
        const Sample sample = simulation.sample();
        double largest = 0;
        for (std::size_t unit = 0; unit <= simulation.vehicle().trailers.size(); ++unit) {
            Point point = unit == 0 ? simulation.vehicle().chassis.center_of_mass
                                    : simulation.vehicle().trailers[unit - 1].chassis.center_of_mass;
            for (const double beside : {0.0, 1.0}) {
                for (double& x : point) x += beside;
                const std::array<double, 3> there = simbody.ground_point(unit, point);
                const Vec3<double> here = oracle::ground_point(sample, unit, point);
                largest = std::max(largest, (here - Vec3<double>(there.data())).norm());
            }
        }
        return largest;
    }

    Simulation simulation{vehicle(), scenario()};
    oracle::SimbodyCar simbody{simulation.vehicle(), {}};
    std::function<oracle::Inputs(double)> inputs = oracle::inputs_of(simulation);
};

TEST_P(SimbodyComposed, TakesTheSamePath) {
    const double oracle_step = std::getenv("THEIR") ? std::atof(std::getenv("THEIR")) : 1e-3, look_every = 0.1;
    const long our_steps = std::lround(look_every / simulation.scenario().solver.step);
    double largest = gap();
    while (!simulation.finished()) {
        simbody.advance(simulation.time(), oracle_step, static_cast<int>(std::lround(look_every / oracle_step)),
                        inputs);
        for (long i = 0; i < our_steps; ++i) {
            if (const auto end = simulation.advance()) FAIL() << end->message;
        }
        largest = std::max(largest, gap()); if (std::getenv("SHOW")) std::printf("%.1f %.2e\n", simulation.time(), gap());
    }
    RecordProperty("largest_path_gap_m", std::to_string(largest));
    std::printf("largest gap: %.2e m\n", largest);
    EXPECT_LT(largest, path_tolerance);
    EXPECT_LT(simbody.worst_constraint_error(), 1e-10);
    const Sample sample = simulation.sample();
    EXPECT_GT(std::abs(sample.velocity.hub[5]), 0.01) << "a car that does not turn shows little";
}

INSTANTIATE_TEST_SUITE_P(Vehicles, SimbodyComposed,
                         testing::Values(Drive{"bmw_e21_320i", 15, 0.005, 500, 0.15},
                                         Drive{"bmw_e90_330i", 15, 0.005, 600, 0.15},
                                         Drive{"hatchback", 15, 0.005, 500, 0.15},
                                         Drive{"formula", 15, 0.005, 300, 0.15}, Drive{"pickup", 15, 0.005, 800, 0.15},
                                         Drive{"offroader", 12, 0.008, 800, 0.15},
                                         Drive{"truck_semitrailer", 12, 0.015, 6000, 0.15}),
                         [](const auto& drive) { return std::string(drive.param.vehicle); });

}  // namespace
}  // namespace hamilcar
