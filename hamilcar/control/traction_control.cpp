// Traction control. Driven wheels may turn faster than the ground by a slip speed that grows with speed. Beyond it the throttle is
// limited, proportionally and integrally; and at low speed, where one wheel of an axle turns faster than the other, its brake
// takes the place of the friction that it lacks, so that the differential passes torque to the other one.
#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

namespace {

// Found by trial with an engine and a motor, tires that have a peak and tires that have none, on friction from 0.1 to 1.
constexpr double faster_share = 0.6;   // of the faster wheel of an axle in what the throttle is limited by
constexpr double braked_share = 0.3;   // likewise where its brake helps
constexpr double proportional = 0.08;  // throttle per slip speed beyond the allowed one [1/(m/s)]
constexpr double integral = 0.4;       // likewise, per time [1/m]
constexpr double lead = 0.2;           // how far ahead slip is foreseen: the torque follows the throttle late [s]
constexpr double return_growth = 0.2;  // time after which the throttle returns faster: friction may have risen [s]
constexpr double return_rate = 3;      // at most [1/s]
constexpr double spare = 0.1;          // above the pedal, where the limit is given back
constexpr double unsure = 0.5;         // time without a wheel that confirms the speed, in which slip stays allowed [s]
constexpr double apart = 0.5;          // difference of wheel speeds that corners and tires explain [m/s]
constexpr double brake_proportional = 0.03;  // of full pressure per slip speed beyond the allowed one [1/(m/s)]
constexpr double brake_integral = 0.3;       // likewise, per time [1/m]
constexpr double brake_return = 0.5;         // of full pressure per time, where the wheel does not slip [1/s]
constexpr double most_brake = 0.6;           // of full pressure
constexpr double least_pressure = 0.01;      // of full pressure: the brake does not touch
constexpr double fading = 0.7;               // of the brakes' speed limit, where the pressure begins to fade
constexpr double full_opening = 10;          // of a valve, for that change of pressure [full pressures per second]
constexpr double pressed = 0.01;             // of a pedal's travel

struct TractionMemory {
    ReferenceSpeed reference;
    double limiting;  // 1: the throttle's limit is this controller's
    double limit;     // integral part of it [1]
    double late;      // how long there has been no slip to limit [s]
    double activity;
};

// Slip speed beyond the allowed one, now and in a while [m/s].
struct Excess {
    double now, soon;
};

struct DrivenWheelMemory {
    TreadMotion tread;
    Excess excess;
    double pressure;  // integral part of the brake's pressure [Pa]
    double taken;     // 1: its valves are this controller's
};

class TractionControl final : public Controller {
public:
    TractionControl(const ControllerSettings& settings, const ControlledCar& car);

    std::size_t memory_size() const override { return place(wheels_); }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override;
    double activity(std::span<const double> memory) const override {
        return read_memory<TractionMemory>(memory).activity;
    }

private:
    std::size_t place(std::size_t number) const {
        return numbers_of<TractionMemory>() + number * numbers_of<DrivenWheelMemory>();
    }
    Excess observe(const ReferenceSpeed& reference, std::size_t wheel, const Measured& measured,
                   TreadMotion& tread) const;
    double limit_throttle(TractionMemory& state, const Excess& excess, const Measured& measured,
                          const Commands& commands) const;
    void brake(DrivenWheelMemory& own, std::size_t wheel, double excess, double most, const Measured& measured,
               const Commands& commands) const;

    ControlledCar car_;
    double slip_, slip_speed_, brake_speed_;
    std::vector<std::vector<std::size_t>> axles_;  // driven wheels of each
    std::size_t wheels_ = 0;                       // of all axles
};

TractionControl::TractionControl(const ControllerSettings& settings, const ControlledCar& car)
    : car_(car),
      slip_(settings["slip"]),
      slip_speed_(settings["slip_speed_m_per_s"]),
      brake_speed_(settings["brake_speed_m_per_s"]) {
    for (std::size_t i = 0; i < car_.wheels.size(); ++i) {
        if (!car_.wheels[i].driven) continue;
        ++wheels_;
        const auto axle = std::ranges::find_if(axles_, [&](const std::vector<std::size_t>& wheels) {
            return on_one_axle(car_.wheels[i], car_.wheels[wheels.front()]);
        });
        if (axle == axles_.end()) {
            axles_.push_back({i});
        } else {
            axle->push_back(i);
        }
    }
}

Excess TractionControl::observe(const ReferenceSpeed& reference, std::size_t wheel, const Measured& measured,
                                TreadMotion& tread) const {
    update_motion(tread, car_, measured, wheel);
    const double ground = std::max(ground_speed(reference, car_, measured, wheel), 0.);
    const double sure = std::clamp(2 - reference.unseen / unsure, 0., 1.);
    const double now = tread.speed - ground - std::max(slip_speed_, slip_ * ground) * sure;
    return {now, now + lead * (tread.acceleration - reference.acceleration)};
}

// Returns by how much the driver's throttle is reduced.
double TractionControl::limit_throttle(TractionMemory& state, const Excess& excess, const Measured& measured,
                                       const Commands& commands) const {
    const double throttle = measured.throttle, interval = measured.interval;
    if (state.limiting == 0 && (excess.now <= 0 || throttle < pressed)) return 0;
    if (state.limiting == 0) state.limit = throttle;
    state.late = excess.soon > 0 ? 0 : state.late + interval;
    const double growth = state.late / return_growth;
    const double rate = std::min(-integral * excess.soon * (1 + growth * growth), return_rate);
    const double fast = proportional * std::max(excess.soon, 0.);
    state.limit = std::clamp(state.limit + rate * interval, 0., 1.);
    state.limiting = state.limit >= std::min(throttle + spare, 1.) || throttle < pressed ? 0 : 1;
    const double allowed = state.limiting > 0 ? std::max(state.limit - fast, 0.) : 1;
    for (std::size_t unit = 0; unit < car_.units.size(); ++unit) commands.max_throttle(unit) = allowed;
    return throttle > 0 ? std::max(throttle - allowed, 0.) / throttle : 0;
}

// Brings a wheel's pressure to what its excess asks for, at most to `most`.
void TractionControl::brake(DrivenWheelMemory& own, std::size_t wheel, double excess, double most,
                            const Measured& measured, const Commands& commands) const {
    if (!commands.has_valves(wheel)) return;
    const double full = car_.full_pressure, interval = measured.interval;
    const double rate = excess > 0 ? brake_integral * excess : -brake_return;
    own.pressure = std::clamp(own.pressure + rate * full * interval, 0., most);
    const double wanted = std::min(own.pressure + brake_proportional * full * std::max(excess, 0.), most);
    const bool take = wanted > std::max(measured.control_pressure, least_pressure * full);
    const BrakeValves valves = commands.valves(wheel);
    if (take) {
        const double opening = (wanted - measured.brake_pressure[wheel]) / (full_opening * full * interval);
        valves.inlet = 0;
        valves.outlet = std::clamp(-opening, 0., 1.);
        valves.pump = std::clamp(opening, 0., 1.);
    } else if (own.taken > 0) {
        valves.rest();
    }
    own.taken = take ? 1 : 0;
}

void TractionControl::decide(const Measured& measured, std::span<double> memory, const Commands& commands) const {
    auto state = read_memory<TractionMemory>(memory);
    update_speed(state.reference, car_, measured);
    const double speed = state.reference.speed;
    const double below = brake_speed_ - speed;
    const double fade = below > 0 ? std::min(below / (brake_speed_ * (1 - fading)), 1.) : 0;
    const bool may_brake = measured.brake < pressed && measured.throttle > pressed;
    const double most = may_brake ? fade * most_brake * car_.full_pressure : 0;
    Excess worst{-1e9, -1e9};  // of the axle that limits the throttle
    double braked = 0;
    std::size_t first = 0;
    for (const std::vector<std::size_t>& axle : axles_) {
        Excess slower{1e9, 1e9}, faster{-1e9, -1e9};
        for (std::size_t i = 0; i < axle.size(); ++i) {
            auto own = read_memory<DrivenWheelMemory>(memory, place(first + i));
            own.excess = observe(state.reference, axle[i], measured, own.tread);
            slower = {std::min(slower.now, own.excess.now), std::min(slower.soon, own.excess.soon)};
            faster = {std::max(faster.now, own.excess.now), std::max(faster.soon, own.excess.soon)};
            write_memory(own, memory, place(first + i));
        }
        for (std::size_t i = 0; i < axle.size(); ++i) {
            auto own = read_memory<DrivenWheelMemory>(memory, place(first + i));
            const double difference = own.excess.now - slower.now - apart;
            brake(own, axle[i], std::min(own.excess.now, difference), most, measured, commands);
            braked += own.taken;
            write_memory(own, memory, place(first + i));
        }
        first += axle.size();
        const double help = commands.has_valves(axle.front()) ? fade : 0;
        const double share = faster_share + (braked_share - faster_share) * help;
        worst.now = std::max(worst.now, share * faster.now + (1 - share) * slower.now);
        worst.soon = std::max(worst.soon, share * faster.soon + (1 - share) * slower.soon);
    }
    const double reduced = limit_throttle(state, worst, measured, commands);
    state.activity = std::max(reduced, braked / static_cast<double>(std::max<std::size_t>(wheels_, 1)));
    write_memory(state, memory);
}

}  // namespace

ControllerKind traction_control() {
    return {
        .keyword = "traction_control",
        .meaning = "traction control: keeps driven wheels from spinning",
        .keys = {{"slip", "of driven wheels that is allowed", 0.05, 0.01, 0.5},
                 {"slip_speed_m_per_s", "likewise at low speed, as a difference of speeds", 0.4, 0.1, 5},
                 {"brake_speed_m_per_s", "of the car, above which brakes are not used; 0: never", 11, 0, 50}},
        .lacks = [](const VehicleDescription& vehicle) -> std::string {
            return vehicle.power_units.empty() ? "a power unit" : "";
        },
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<TractionControl>(settings, car);
        }};
}

}  // namespace hamilcar
