// Rear steer: the wheels of an axle with an actuator turn by a share of the angle of the steered wheels in front: against them at low
// speed, for a small turning circle, with them at high speed, so that the car goes sideways with less yaw
// (docs/controllers/rear_steer.md).
//
//     share(v) = low (1 - w) + high w,   w / (1 - w) = -low / high (v / neutral)^2         0 at the neutral speed
#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

namespace {

struct RearSteerMemory {
    ReferenceSpeed reference;
    double activity = 0;
};

class RearSteer final : public Controller {
public:
    RearSteer(const ControllerSettings& settings, const ControlledCar& car)
        : car_(car),
          low_(settings["share_at_rest"]),
          high_(settings["share_at_high_speed"]),
          neutral_speed_(settings["neutral_speed_m_per_s"]) {}

    std::size_t memory_size() const override { return numbers_of<RearSteerMemory>(); }
    double activity(std::span<const double> memory) const override {
        return read_memory<RearSteerMemory>(memory).activity;
    }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override {
        auto state = read_memory<RearSteerMemory>(memory);
        update_speed(state.reference, car_, measured);
        const double front = measured.steering_wheel * car_.wheels_per_angle;
        const double angle = share(state.reference.speed) * front;
        state.activity = 0;
        for (std::size_t i = 0; i < car_.steers.size(); ++i) {
            if (car_.steers[i].x > 0 || car_.steers[i].angle == 0) continue;
            commands.axle_steer(i) = std::clamp(angle / car_.steers[i].angle, -1.0, 1.0);
            state.activity = std::max(state.activity, std::abs(commands.axle_steer(i)));
        }
        write_memory(state, memory);
    }

private:
    double share(double speed) const {
        const double relative = speed / neutral_speed_, odds = -low_ * relative * relative;  // times 1 / high
        return low_ + (high_ - low_) * odds / (odds + high_);
    }

    ControlledCar car_;
    double low_, high_, neutral_speed_;
};

std::string lacks(const VehicleDescription& vehicle) {
    if (vehicle.steering.rack_per_revolution <= 0) return "a steering wheel";
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        const double x = suspension.wheels[0].wheel.center[0];
        if (suspension.steered_by && x < vehicle.chassis.center_of_mass[0]) return "";
    }
    return "an [axle.steering_actuator] behind the center of mass";
}

}  // namespace

ControllerKind rear_steer() {
    return {
        .keyword = "rear_steer",
        .meaning = "rear wheels turn against the front ones at low speed and with them at high speed",
        .keys = {{"share_at_rest", "of the front wheels' angle, while the car stands", -0.3, -1, -0.01},
                 {"share_at_high_speed", "of the front wheels' angle, far above the neutral speed", 0.2, 0.01, 1},
                 {"neutral_speed_m_per_s", "at which the rear wheels stay straight", 16, 1, 100}},
        .lacks = lacks,
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<RearSteer>(settings, car);
        }};
}

}  // namespace hamilcar
