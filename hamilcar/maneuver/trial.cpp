#include "hamilcar/maneuver/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/analysis/rack_force.hpp"
#include "hamilcar/block/road_wheels.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/film.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "hamilcar/run/scene.hpp"
#include "hamilcar/run/simulation.hpp"
#include "hamilcar/run/unit_place.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

constexpr double fallen_over = std::numbers::pi / 3;  // roll beyond which no car comes back [rad]

// A wheel as the forces know it.
struct SeenWheel {
    const WheelForces<double>* forces;
    std::span<const TireForces<double>> tires;  // from the left to the right
    std::size_t unit;                           // whose axes its contacts are in
    bool is_right;

    double load() const {
        double sum = tires.front().tire.Fz;
        for (const TireForces<double>& tire : tires.subspan(1)) sum += tire.tire.Fz;
        return sum;
    }
    Vec3<double> outer_contact(const UnitPose<double>& place) const {
        return place.position + place.R * (is_right ? tires.back() : tires.front()).frame.point;
    }
};

// Of motor vehicle and trailers, in the order of for_each_wheel.
std::vector<SeenWheel> seen_wheels(const Sample& s) {
    std::vector<SeenWheel> out;
    for (std::size_t i = 0; i < s.model.vehicle.suspensions.size(); ++i) {
        const Suspension<double>& suspension = s.model.vehicle.suspensions[i];
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            const WheelForces<double>& forces = s.momenta.suspensions[i].wheels[w];
            const std::span tires(forces.tires.data(), static_cast<std::size_t>(suspension.wheels[w].tires));
            out.push_back(
                {&forces, tires, static_cast<std::size_t>(suspension.unit), suspension.wheels[w].wheel.center[1] < 0});
        }
    }
    return out;
}

// Of the motor vehicle alone, with its suspensions as they stand, in chassis axes [m].
Vec3<double> motor_vehicle_center(const Sample& s) {
    const Vehicle<double>& vehicle = s.model.vehicle;
    Vec3<double> moment = vehicle.chassis_inertia.first_moment;
    double mass = vehicle.chassis_inertia.mass;
    const auto add = [&](const SpatialInertia<double>& inertia) {
        moment += inertia.first_moment, mass += inertia.mass;
    };
    for (std::size_t i = 0; i < vehicle.suspensions.size(); ++i) {
        if (vehicle.suspensions[i].unit != 0) continue;
        const auto& inertia = s.velocity.suspensions[i].inertia;
        for (std::size_t b = 0; b < vehicle.suspensions[i].bodies.size(); ++b) add(inertia[b]);
    }
    return moment / mass;
}

// Of the motor vehicle's center of mass, ground axes [m/s^2]. Alone it moves as all forces on it say; what a trailer does
// to it through the hitch is in no external force, so its motion is looked at, as that of the chassis in that place.
Vec3<double> acceleration_of(const Sample& s) {
    const Vehicle<double>& vehicle = s.model.vehicle;
    const Mat3<double>& R = s.velocity.R_GC;
    if (vehicle.trailers.empty()) return R * Vec3<double>(s.momenta.external.head<3>()) / vehicle.total_mass;
    return R * acceleration_at(s.model, s.state, s.input, s.velocity, s.momenta, motor_vehicle_center(s));
}

// Writes the rows of a History.
class Observer {
public:
    Observer(const Simulation& simulation, const TrialOptions& options, History& history)
        : options_(options), column_(simulation.vehicle().steering), history_(history) {}

    void add(const Sample& s) {
        add_motion(s);
        add_controls(s);
        add_wheels(s);
        if (options_.seat_acceleration) add_seat(s);
    }

private:
    void add_motion(const Sample& s) {
        const Observation observation = hamilcar::observe(s.model, s.state, s.input);
        const Mat3<double>& R = s.velocity.R_GC;
        history_.time.push_back(s.time);
        history_.x.push_back(observation.x), history_.y.push_back(observation.y);
        const double before = history_.yaw.empty() ? observation.yaw : history_.yaw.back();
        history_.yaw.push_back(observation.yaw +
                               2 * std::numbers::pi * std::round((before - observation.yaw) / (2 * std::numbers::pi)));
        history_.speed.push_back(observation.speed);
        history_.lateral_velocity.push_back(observation.lateral_velocity);
        history_.yaw_rate.push_back(observation.yaw_rate);
        history_.roll.push_back(observation.roll);
        history_.pitch.push_back(-std::asin(std::clamp(R(2, 0), -1.0, 1.0)));
        const Vec3<double> a = acceleration_of(s);
        const double c = std::cos(observation.yaw), d = std::sin(observation.yaw);
        history_.longitudinal_acceleration.push_back(c * a[0] + d * a[1]);
        history_.lateral_acceleration.push_back(c * a[1] - d * a[0]);
    }

    void add_controls(const Sample& s) {
        const double rack = s.input.rack.displacement;
        history_.steering_wheel.push_back(column_.exists() ? column_.angle(rack) : 0);
        const double force = column_.exists() ? rack_force(s.model, s.state, s.input, s.velocity, s.momenta) : 0;
        history_.steering_torque.push_back(column_.exists() ? steering_torque(column_, rack, force) : 0);
        history_.throttle.push_back(s.input.throttle);
        history_.brake.push_back(s.input.brake);
        history_.gear.push_back(s.input.gear);
        if (s.model.vehicle.powertrain.exists()) history_.unit_speed.push_back(s.momenta.powertrain.units[0].spin);
    }

    void add_wheels(const Sample& s) {
        const auto wheels = seen_wheels(s);
        const std::size_t n = wheels.size();
        for (auto* rows : {&history_.wheel_load, &history_.wheel_speed, &history_.wheel_x, &history_.wheel_y}) {
            rows->resize(n);
        }
        double torque = 0;
        for (std::size_t i = 0; i < n; ++i) {
            torque += wheels[i].forces->drive_torque;
            history_.wheel_load[i].push_back(wheels[i].load());
            history_.wheel_speed[i].push_back(wheels[i].forces->spin);
            const Vec3<double> at = wheels[i].outer_contact(unit_place(s, wheels[i].unit));
            history_.wheel_x[i].push_back(at[0]), history_.wheel_y[i].push_back(at[1]);
        }
        history_.drive_torque.push_back(torque);
    }

    void add_seat(const Sample& s) {
        const Vec3<double> a =
            acceleration_at(s.model, s.state, s.input, s.velocity, s.momenta, s.model.vehicle.chassis.center);
        history_.seat_x.push_back(a[0]), history_.seat_y.push_back(a[1]), history_.seat_z.push_back(a[2]);
    }

    const TrialOptions& options_;
    Column column_;
    History& history_;
};

// The books from start to end. What is supplied comes from the power units; where a torque at the wheels stands for them, from
// its power, by trapezoids between the rows.
class Books {
public:
    void add(const Sample& s) {
        const double stored = s.energy.kinetic + s.energy.potential - s.energy.drift;
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
        book_.supplied = supplied_, book_.is_kept = s.model.energy_balance;
        book_.stored = stored - stored_;
        book_.dissipated = supplied_ - (s.energy.work - work_);
        book_.turnover = std::max({largest_, std::abs(supplied_), std::abs(book_.dissipated)});
    }
    const EnergyBook& book() const { return book_; }

private:
    static double drive_power(const Sample& s) {
        double power = 0;
        for (const SeenWheel& wheel : seen_wheels(s)) power += wheel.forces->drive_torque * wheel.forces->spin;
        return power;
    }

    EnergyBook book_;
    double stored_ = 0, work_ = 0, supplied_ = 0, power_ = 0, time_ = 0, largest_ = 0;
    bool first_ = true;
};

// Channels for a page: the usual ones and what moves the picture.
std::vector<Channel> film_channels(const VehicleDescription& vehicle) {
    const std::vector<Channel> all = all_channels(vehicle);
    std::vector<Channel> chosen = select_channels(all, {});
    add_missing_motion(all, chosen);
    return chosen;
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
void judge(Trial& trial, double step) {
    const EnergyBook& book = trial.energy;
    if (trial.breaks_off() || judge_energy(book.error(), book.turnover) != EnergyVerdict::wrong) return;
    trial.stopped = Stopped::numerical;
    trial.trouble = fmt::format(
        "the energy account is off by {:.2g} J of {:.2g} J turned over, more than a tenth: the step of {:g} s is too "
        "large for this vehicle, or a number of it is wrong; figures of this drive would be worth nothing",
        book.error(), book.turnover, step);
}

}  // namespace

EnergyBook& EnergyBook::operator+=(const EnergyBook& other) {
    supplied += other.supplied, stored += other.stored, dissipated += other.dissipated;
    turnover += other.turnover, is_kept = is_kept && other.is_kept;
    return *this;
}

double History::sideslip(std::size_t row) const {
    constexpr double slow = 3;  // [m/s]
    const double along = speed[row], across = lateral_velocity[row];
    return along * along + across * across < slow * slow ? 0 : std::atan2(across, along);
}

Trial drive(const VehicleDescription& vehicle, const ScenarioDescription& scenario, const TrialOptions& options) {
    check_steering(vehicle, scenario);
    Simulation simulation(vehicle, scenario);
    Trial trial;
    Observer observer(simulation, options, trial.history);
    Books books;
    const std::vector<Channel> channels = options.film ? film_channels(simulation.vehicle()) : std::vector<Channel>();
    Film film(scenario.name, options.film ? scene_json(simulation.vehicle(), scenario) : "", channels);
    std::vector<double> row(channels.size());
    const long every = std::max(1L, std::lround(options.interval / scenario.solver.step));
    const auto observe = [&] {
        const Sample sample = simulation.sample();
        observer.add(sample);
        books.add(sample);
        for (std::size_t i = 0; i < channels.size(); ++i) row[i] = channels[i].read(sample);
        if (options.film) film.add(sample.time, row);
    };
    observe();
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) {
            trial.stopped = Stopped::numerical, trial.trouble = end->message;
            break;
        }
        if (simulation.ending() || simulation.steps_taken() % every != 0) continue;
        observe();
        if (std::abs(trial.history.roll.back()) > fallen_over) {
            trial.stopped = Stopped::fell_over, trial.trouble = "the vehicle fell over";
            break;
        }
        const double done = simulation.time() / scenario.duration;
        if (options.keep_going && !options.keep_going(done)) {
            trial.stopped = Stopped::interrupted, trial.trouble = "interrupted";
            break;
        }
    }
    trial.ended = simulation.ending();
    trial.complaints = simulation.complaints();
    trial.energy = books.book();
    judge(trial, scenario.solver.step);
    if (options.film) trial.film = film.take();
    return trial;
}

}  // namespace hamilcar
