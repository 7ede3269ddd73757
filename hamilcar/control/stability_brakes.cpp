// Brake force at y turns a car by force times y. Wheels of one side and end share the moment by their loads; whether the tires can
// transmit it shows in their slip, which is limited.
#include "hamilcar/control/stability_brakes.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

// Brake force over load: of trailers, and against rolling over. In front it also turns the vehicle in less, in the rear too much of
// it would let it slide out.
constexpr double trailer_slowing = 0.4, front_slowing = 0.8, rear_slowing = 0.2;
constexpr double build_band = 0.05;  // error of pressure, over the full one, from which on the pump gives all it can
constexpr double hold_band = 0.015;  // below it the pressure is held: some times what a sensor is off
constexpr double near_limit = 0.8;   // of the largest slip, from which on pressure does not grow

}  // namespace

StabilityBrakes::StabilityBrakes(const ControlledCar& car, double slip) : car_(car), slip_(slip) {
    for (const ControlledWheel& wheel : car.wheels) {
        if (wheel.unit > 0 || wheel.brake_torque <= 0) continue;
        (wheel.x > 0 ? front_moments_ : rear_moments_) += 0.5 * wheel.static_load * std::abs(wheel.y);
    }
}

// That brakes a wheel with a force [Pa].
double StabilityBrakes::pressure(const ControlledWheel& wheel, double force) const {
    return std::min(force * wheel.radius / wheel.brake_torque, 1.0) * car_.full_pressure;
}

// That a wheel shall have; the driver's where nothing is wanted of it [Pa].
double StabilityBrakes::target(const ControlledWheel& wheel, const StabilityRequest& request,
                               double control_pressure) const {
    if (wheel.unit > 0) {  // a trailer that brakes pulls the combination straight
        const double share = std::min(std::max(std::abs(request.turn) / full_turn, request.slow), 1.0);
        return std::max(control_pressure, pressure(wheel, share * trailer_slowing * wheel.static_load));
    }
    // Where the driver brakes, less at the side that turns the car further, measured by what friction may carry.
    if (request.turn * wheel.y < 0) {
        const double share = std::max(1 - std::abs(request.turn) / full_turn, 0.0);
        return std::min(control_pressure, share * pressure(wheel, wheel.static_load));
    }
    const bool front = wheel.x > 0;
    const double turn = front ? request.turn : request.turn_in, moments = front ? front_moments_ : rear_moments_;
    const double share = turn * wheel.y > 0 ? std::abs(turn) * car_.yaw_inertia / moments : 0;
    const double slow = request.slow * (front ? front_slowing : rear_slowing);
    return std::max(control_pressure, pressure(wheel, (share + slow) * wheel.static_load));
}

// Slip over the largest that a wheel may have. In front that is as much along as across: the force of a sliding tire opposes its
// sliding, so the more it slides along, the more it brakes and the less it turns the car in. In the rear it is half of the setting,
// for the lateral force there keeps the car stable.
double StabilityBrakes::slip_share(const StabilityMotion& motion, const Measured& measured, std::size_t index) const {
    const ControlledWheel& wheel = car_.wheels[index];
    if (wheel.unit > 0) return -wheel_slip(motion.reference, car_, measured, index) / slip_;
    const double rate = measured.angular_rate[2], speed = motion.reference.speed;
    const double forward = speed - rate * wheel.y, left = speed * std::tan(motion.sideslip) + rate * wheel.x;
    const double angle = wheel.steered ? measured.steering_wheel * car_.wheels_per_angle : 0;
    const double along = std::max(forward * std::cos(angle) + left * std::sin(angle), 1.0);
    const double across = left * std::cos(angle) - forward * std::sin(angle);
    const double largest = wheel.x > 0 ? slip_ + std::abs(across) / along : 0.5 * slip_;
    return (1 - tread_speed(car_, measured, index) / along) / largest;
}

double StabilityBrakes::drivers_moment(const Measured& measured, std::span<const double> left) const {
    double sum = 0;
    for (std::size_t i = 0; i < car_.wheels.size(); ++i) {
        const ControlledWheel& wheel = car_.wheels[i];
        if (wheel.unit > 0 || wheel.brake_torque <= 0 || left[i] > 0) continue;
        const double shown = std::min(measured.brake_pressure[i], measured.control_pressure);
        sum += wheel.y * shown / car_.full_pressure * wheel.brake_torque / wheel.radius;
    }
    return sum;
}

void StabilityBrakes::approach(double target, double slip_share, const Measured& measured, std::size_t wheel,
                               const BrakeValves& valves) const {
    const double full = car_.full_pressure, shown = measured.brake_pressure[wheel], error = target - shown;
    if (slip_share > 1) {
        valves.release();
    } else if (error < -hold_band * full) {
        valves.release();
        valves.outlet = std::min(-error / shown, 1.0);
    } else if (error > hold_band * full && target > measured.control_pressure && slip_share < near_limit) {
        valves.build(std::min(error / (build_band * full), 1.0));
    } else {
        valves.hold();
    }
}

void StabilityBrakes::act(const StabilityRequest& request, const StabilityMotion& motion, const Measured& measured,
                          std::span<double> left, const Commands& commands) const {
    const double band = hold_band * car_.full_pressure, driver = measured.control_pressure;
    for (std::size_t i = 0; i < car_.wheels.size(); ++i) {
        if (!commands.has_valves(i)) continue;
        const BrakeValves valves = commands.valves(i);
        const auto state = [&] { return 2 + valves.pump - valves.outlet; };
        const bool others = valves.inlet < 1 && state() != left[i];
        const bool own = left[i] > 0 && !others;
        const double wanted = target(car_.wheels[i], request, driver);
        left[i] = 0;
        if (std::abs(wanted - driver) <= band) {
            if (own) valves.rest();
            continue;
        }
        // Where the driver brakes, a wheel that an anti-lock system holds gets less at most.
        if (others && driver > band && measured.brake_pressure[i] < wanted + band) continue;
        approach(wanted, slip_share(motion, measured, i), measured, i, valves);
        left[i] = state();
    }
}

}  // namespace hamilcar
