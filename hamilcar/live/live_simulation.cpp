#include "hamilcar/live/live_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/run/scene.hpp"

namespace hamilcar::live {

namespace {

constexpr double speed_interval = 0.01;      // of simulated time, at which the filter's speeds are updated [s]
constexpr double decision_interval = 0.005;  // at which gears are chosen and the course is judged [s]

// Pedals, gears and the switches of aids are left to the user: engines are running, neutral is engaged and aids are on.
ScenarioDescription live_scenario(ScenarioDescription scenario, double friction, const VehicleDescription& vehicle,
                                  const std::optional<CourseJudge>& judge) {
    scenario.road.friction = friction;
    scenario.steering_input = SteeringInput::none;
    scenario.steering_mechanics = has_free_rack(scenario);
    scenario.steering = scenario.drive = scenario.brake = scenario.throttle = scenario.clutch = scenario.gear = {};
    scenario.hands = scenario.steering_torque = scenario.parking_brake = {};
    scenario.driver = {};
    scenario.controllers_off.clear();
    if (!vehicle.power_units.empty()) scenario.gear = {.time = {0}, .value = {0}};
    if (judge) {
        const CourseJudge::Start start = judge->start();
        scenario.initial.position = {start.x, start.y};
        scenario.initial.yaw = start.yaw;
    }
    scenario.duration = scenario.solver.step;  // unused: the run has no fixed end
    return scenario;
}

// Driven wheels are weighted by their share of the torque.
MeasuredSpeeds measured_speeds(const VehicleDescription& vehicle, const Sample& sample) {
    double sum = 0, weight = 0;
    const auto add = [&](double spin, double share) { sum += share * spin, weight += share; };
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const auto& wheels = vehicle.suspensions[s].wheels;
        for (std::size_t w = 0; w < wheels.size(); ++w) {
            add(sample.momenta.suspensions[s].wheels[w].spin, wheels[w].drive_share);
        }
    }
    return {.speed = sample.velocity.chassis[0], .spin = weight > 0 ? sum / weight : 0};
}

std::vector<Aid> aids_of(const VehicleDescription& vehicle) {
    std::vector<Aid> aids;
    for (std::size_t i = 0; i < std::min(vehicle.controllers.size(), AidSet().size()); ++i) {
        const ControllerKind* kind = find_controller_kind(vehicle.controllers[i].kind);
        if (kind && kind->keyword != external_control().keyword) {
            aids.push_back({i, std::string(kind->keyword), std::string(kind->meaning)});
        }
    }
    return aids;
}

}  // namespace

LiveSimulation::LiveSimulation(std::uint32_t number, const LoadRequest& request, const VehicleDescription& vehicle,
                               ScenarioDescription scenario, std::optional<TestCourse> course)
    : number_(number),
      request_(request),
      judge_(course ? std::optional<CourseJudge>(std::in_place, std::move(*course), vehicle) : std::nullopt),
      simulation_(vehicle, live_scenario(std::move(scenario), request.friction, vehicle, judge_)),
      filter_(car(), Column(vehicle.steering), shaft_ratio(), step()),
      aids_(aids_of(vehicle)),
      channels_(all_channels(simulation_.vehicle())),
      values_(channels_.size()),
      scene_(scene_json(vehicle, simulation_.scenario())),
      frames_(Frame{.values = std::vector<float>(channels_.size())}) {
    simulation_.prepare();  // here, where it may take its time
    simulation_.save(start_);
    reset();
}

// Of the first gear, which is engaged temporarily.
double LiveSimulation::shaft_ratio() {
    if (!car().powered) return 0;
    simulation_.follow(Control::gear, {1});
    return simulation_.observation().units[0].wheel_ratio;
}

long LiveSimulation::steps_in(double duration) const {
    return std::max(1L, std::lround(duration / step()));
}

std::optional<End> LiveSimulation::advance(const ReceivedControls& received) {
    if (is_due(speed_interval)) channel_values();
    if ((car().powered || judge_) && is_due(decision_interval)) {
        const Observation observation = simulation_.observation();
        if (judge_) judge_->update(observation);
        filter_.decide_gear(received.controls, observation, static_cast<int>(steps_in(decision_interval)));
    }
    apply(filter_.next(received.controls, speeds_, time()));
    std::optional<End> end = simulation_.advance();
    if (end && judge_) judge_->abort();
    return end;
}

void LiveSimulation::apply(const Input<double>& now) {
    simulation_.follow(Control::rack, {now.rack.displacement, now.rack.rate, now.rack.acceleration});
    simulation_.follow(Control::drive_torque, {now.drive_torque});
    simulation_.follow(Control::brake, {now.brake});
    if (!car().powered) return;
    simulation_.follow(Control::throttle, {now.throttle});
    simulation_.follow(Control::clutch, {now.clutch});
    simulation_.follow(Control::gear, {now.gear});
}

void LiveSimulation::reset() {
    simulation_.restore(start_);
    switch_off(off_);
    filter_.reset();
    apply({.time = time()});
    if (judge_) judge_->begin();
    values_step_ = -1;
    publish_frame({});
}

void LiveSimulation::switch_off(const AidSet& off) {
    off_ = off;
    for (const Aid& aid : aids_) simulation_.switch_controller(aid.controller, !off[aid.controller]);
}

std::span<const double> LiveSimulation::channel_values() {
    if (values_step_ == steps_taken()) return values_;
    const Sample sample = simulation_.sample();
    for (std::size_t i = 0; i < channels_.size(); ++i) values_[i] = channels_[i].read(sample);
    // However often this is called, the filter's speeds are updated at the same instants.
    if (is_due(speed_interval)) speeds_ = measured_speeds(simulation_.vehicle(), sample);
    values_step_ = steps_taken();
    return values_;
}

void LiveSimulation::publish_frame(const ReceivedControls& received) {
    const std::span<const double> values = channel_values();
    Frame& frame = frames_.draft();
    frame.time = time();
    frame.page = received.page, frame.sequence = received.sequence;
    frame.x = state().position()[0], frame.y = state().position()[1];
    std::transform(values.begin(), values.end(), frame.values.begin(),
                   [](double value) { return static_cast<float>(value); });
    if (judge_) frame.run = judge_->run();
    frames_.publish();
}

}  // namespace hamilcar::live
