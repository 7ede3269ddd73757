// Active anti-roll bars: soft on a straight road, where a stiff bar would carry the bumps of one side to the other, and as stiff as
// asked for in turns (docs/controllers/active_anti_roll.md). Front and rear share the stiffness, which sets the balance of the car.
#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

namespace {

constexpr double turn_time = 0.1;  // of the filter that tells a turn from bumps [s]

constexpr double straight = 0.5;  // lateral acceleration up to which a road is straight, whatever its bumps [m/s^2]

struct AntiRollMemory {
    double turning = 0;  // lateral acceleration, lagged [m/s^2]
    double activity = 0;
};

class ActiveAntiRoll final : public Controller {
public:
    ActiveAntiRoll(const ControllerSettings& settings, const ControlledCar& car)
        : car_(car),
          stiffness_(settings["stiffness_N_per_m"]),
          damping_(settings["damping_N_s_per_m"]),
          front_share_(settings["front_share"]),
          full_turn_(settings["full_from_m_per_s2"]) {}

    std::size_t memory_size() const override { return numbers_of<AntiRollMemory>(); }
    double activity(std::span<const double> memory) const override {
        return read_memory<AntiRollMemory>(memory).activity;
    }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override {
        auto state = read_memory<AntiRollMemory>(memory);
        const double lateral = std::abs(measured.acceleration[1]);
        state.turning += (lateral - state.turning) * std::min(measured.interval / turn_time, 1.0);
        const double share = std::clamp((state.turning - straight) / (full_turn_ - straight), 0.0, 1.0);
        double used = 0, count = 0;
        for (std::size_t i = 0; i < car_.bars.size(); ++i) {
            if (!commands.has_bar(i)) continue;
            const ControlledBar& bar = car_.bars[i];
            const double part = car_.wheels[bar.left].x > 0 ? front_share_ : 1 - front_share_;
            const double twist = measured.travel[bar.left] - measured.travel[bar.right];
            const double twisting = measured.travel_speed[bar.left] - measured.travel_speed[bar.right];
            // A bar pushes down the wheel that stands higher.
            const double force = share * part * (stiffness_ * twist + damping_ * twisting);
            commands.bar(i) = std::clamp(force / bar.max_force, -1.0, 1.0);
            used += std::abs(commands.bar(i)), ++count;
        }
        state.activity = used / std::max(count, 1.0);
        write_memory(state, memory);
    }

private:
    ControlledCar car_;
    double stiffness_, damping_, front_share_, full_turn_;
};

}  // namespace

ControllerKind active_anti_roll() {
    return {
        .keyword = "active_anti_roll",
        .meaning = "active anti-roll bars: soft straight ahead, stiff in turns",
        .keys = {{"stiffness_N_per_m", "of all bars together, of the difference of the wheels' travels", 60e3, 0, 1e6},
                 {"damping_N_s_per_m", "likewise, of the difference of their speeds", 2e3, 0, 1e5},
                 {"front_share", "of both that the bars in front have", 0.6, 0, 1},
                 {"full_from_m_per_s2", "lateral acceleration from which on they act in full", 2, 1, 10}},
        .lacks = [](const VehicleDescription& vehicle) -> std::string {
            const bool has = std::ranges::any_of(vehicle.anti_roll_bars,
                                                 [](const AntiRollBarDescription& bar) { return bar.max_force > 0; });
            return has ? "" : "an [axle.anti_roll_bar.actuator]";
        },
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<ActiveAntiRoll>(settings, car);
        }};
}

}  // namespace hamilcar
