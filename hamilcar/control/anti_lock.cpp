// Anti-lock system. Each channel, a steered wheel or an axle that is not steered, releases pressure when its slip is about to exceed a
// threshold, holds while the wheel speeds up, and builds up again from below the pressure at which it slipped. Rates and steps are
// shares of that pressure, so that the cycle is the same on ice and asphalt, with fluid and air.
#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

namespace {

// Found by trial with tires that have a peak and tires that have none, on friction from 0.1 to 1, with decisions 1 to 20 ms apart,
// brakes of half and of four times the strength, and lines of half and of twice the flow: the optimum is flat.
constexpr double slip_offset = 0.4;        // in addition to the slip: what sensors and carcasses do [m/s]
constexpr double high_friction = 8;        // deceleration at which the slip is as stated [m/s^2]
constexpr double least_friction = 0.1;     // of it; below, the slip is no smaller
constexpr double friction_time = 1;        // after which a high deceleration is forgotten [s]
constexpr double almost = 0.75;            // of the threshold: pressure stays
constexpr double recovered = 0.5;          // of the threshold: the wheel rolls well enough to be braked more
constexpr double release_time = 0.08;      // in which the pressure at which a wheel slipped would be gone [s]
constexpr double max_haste = 3;            // in which it is gone faster where slip is far beyond the threshold [1]
constexpr double return_share = 0.7;       // of the pressure that was released comes back at once
constexpr double build_rate = 0.35;        // of the pressure at which a wheel slipped, at first [1/s]
constexpr double least_build_rate = 0.06;  // of full pressure, in addition [1/s]
constexpr double build_growth = 0.2;       // after which the build-up gets faster: friction may have risen [s]
constexpr double little_slip_growth = 6;   // of the rate where a wheel has no slip
constexpr double rear_slip = 0.03;         // more than in front: brake force distribution holds the rear axle
constexpr double least_pressure = 0.01;    // of full pressure: the driver brakes
constexpr double full_opening = 10;        // of a valve, for that change of pressure [full pressures per second]
constexpr double max_lateral = 4;          // beyond, unlike forces in front help a car that turns: Bosch, 0.4 g [m/s^2]
constexpr double probe_after = 0.45;       // without a wheel that rolls freely [s]
constexpr double rest = 0, release = 1, hold = 2, build = 3;  // phases of a channel

struct AntiLockMemory {
    ReferenceSpeed reference;
    double activity;      // share of braked wheels that are controlled
    double deceleration;  // the largest of late [m/s^2]
    double probe;         // wheel that is let go to see the car's speed, counted from 1; 0: none
    double withheld;      // 1: motors may not brake in place of friction, which this controller has to do with alone
};

struct ChannelMemory {
    double phase;
    double target;           // pressure [Pa]
    double slipped;          // pressure at which it began to slip [Pa]
    double elapsed;          // since the build-up began [s]
    double alone;            // how long the axle's other channel has been controlled [s]
    double taken;            // 1: its valves are this controller's
    double now, soon, slip;  // the largest of its wheels: slip over the threshold, that in a while, and slip itself [1]
};

class AntiLock final : public Controller {
public:
    AntiLock(const ControllerSettings& settings, const ControlledCar& car);

    std::size_t memory_size() const override { return channel_place(channels_.size()); }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override;
    double activity(std::span<const double> memory) const override {
        return read_memory<AntiLockMemory>(memory).activity;
    }

private:
    struct Channel {
        std::vector<std::size_t> wheels;
        bool steered = false;
        std::ptrdiff_t partner = -1;  // the other channel of its axle
    };

    std::size_t wheel_place(std::size_t wheel) const {
        return numbers_of<AntiLockMemory>() + wheel * numbers_of<TreadMotion>();
    }
    std::size_t channel_place(std::size_t channel) const {
        return wheel_place(car_.wheels.size()) + channel * numbers_of<ChannelMemory>();
    }
    double observe(AntiLockMemory& state, const Measured& measured, std::span<double> memory) const;
    void advance(ChannelMemory& channel, bool held, double pressure, const Measured& measured) const;
    double partner_limit(const Channel& own, ChannelMemory& channel, double pressure, const Measured& measured,
                         std::span<const double> memory) const;
    void actuate(const Channel& own, ChannelMemory& channel, double target, double probe, const Measured& measured,
                 const Commands& commands) const;
    void withhold_regeneration(AntiLockMemory& state, const Commands& commands) const;

    ControlledCar car_;
    double slip_, lead_, min_speed_, rise_;
    std::vector<Channel> channels_;
};

AntiLock::AntiLock(const ControllerSettings& settings, const ControlledCar& car)
    : car_(car),
      slip_(settings["slip"]),
      lead_(settings["lead_s"]),
      min_speed_(settings["min_speed_m_per_s"]),
      rise_(settings["yaw_moment_rise_s"]) {
    const bool select_low = settings["select_low"] > 0.5;
    for (std::size_t i = 0; i < car_.wheels.size(); ++i) {
        const ControlledWheel& wheel = car_.wheels[i];
        if (wheel.brake_torque <= 0) continue;
        const auto axle = std::ranges::find_if(
            channels_, [&](const Channel& channel) { return on_one_axle(wheel, car_.wheels[channel.wheels.front()]); });
        if (axle == channels_.end()) {
            channels_.push_back({{i}, wheel.steered});
        } else if (select_low && !wheel.steered) {
            axle->wheels.push_back(i);
        } else {
            axle->partner = std::ssize(channels_);
            channels_.push_back({{i}, wheel.steered, axle - channels_.begin()});
        }
    }
}

// Brings the slip of all channels up to date; returns the mean of the steered ones. Where all wheels slip for long, the speed rests on
// the accelerometer alone: of the wheels that are not steered the fastest is let go until it confirms the speed.
double AntiLock::observe(AntiLockMemory& state, const Measured& measured, std::span<double> memory) const {
    double front = 0, steered = 0, fastest = -1, candidate = 0;
    state.deceleration *= 1 - measured.interval / friction_time;
    state.deceleration = std::max(state.deceleration, -state.reference.acceleration);
    const double friction = std::sqrt(std::clamp(state.deceleration / high_friction, least_friction, 1.));
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        auto channel = read_memory<ChannelMemory>(memory, channel_place(c));
        channel.now = channel.soon = channel.slip = 0;
        for (const std::size_t wheel : channels_[c].wheels) {
            auto tread = read_memory<TreadMotion>(memory, wheel_place(wheel));
            update_motion(tread, car_, measured, wheel);
            write_memory(tread, memory, wheel_place(wheel));
            const double ground = std::max(ground_speed(state.reference, car_, measured, wheel), 0.);
            const double lag = ground - tread.speed, threshold = (slip_ * ground + slip_offset) * friction;
            const double growth = state.reference.acceleration - tread.acceleration;
            channel.now = std::max(channel.now, lag / threshold);
            channel.soon = std::max(channel.soon, (lag + lead_ * growth) / threshold);
            channel.slip = std::max(channel.slip, lag / std::max(ground, 1.));
            if (!channels_[c].steered && tread.speed > fastest) {
                fastest = tread.speed;
                candidate = static_cast<double>(wheel) + 1;
            }
        }
        write_memory(channel, memory, channel_place(c));
        front += channels_[c].steered ? channel.slip : 0;
        steered += channels_[c].steered ? 1 : 0;
    }
    state.probe = state.reference.unseen < probe_after ? 0 : state.probe > 0 ? state.probe : candidate;
    return steered > 0 ? front / steered : 1;
}

// One step of the cycle; `held`: the pressure shall not rise for other reasons.
void AntiLock::advance(ChannelMemory& channel, bool held, double pressure, const Measured& measured) const {
    const double interval = measured.interval;
    if (channel.phase == rest && held) {
        channel.phase = build, channel.elapsed = 0;
        channel.target = channel.slipped = pressure;
    }
    if (channel.soon > 1) {
        if (channel.phase == rest || channel.phase == build) channel.slipped = channel.target = pressure;
        channel.phase = release;
        const double fall = channel.slipped * std::min(channel.soon, max_haste) * interval / release_time;
        channel.target = std::max(std::min(channel.target, pressure) - fall, 0.);
        return;
    }
    if (channel.phase == release) channel.phase = hold;
    if (channel.phase == hold && channel.soon < recovered && channel.now < 1) {
        channel.phase = build, channel.elapsed = 0;
        channel.target = pressure + return_share * std::max(channel.slipped - pressure, 0.);
    } else if (channel.phase == build) {
        channel.elapsed += interval;
        if (held || channel.soon > almost) return;
        const double rate = build_rate * channel.slipped + least_build_rate * car_.full_pressure;
        const double late = channel.elapsed / build_growth;
        const double ease = little_slip_growth * std::clamp(1 - channel.soon / recovered, 0., 1.);
        channel.target += rate * (1 + late * late + ease) * interval;
        if (channel.target >= measured.control_pressure) channel.phase = rest;
    }
}

// Pressure that a wheel is allowed by the other one of its axle: on split friction it rises slowly above the other's, so that the
// driver has time to steer against the yaw moment.
double AntiLock::partner_limit(const Channel& own, ChannelMemory& channel, double pressure, const Measured& measured,
                               std::span<const double> memory) const {
    if (own.partner < 0 || rise_ <= 0) return measured.control_pressure;
    const auto other = read_memory<ChannelMemory>(memory, channel_place(static_cast<std::size_t>(own.partner)));
    channel.alone = other.phase == rest ? 0 : channel.alone + measured.interval;
    if (other.phase == rest || std::abs(measured.acceleration[1]) > max_lateral) return measured.control_pressure;
    return std::max(other.slipped + car_.full_pressure * channel.alone / rise_, pressure);
}

// Takes the valves where the pressure shall be below the driver's, and opens them in proportion to what is missing.
void AntiLock::actuate(const Channel& own, ChannelMemory& channel, double target, double probe,
                       const Measured& measured, const Commands& commands) const {
    const bool take = target < measured.control_pressure;
    for (const std::size_t wheel : own.wheels) {
        const BrakeValves valves = commands.valves(wheel);
        if (take) {
            const double wanted = static_cast<double>(wheel) + 1 == probe ? 0 : target;
            const double opening =
                (wanted - measured.brake_pressure[wheel]) / (full_opening * car_.full_pressure * measured.interval);
            valves.inlet = std::clamp(opening, 0., 1.);
            valves.outlet = std::clamp(-opening, 0., 1.);
            valves.pump = 0;
        } else if (channel.taken > 0) {
            valves.rest();
        }
    }
    channel.taken = take ? 1 : 0;
}

void AntiLock::withhold_regeneration(AntiLockMemory& state, const Commands& commands) const {
    const double withheld = state.activity > 0 ? 1 : 0;
    if (withheld == 0 && state.withheld == 0) return;
    for (std::size_t unit = 0; unit < car_.units.size(); ++unit) {
        if (car_.units[unit].motor_torque > 0) commands.max_regeneration(unit) = 1 - withheld;
    }
    state.withheld = withheld;
}

void AntiLock::decide(const Measured& measured, std::span<double> memory, const Commands& commands) const {
    auto state = read_memory<AntiLockMemory>(memory);
    update_speed(state.reference, car_, measured);
    const double front = observe(state, measured, memory), least = least_pressure * car_.full_pressure;
    const bool at_work = measured.control_pressure > least && state.reference.speed > min_speed_;
    double controlled = 0, wheels = 0;
    const auto pressure_of = [&](const Channel& channel) {
        double pressure = 0;
        for (const auto wheel : channel.wheels) pressure = std::max(pressure, measured.brake_pressure[wheel]);
        return pressure;
    };
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        auto channel = read_memory<ChannelMemory>(memory, channel_place(c));
        const bool held = !channels_[c].steered && channel.slip > front + rear_slip;
        if (at_work) {
            advance(channel, held, pressure_of(channels_[c]), measured);
        } else {
            channel.phase = rest, channel.alone = 0;
        }
        write_memory(channel, memory, channel_place(c));
    }
    for (std::size_t c = 0; c < channels_.size(); ++c) {  // once all know their phase: partners see each other alike
        auto channel = read_memory<ChannelMemory>(memory, channel_place(c));
        double target = measured.control_pressure;
        if (at_work) {
            if (channel.phase != rest) target = channel.target;
            target =
                std::min(target, partner_limit(channels_[c], channel, pressure_of(channels_[c]), measured, memory));
        }
        actuate(channels_[c], channel, target, state.probe, measured, commands);
        write_memory(channel, memory, channel_place(c));
        wheels += static_cast<double>(channels_[c].wheels.size());
        controlled += channel.taken * static_cast<double>(channels_[c].wheels.size());
    }
    state.activity = controlled / std::max(wheels, 1.);
    withhold_regeneration(state, commands);
    write_memory(state, memory);
}

}  // namespace

ControllerKind anti_lock() {
    return {
        .keyword = "abs",
        .meaning = "anti-lock system: keeps braked wheels from locking",
        .keys = {{"slip", "of a wheel at which its brake is released", 0.1, 0.03, 0.5},
                 {"lead_s", "how far ahead slip is foreseen from the wheel's deceleration", 0.04, 0, 0.5},
                 {"min_speed_m_per_s", "of the car, below which it rests", 1.5, 0.5, 20},
                 {"yaw_moment_rise_s", "in which an axle's pressures may part by full pressure; 0: at once", 1, 0, 10},
                 {"select_low", "1: an axle that is not steered as its worse wheel needs it; 0: each wheel", 1, 0, 1}},
        .lacks = [](const VehicleDescription& vehicle) -> std::string {
            return vehicle.brakes.modulated ? "" : "a brake system with valves at the wheels";
        },
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<AntiLock>(settings, car);
        }};
}

}  // namespace hamilcar
