// Electronic stability control: where the car turns more than its driver asks for, the brake of the outer front wheel turns it back;
// where it turns less, that of the inner rear wheel turns it in and the engine gives way. What the driver asks for is what a single
// track does in steady turns, with as much friction as the car has shown (docs/controllers/stability_control.md).
#include <algorithm>
#include <cmath>
#include <utility>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/stability_brakes.hpp"

namespace hamilcar {

namespace {

constexpr double gravity = 9.80665;        // also the largest lateral acceleration that a turn may ask for [m/s^2]
constexpr double least_speed = 5;          // FMVSS 126 asks for control from 20 km/h on [m/s]
constexpr double response_time = 0.15;     // of yaw rate to steering; cars take 0.15 to 0.25 s at 80 km/h [s]
constexpr double stiffness_per_load = 15;  // of cornering, of usual tires: 12 to 20 [1/rad]
constexpr double friction_time = 0.5;      // in which a turn shows what friction there is [s]
constexpr double least_friction = 1.5;     // that is believed, of ice [m/s^2]
constexpr double friction_reserve = 1.05;  // of what is shown: not all axles are at their limit [1]
constexpr double forgetting_time = 1.5;    // of sideslip, which is an integral of sensors and their offsets [s]
constexpr double sliding_time = 8;         // the same while the car slides [s]
constexpr double share_of_rate = 0.3;      // of the yaw rate itself that is let be in addition to the threshold
constexpr double largest_sideslip = 1;     // that is believed [rad]
constexpr double sideslip_gain = 2;        // excess of yaw rate that an excess of sideslip counts as [1/s]
constexpr double understeer_time = 0.3;    // longer than a driver's quick turn of the wheel [s]
constexpr double full_understeer = 0.2;    // yaw rate missing at which the throttle is closed [rad/s]
constexpr double throttle_return = 0.5;    // of the limit, after an intervention [1/s]
constexpr double roll_time = 0.1;          // that the lateral acceleration is looked ahead [s]
constexpr double roll_band = 0.15;         // beyond the acceleration to brake at, to full braking [1]

struct StabilityMemory {
    StabilityMotion motion;
    double asked = 0;         // yaw rate by the steering angle, lagged [rad/s]
    double lacking = 0;       // of lateral acceleration to 1 g, by what the car has shown [m/s^2]
    double acts = 0;          // 1 while the car turns too much
    double missing = 0;       // yaw rate beyond the threshold that the car turns too little, lagged [rad/s]
    double lateral = 0;       // size of the lateral acceleration, lagged [m/s^2]
    double throttle_cut = 0;  // below 1 [1]
    double written = 0;       // the same of the limit that this controller wrote last; 0: another one's is lower
    double strength = 0;      // of the intervention [1]
};

double toward(double from, double to, double share) {
    return from + (to - from) * std::min(share, 1.0);
}

class StabilityControl final : public Controller {
public:
    StabilityControl(const ControllerSettings& settings, const ControlledCar& car)
        : car_(car),
          characteristic_speed_(settings["characteristic_speed_m_per_s"]),
          threshold_(settings["threshold_deg_per_s"]),
          sideslip_(settings["sideslip_deg"]),
          gain_(settings["gain_per_s"]),
          rollover_(settings["rollover_acceleration_m_per_s2"]),
          brakes_(car, settings["slip"]) {}

    std::size_t memory_size() const override { return numbers_of<StabilityMemory>() + car_.wheels.size(); }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override;
    double activity(std::span<const double> memory) const override {
        return read_memory<StabilityMemory>(memory).strength;
    }

private:
    double steering(const Measured& measured, std::span<const double> left) const;
    double possible(StabilityMemory& state, const Measured& measured) const;
    double excess(StabilityMemory& state, double angle, const Measured& measured) const;
    double understeer(StabilityMemory& state, const Measured& measured) const;
    double rollover(StabilityMemory& state, const Measured& measured) const;
    void limit_throttle(StabilityMemory& state, const Measured& measured, const Commands& commands) const;

    ControlledCar car_;
    double characteristic_speed_, threshold_, sideslip_, gain_, rollover_;
    StabilityBrakes brakes_;
};

// Of the steered wheels, without what holds the car against brakes of which one side pulls more [rad].
double StabilityControl::steering(const Measured& measured, std::span<const double> left) const {
    const double angle = measured.steering_wheel * car_.wheels_per_angle;
    const double load = car_.mass * gravity, moment = brakes_.drivers_moment(measured, left);
    const double balance = -moment * 4 / (load * stiffness_per_load * car_.wheelbase);
    return angle - std::clamp(balance, std::min(angle, 0.0), std::max(angle, 0.0));
}

// The largest lateral acceleration that friction allows, as far as the car has shown: it does less than it is asked to [m/s^2].
double StabilityControl::possible(StabilityMemory& state, const Measured& measured) const {
    const double v = state.motion.reference.speed, lateral = friction_reserve * std::abs(measured.acceleration[1]);
    const bool short_of = std::abs(state.asked) * v > lateral + threshold_ * v;
    const double lacking = short_of ? std::max(gravity - std::max(lateral, least_friction), 0.0) : 0;
    const bool at_once = short_of && lacking < state.lacking;
    state.lacking = toward(state.lacking, lacking, at_once ? 1 : measured.interval / friction_time);
    return gravity - state.lacking;
}

// How much more than asked for the car turns, beyond what is let be; positive to the left [rad/s].
double StabilityControl::excess(StabilityMemory& state, double angle, const Measured& measured) const {
    const double v = state.motion.reference.speed, interval = measured.interval;
    const double rate = measured.angular_rate[2], lateral = measured.acceleration[1], side = rate < 0 ? -1 : 1;
    const double relative = v / characteristic_speed_, neutral = 1 + relative * relative;
    const double asked = v * angle / (car_.wheelbase * neutral);
    state.asked = toward(state.asked, asked, interval / response_time);

    // One that understeers less than expected turns as its path does.
    const auto allowed_by = [&](double yaw_rate) {
        return std::clamp(side * lateral / v, yaw_rate, std::max(yaw_rate, yaw_rate * neutral));
    };
    // A car may answer at once or after its response time.
    const double answer = std::max(allowed_by(side * asked), allowed_by(side * state.asked));
    const double allowed = std::min(answer, possible(state, measured) / v);

    double& sideslip = state.motion.sideslip;
    sideslip += (lateral / v - rate) * interval;
    sideslip = toward(sideslip, 0, interval / (state.acts > 0 ? sliding_time : forgetting_time));
    sideslip = std::clamp(sideslip, -largest_sideslip, largest_sideslip);
    const double sliding = std::max(-side * sideslip - sideslip_, 0.0);  // its nose points into the turn

    const double excess = std::abs(rate) - allowed + sideslip_gain * sliding;
    const double threshold = threshold_ + share_of_rate * std::max(allowed, 0.0);
    if (excess > threshold) state.acts = 1;
    if (excess < 0.5 * threshold) state.acts = 0;
    return state.acts > 0 ? side * (excess - 0.5 * threshold) : 0;
}

// How much less than asked for it turns, of which friction of 1 g would be capable; positive to the left [rad/s].
double StabilityControl::understeer(StabilityMemory& state, const Measured& measured) const {
    const double most = gravity / state.motion.reference.speed, asked = std::clamp(state.asked, -most, most);
    const double side = asked < 0 ? -1 : 1;
    const double missing = side * (asked - measured.angular_rate[2]) - threshold_ - share_of_rate * std::abs(asked);
    state.missing = toward(state.missing, missing, measured.interval / understeer_time);
    if (state.acts > 0 || std::abs(state.motion.sideslip) > sideslip_) state.missing = std::min(state.missing, 0.0);
    return side * std::max(state.missing, 0.0);
}

// From 0 to 1, by the lateral acceleration to come: what it is and what it has grown by lately.
double StabilityControl::rollover(StabilityMemory& state, const Measured& measured) const {
    const double lateral = std::abs(measured.acceleration[1]);
    state.lateral = toward(state.lateral, lateral, measured.interval / roll_time);
    if (rollover_ <= 0) return 0;
    const double soon = lateral + std::max(lateral - state.lateral, 0.0);
    return std::clamp((soon / rollover_ - 1) / roll_band, 0.0, 1.0);
}

// What another controller wants at the same time stays the most.
void StabilityControl::limit_throttle(StabilityMemory& state, const Measured& measured,
                                      const Commands& commands) const {
    const double before = state.throttle_cut;
    state.throttle_cut = std::max(state.strength, before - throttle_return * measured.interval);
    if (before <= 0 && state.throttle_cut <= 0) return;
    const double own = 1 - state.throttle_cut, last = 1 - std::exchange(state.written, 0);
    for (std::size_t unit = 0; unit < car_.units.size(); ++unit) {
        double& limit = commands.max_throttle(unit);
        const double others = limit == last ? 1 : limit;
        if (own < others) state.written = state.throttle_cut;
        limit = std::min(own, others);
    }
}

void StabilityControl::decide(const Measured& measured, std::span<double> memory, const Commands& commands) const {
    auto state = read_memory<StabilityMemory>(memory);
    update_speed(state.motion.reference, car_, measured);
    const std::span<double> left = memory.subspan(numbers_of<StabilityMemory>());
    StabilityRequest request;
    if (state.motion.reference.speed < least_speed || measured.gear < 0) {
        StabilityMemory fresh;
        fresh.motion.reference = state.motion.reference;
        fresh.throttle_cut = state.throttle_cut, fresh.written = state.written;
        state = fresh;
    } else {
        request.turn = -gain_ * excess(state, steering(measured, left), measured);
        const double missing = understeer(state, measured);
        request.turn_in = gain_ * missing;
        request.slow = rollover(state, measured);
        const double back = std::abs(request.turn) / StabilityBrakes::full_turn;
        state.strength = std::min(std::max({back, std::abs(missing) / full_understeer, request.slow}), 1.0);
    }
    limit_throttle(state, measured, commands);
    brakes_.act(request, state.motion, measured, left, commands);
    write_memory(state, memory);
}

std::string lacks(const VehicleDescription& vehicle) {
    if (!vehicle.brakes.modulated) return "a brake system with valves at the wheels";
    return vehicle.steering.rack_per_revolution > 0 ? "" : "a steering wheel";
}

}  // namespace

ControllerKind stability_control() {
    return {
        .keyword = "esc",
        .meaning = "electronic stability control: brakes single wheels so that the car turns as it is steered",
        .keys = {{"characteristic_speed_m_per_s", "at which it needs twice the steering angle of a neutral car", 30, 10,
                  200},
                 {"threshold_deg_per_s", "yaw rate beyond the one asked for that is let be", 5, 0.5, 30},
                 {"sideslip_deg", "angle beyond which sideslip counts as turning too much", 5, 1, 30},
                 {"gain_per_s", "yaw acceleration wanted for each unit of yaw rate too much or too little", 10, 0, 100},
                 {"slip", "of a braked wheel that rolls straight, above which it is released", 0.2, 0.02, 0.9},
                 {"rollover_acceleration_m_per_s2", "lateral acceleration from which on all axles brake; 0: none", 0, 0,
                  20}},
        .lacks = lacks,
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<StabilityControl>(settings, car);
        }};
}

}  // namespace hamilcar
