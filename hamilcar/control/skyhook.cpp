// Semi-active dampers that hold the body as if they hung in the sky (Karnopp, Crosby and Harwood 1974): a damper can only oppose the
// motion between body and wheel, so it is firm where that slows the body down, and soft where it would push it on
// (docs/controllers/skyhook.md).
#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

namespace {

constexpr double forgetting_time = 0.5;  // of the heave, an integral: below 0.3 Hz it is forgotten [s]
constexpr double offset_time = 2;  // in which the accelerometer's mean, by weight, slopes and turns, is forgotten [s]
constexpr double least_speed = 0.01;  // of a damper, below which its ratio of speeds means nothing [m/s]

struct SkyhookMemory {
    double offset = 0, heave = 0;  // mean acceleration [m/s^2]; speed of the body upward [m/s]
    double begun = 0, activity = 0;
};

class Skyhook final : public Controller {
public:
    Skyhook(const ControllerSettings& settings, const ControlledCar& car)
        : car_(car), sky_(settings["sky_damping"]), ground_(settings["least_damping"]) {}

    std::size_t memory_size() const override { return numbers_of<SkyhookMemory>(); }
    double activity(std::span<const double> memory) const override {
        return read_memory<SkyhookMemory>(memory).activity;
    }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override {
        auto state = read_memory<SkyhookMemory>(memory);
        const double up = measured.acceleration[2], dt = measured.interval;
        if (state.begun == 0) state.begun = 1, state.offset = up;
        state.offset += (up - state.offset) * std::min(dt / offset_time, 1.0);
        state.heave += (up - state.offset) * dt - state.heave * std::min(dt / forgetting_time, 1.0);
        double used = 0, count = 0;
        for (std::size_t i = 0; i < car_.wheels.size(); ++i) {
            const ControlledWheel& wheel = car_.wheels[i];
            if (!commands.has_damper(i) || wheel.unit != 0) continue;  // what shakes a trailer is not measured
            const double body = state.heave + measured.angular_rate[0] * wheel.y - measured.angular_rate[1] * wheel.x;
            const double apart = -measured.travel_speed[i];
            const double share = share_for(body, apart);
            const double setting = (share - wheel.damper_soft) / (wheel.damper_firm - wheel.damper_soft);
            commands.damper(i) = std::clamp(setting, 0.0, 1.0);
            const double rest = (1 - wheel.damper_soft) / (wheel.damper_firm - wheel.damper_soft);
            used += std::abs(commands.damper(i) - rest) / std::max(rest, 1 - rest), ++count;
        }
        state.activity = used / std::max(count, 1.0);
        write_memory(state, memory);
    }

private:
    // Of the damper's own force that is wanted, for the speeds of the body and of body and wheel apart.
    double share_for(double body, double apart) const {
        if (std::abs(apart) < least_speed) return 1;
        return std::max(ground_, sky_ * body / apart);
    }

    ControlledCar car_;
    double sky_, ground_;
};

}  // namespace

ControllerKind skyhook() {
    return {
        .keyword = "skyhook",
        .meaning = "semi-active dampers: firm where that calms the body",
        .keys = {{"sky_damping", "between the body and the sky, over what the damper itself has", 4, 0, 10},
                 {"least_damping", "share of the damper's own that always acts, for the wheel", 0.4, 0, 2}},
        .lacks = [](const VehicleDescription& vehicle) -> std::string {
            for (const SuspensionDescription& suspension : vehicle.suspensions) {
                for (const auto& one : suspension.dampers) {
                    if (one.damper.is_adjustable()) return "";
                }
            }
            return "an [axle.damper.adjustable]";
        },
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<Skyhook>(settings, car);
        }};
}

}  // namespace hamilcar
