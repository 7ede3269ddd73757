#include "hamilcar/live/handled_car.hpp"

#include <cmath>
#include <numbers>

#include "hamilcar/analysis/wheel_motion.hpp"
#include "hamilcar/block/road_wheels.hpp"

namespace hamilcar::live {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double usual_lock = 1.25 * turn;  // where a vehicle file does not say how far the rack goes [rad]
constexpr double some_steer = 1e-3;         // a wheel that turns less per rack is not steered [rad/m]

struct Mean {
    double sum = 0, weight = 0;
    void add(double value, double share = 1) { sum += share * value, weight += share; }
    double value(double otherwise) const { return weight > 0 ? sum / weight : otherwise; }
};

// Steered and other wheels of the motor vehicle: turn per rack, and the places along x of either.
struct SteeredWheels {
    Mean steer, steered_x, fixed_x;
};

SteeredWheels steered_wheels(const Simulation& simulation) {
    const auto motions = wheel_motions(simulation.vehicle(), simulation.model(), simulation.state(), 0);
    SteeredWheels out;
    std::size_t i = 0;
    for_each_wheel(simulation.vehicle(), [&](const auto&, std::size_t unit) {
        const WheelMotion& motion = motions[i++];
        if (unit != 0) return;
        const double steer = motion.steer[5];
        const bool steered = std::abs(steer) > some_steer;
        (steered ? out.steered_x : out.fixed_x).add(motion.design_center[0]);
        if (steered) out.steer.add(steer);
    });
    return out;
}

double driven_radius(const Simulation& simulation) {
    const Vehicle<double>& vehicle = simulation.model().vehicle;
    Mean radius;
    for (const Spoke<double>& spoke : vehicle.spokes) radius.add(rolling_radius(spoke.tire), spoke.drive_share);
    for (const ComposedSpoke<double>& spoke : vehicle.composed) {
        for (const auto& wheel : spoke.wheels) radius.add(rolling_radius(wheel.tire), wheel.drive_share);
    }
    return radius.value(0);
}

}  // namespace

HandledCar handled_car(const Simulation& simulation) {
    const SteeringDescription& steering = simulation.vehicle().steering;
    HandledCar car{.mass = simulation.model().vehicle.total_mass, .wheel_radius = driven_radius(simulation)};
    const SteeredWheels wheels = steered_wheels(simulation);
    if (steering.rack_per_revolution <= 0 || wheels.steer.weight == 0) return car;
    const double rack_per_angle = steering.rack_per_revolution / turn, steer = wheels.steer.value(0);
    car.lock = steering.rack_travel > 0 ? steering.rack_travel / rack_per_angle : usual_lock;
    car.rack_per_angle = std::copysign(rack_per_angle, steer);
    car.wheels_per_angle = std::abs(steer) * rack_per_angle;
    const double wheelbase = std::abs(wheels.steered_x.value(0) - wheels.fixed_x.value(0));
    if (wheelbase > 0) car.wheelbase = wheelbase;
    return car;
}

Felt feel(const VehicleDescription& vehicle, const Sample& sample) {
    Mean spin;
    for (std::size_t i = 0; i < vehicle.corners.size(); ++i) {
        spin.add(sample.momenta.spokes[i].forces.spin, vehicle.corners[i].drive_share);
    }
    for (std::size_t s = 0; s < vehicle.composed.size(); ++s) {
        const auto& wheels = vehicle.composed[s].wheels;
        for (std::size_t w = 0; w < wheels.size(); ++w) {
            spin.add(sample.momenta.composed.spokes[s].wheels[w].spin, wheels[w].drive_share);
        }
    }
    return {.speed = sample.velocity.hub[0], .spin = spin.value(0)};
}

}  // namespace hamilcar::live
