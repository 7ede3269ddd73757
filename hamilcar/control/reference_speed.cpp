// Each way of driving has wheels that cannot be on one side of the speed: braked ones are not faster, driven ones not slower. To that
// side the estimate follows them quickly, to the other one only as fast as the accelerometer says and a margin. Undriven
// wheels without brake pressure are believed in both directions, and show meanwhile how much weight the accelerometer feels.
#include "hamilcar/control/reference_speed.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

namespace {

// Of the accelerometer while no wheel confirms the speed: it adds weight when the body pitches, some 3 % at one degree to 0.6 g, and
// centripetal acceleration when the car slides sideways [m/s^2], [1].
constexpr double margin = 0.2, relative_margin = 0.04;
// Grows when confirmation is long overdue, so that a wrong estimate cannot last [m/s^3], [s]. Less
// where all wheels are driven: those that spin on ice would pull it up.
constexpr double margin_growth = 2, margin_growth_driven = 0.3, overdue = 0.7;
// Toward wheels that are right on their side of the speed: faster than any car's speed changes, slower than a disturbed signal [m/s^2].
constexpr double trusted = 20;
// Toward the slowest of driven wheels: on ice it is slower than the ground for a moment when the throttle closes [m/s^2].
constexpr double trusted_driven = 1.5;
constexpr double grade_time = 1;       // of the filter that finds the weight [s]
constexpr double max_grade = 4;        // a slope of 40 % [m/s^2]
constexpr double motion_time = 0.008;  // of the filter of treads' accelerations, against noise of speed sensors [s]
constexpr double creeping = 0.3;       // slower than that a car whose wheels stand is believed to stand [m/s]
constexpr double no_pressure = .01;    // of full pressure: the brake does not touch
constexpr double pressed = .01;        // of a pedal's travel

SineCosine<double> heading(const ControlledCar& car, const Measured& measured, const ControlledWheel& wheel) {
    if (!wheel.steered) return {.sine = 0, .cosine = 1};
    return sincos(measured.steering_wheel * car.wheels_per_angle);
}

// Lateral speed of a wheel, as if the rearmost axle had no sideslip [m/s].
double lateral_speed(const ControlledCar& car, const Measured& measured, const ControlledWheel& wheel) {
    return measured.angular_rate[2] * (wheel.x + car.wheelbase - car.center_behind);
}

// Speed of the motor vehicle if the wheel rolls without slip [m/s].
double speed_by(const ControlledCar& car, const Measured& measured, std::size_t index) {
    const ControlledWheel& wheel = car.wheels[index];
    const SineCosine<double> turned = heading(car, measured, wheel);
    const double along = tread_speed(car, measured, index) - lateral_speed(car, measured, wheel) * turned.sine;
    return along / turned.cosine + measured.angular_rate[2] * wheel.y;
}

// By the driver, or by a controller that brakes more than single wheels.
bool is_braked(const ControlledCar& car, const Measured& measured) {
    const double least = no_pressure * car.full_pressure;
    std::size_t pressed_wheels = 0;
    for (const double pressure : measured.brake_pressure) pressed_wheels += pressure > least ? 1 : 0;
    return measured.brake > pressed || measured.control_pressure > least || 2 * pressed_wheels > car.wheels.size();
}

// A wheel without pressure while the driver brakes is one that an anti-lock system has just released: it may still be slow.
bool is_free(const ControlledCar& car, const Measured& measured, std::size_t wheel, bool braked) {
    if (car.wheels[wheel].brake_torque <= 0) return true;
    return !braked && measured.brake_pressure[wheel] <= no_pressure * car.full_pressure;
}

// What wheels say of the speed, and on which sides of it they can be trusted.
struct Evidence {
    double speed = 0;                         // [m/s]
    bool not_less = false, not_more = false;  // the car is not slower, not faster than that
    bool easy = false;                        // no wheel is driven or braked, or those that are do not count
};

Evidence evidence(const ControlledCar& car, const Measured& measured) {
    double rolling = -1e9, fastest = -1e9, slowest = 1e9;
    const bool braked = is_braked(car, measured), driven = measured.throttle > pressed;
    for (std::size_t i = 0; i < car.wheels.size(); ++i) {
        const double speed = speed_by(car, measured, i);
        fastest = std::max(fastest, speed);
        if (!is_free(car, measured, i, braked)) continue;
        slowest = std::min(slowest, speed);
        if (!car.wheels[i].driven) rolling = std::max(rolling, speed);
    }
    if (rolling > -1e9) return {rolling, true, true, true};
    if (!braked && driven && slowest < 1e9) return {slowest, false, true, false};
    return {fastest, !driven, false, !driven && !braked};
}

}  // namespace

void update_speed(ReferenceSpeed& reference, const ControlledCar& car, const Measured& measured) {
    const Evidence wheels = evidence(car, measured);
    const double shown = measured.acceleration[0], interval = measured.interval;
    if (reference.known == 0) {
        reference = {.known = 1, .speed = std::max(wheels.speed, 0.)};
        return;
    }
    reference.acceleration = shown - reference.grade;
    const double growth = wheels.not_less ? margin_growth : margin_growth_driven;
    const double doubt =
        margin + relative_margin * std::abs(reference.acceleration) + growth * std::max(reference.unseen - overdue, 0.);
    const double drop = wheels.easy ? trusted : wheels.not_more ? trusted_driven : doubt;
    // A car whose wheels stand does not begin to slide by what an accelerometer feels on a slope.
    const bool at_rest = reference.speed < creeping && std::abs(wheels.speed) < creeping;
    const double lowest = at_rest ? 0 : reference.speed + (reference.acceleration - drop) * interval;
    const double highest = reference.speed + (reference.acceleration + (wheels.not_less ? trusted : doubt)) * interval;
    const double rolled = std::max(wheels.speed, 0.);
    const double speed = std::max(std::clamp(rolled, lowest, highest), 0.);
    const bool confirmed = speed == rolled;
    reference.unseen = confirmed ? 0 : reference.unseen + interval;
    const bool stands = speed == 0 && reference.speed == 0;
    if (confirmed && (wheels.easy || stands) && interval > 0) {
        const double weight = shown - (speed - reference.speed) / interval;
        const double share = std::min(interval / grade_time, 1.);
        reference.grade = std::clamp(reference.grade + (weight - reference.grade) * share, -max_grade, max_grade);
    }
    reference.speed = speed;
}

double tread_speed(const ControlledCar& car, const Measured& measured, std::size_t wheel) {
    return measured.wheel_speed[wheel] * car.wheels[wheel].radius;
}

double ground_speed(const ReferenceSpeed& reference, const ControlledCar& car, const Measured& measured,
                    std::size_t index) {
    const ControlledWheel& wheel = car.wheels[index];
    const SineCosine<double> turned = heading(car, measured, wheel);
    const double forward = reference.speed - measured.angular_rate[2] * wheel.y;
    return forward * turned.cosine + lateral_speed(car, measured, wheel) * turned.sine;
}

double wheel_slip(const ReferenceSpeed& reference, const ControlledCar& car, const Measured& measured,
                  std::size_t wheel) {
    const double ground = ground_speed(reference, car, measured, wheel);
    return (tread_speed(car, measured, wheel) - ground) / std::max(ground, 1.);
}

void update_motion(TreadMotion& motion, const ControlledCar& car, const Measured& measured, std::size_t wheel) {
    const double speed = tread_speed(car, measured, wheel), interval = measured.interval;
    if (motion.known > 0 && interval > 0) {
        const double share = interval / (interval + motion_time);
        motion.acceleration += share * ((speed - motion.speed) / interval - motion.acceleration);
    }
    motion.speed = speed;
    motion.known = 1;
}

bool on_one_axle(const ControlledWheel& a, const ControlledWheel& b) {
    return a.unit == b.unit && std::abs(a.x - b.x) < 0.5 * a.radius;
}

}  // namespace hamilcar
