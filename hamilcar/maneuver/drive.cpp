#include "hamilcar/maneuver/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/run_loop.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "hamilcar/run/scene.hpp"
#include "hamilcar/run/validity.hpp"

namespace hamilcar {

namespace {

constexpr double fallen_over = 60;  // roll beyond which no car comes back [deg]

// From start to end. What is supplied comes from the power units; where a torque at the wheels stands for them, from its power,
// by trapezoids between the rows.
class EnergyAccount {
public:
    void add(const Sample& s) {
        const double stored = s.energy.kinetic + s.energy.potential - s.energy.prescribed;
        const Powertrain<double>& powertrain = s.model.vehicle.powertrain;
        if (first_) {
            stored_ = stored, work_ = s.energy.work;
            first_ = false;
        } else if (!powertrain.exists()) {
            supplied_ += 0.5 * (power_ + drive_power(s)) * (s.time - time_);
        }
        if (powertrain.exists()) supplied_ = powertrain.supplied(s.state.values.data());
        power_ = drive_power(s), time_ = s.time;
        largest_ = std::max(largest_, s.energy.kinetic);
        balance_.supplied = supplied_, balance_.is_kept = s.model.energy_balance;
        balance_.stored = stored - stored_;
        balance_.dissipated = supplied_ - (s.energy.work - work_);
        balance_.exchanged = std::max({largest_, std::abs(supplied_), std::abs(balance_.dissipated)});
    }
    const EnergyBalance& balance() const { return balance_; }

private:
    static double drive_power(const Sample& s) {
        double power = 0;
        for (std::size_t i = 0; i < s.model.vehicle.suspensions.size(); ++i) {
            for (std::size_t w = 0; w < s.model.vehicle.suspensions[i].wheels.size(); ++w) {
                const WheelForces<double>& wheel = s.momenta.suspensions[i].wheels[w];
                power += wheel.drive_torque * wheel.spin;
            }
        }
        return power;
    }

    EnergyBalance balance_;
    double stored_ = 0, work_ = 0, supplied_ = 0, power_ = 0, time_ = 0, largest_ = 0;
    bool first_ = true;
};

// The channels that evaluations read.
std::vector<std::string> evaluated_channels(const VehicleDescription& vehicle, const DriveOptions& options) {
    std::vector<std::string> names{channel::x,
                                   channel::y,
                                   channel::heading,
                                   channel::roll,
                                   channel::pitch,
                                   channel::speed,
                                   channel::yaw_rate,
                                   channel::lateral_speed,
                                   channel::sideslip,
                                   channel::longitudinal_acceleration,
                                   channel::lateral_acceleration};
    if (vehicle.steering.rack_per_revolution > 0) {
        names.insert(names.end(), {channel::steering_wheel, channel::steering_torque});
    }
    if (!vehicle.power_units.empty()) names.insert(names.end(), {channel::gear, channel::rotor_speed(vehicle)});
    if (options.seat_acceleration) names.insert(names.end(), {channel::seat_x, channel::seat_y, channel::seat_z});
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        names.insert(names.end(), {channel::wheel_load(wheel.name), channel::wheel_spin(wheel.name),
                                   channel::contact_x(wheel.name), channel::contact_y(wheel.name)});
    });
    return names;
}

// A steering wheel that a maneuver turns is no key that somebody wrote.
void check_steering(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    const auto beyond = rack_beyond_stops(scenario, vehicle.steering);
    if (!beyond) return;
    throw io::Error(
        io::ExitCode::numerical,
        fmt::format("the maneuver needs more steering than {} has: at t = {:g} s of '{}' the rack would stand "
                    "at {:.4g} m, beyond its stops at {:g} m each way",
                    vehicle.name, beyond->time, scenario.name, beyond->displacement, vehicle.steering.rack_travel));
}

// A step too large need not end a drive: it may go on with numbers that no vehicle has.
void judge(Drive& drive, double step) {
    const EnergyBalance& energy = drive.energy;
    if (drive.breaks_off() || judge_energy(energy.error(), energy.exchanged) != EnergyVerdict::wrong) return;
    drive.stopped = Stopped::numerical;
    drive.trouble = fmt::format(
        "the energy account is off by {:.2g} J of {:.2g} J exchanged, more than a tenth: the step of {:g} s is too "
        "large for this vehicle, or a number of it is wrong; figures of this drive would be worth nothing",
        energy.error(), energy.exchanged, step);
}

// Why the loop ended, in the words of a maneuver.
void tell_end(const RunEnd& end, Drive& drive) {
    switch (end.cause) {
        case RunEnd::Cause::failure: drive.stopped = Stopped::numerical, drive.trouble = end.message; break;
        case RunEnd::Cause::watch: drive.stopped = Stopped::fell_over, drive.trouble = "the vehicle fell over"; break;
        case RunEnd::Cause::interrupted: drive.stopped = Stopped::interrupted, drive.trouble = "interrupted"; break;
        case RunEnd::Cause::duration:
        case RunEnd::Cause::driver: break;
    }
}

Drive drive_once(const VehicleDescription& vehicle, const ScenarioDescription& scenario, const DriveOptions& options,
                 const ManeuverOptions& maneuver) {
    check_steering(vehicle, scenario);
    Simulation simulation(vehicle, scenario);
    const bool replay = maneuver.keep_runs && options.replay;
    const std::vector<Channel> all = all_channels(simulation.vehicle());
    std::vector<Channel> shown = replay ? select_channels(all, maneuver.channels) : std::vector<Channel>();
    if (replay) add_missing_motion(all, shown);
    std::vector<Channel> channels = select_channels(all, evaluated_channels(simulation.vehicle(), options));
    add_missing(shown, channels);
    Drive out{.name = scenario.name, .recording = Recording(channels)};
    EnergyAccount account;
    ValidityMonitor validity(simulation);
    std::vector<double> row(channels.size());
    const auto on_sample = [&](const Sample& sample) {
        for (std::size_t i = 0; i < channels.size(); ++i) row[i] = channels[i].read(sample);
        out.recording.add(sample.time, row);
        account.add(sample);
        validity.look(sample);
        return std::abs(out.recording[channel::roll].values.back()) <= fallen_over || sample.time == 0;
    };
    const auto keep_going = [&] {
        const auto& [from, to] = options.share;
        return maneuver.keep_going(from + (to - from) * std::min(simulation.time() / scenario.duration, 1.0));
    };
    tell_end(run_to_end(simulation, {.interval = options.interval, .on_sample = on_sample, .keep_going = keep_going}),
             out);
    out.ended = simulation.ending();
    out.warnings = simulation.warnings();
    out.energy = account.balance();
    out.validity = energy_warning(out.energy.error(), out.energy.exchanged, scenario.solver.step, simulation.time());
    add_warnings(validity.warnings(), "", out.validity);
    judge(out, scenario.solver.step);
    if (replay) {
        out.replay = page_run(out.recording, shown, scenario.name, scene_json(simulation.vehicle(), scenario),
                              options.replay_interval);
    }
    return out;
}

}  // namespace

EnergyBalance& EnergyBalance::operator+=(const EnergyBalance& other) {
    supplied += other.supplied, stored += other.stored, dissipated += other.dissipated;
    exchanged += other.exchanged, is_kept = is_kept && other.is_kept;
    return *this;
}

Drive drive(const VehicleDescription& vehicle, const ScenarioDescription& scenario, const DriveOptions& options,
            const ManeuverOptions& maneuver) {
    Drive out = drive_once(vehicle, scenario, options, maneuver);
    if (out.stopped != Stopped::numerical || !options.retry_with_finer_step) return out;
    ScenarioDescription finer = scenario;
    finer.solver.step /= 4;
    out = drive_once(vehicle, finer, options, maneuver);
    out.warnings.push_back(fmt::format("the step of {:g} s was too long for this vehicle: driven with {:g} s",
                                       scenario.solver.step, finer.solver.step));
    return out;
}

}  // namespace hamilcar
