#include "hamilcar/live/ride.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/run/scene.hpp"

namespace hamilcar::live {

namespace {

constexpr double feeling_interval = 0.01;     // of simulated time, at which the hands learn how the car moves [s]
constexpr double attention_interval = 0.005;  // at which gears are decided on and a course is watched [s]

// Pedals and gears are the person's: the engines of a car that has some run, and no gear is in.
ScenarioDescription for_a_person(ScenarioDescription scenario, double friction, const VehicleDescription& vehicle,
                                 const std::optional<CourseJudge>& judge) {
    scenario.road.friction = friction;
    scenario.steering_input = SteeringInput::none;
    scenario.steering = scenario.drive = scenario.brake = scenario.throttle = scenario.clutch = scenario.gear = {};
    scenario.driver = {};
    if (!vehicle.power_units.empty()) scenario.gear = {.time = {0}, .value = {0}};
    if (judge) {
        const CourseJudge::Start start = judge->start();
        scenario.initial.position = {start.x, start.y};
        scenario.initial.yaw = start.yaw;
    }
    scenario.duration = scenario.solver.step;  // nobody asks whether the run has finished
    return scenario;
}

// Driven wheels count by their share of the torque.
Felt feel(const VehicleDescription& vehicle, const Sample& sample) {
    double sum = 0, weight = 0;
    const auto add = [&](double spin, double share) { sum += share * spin, weight += share; };
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const auto& wheels = vehicle.suspensions[s].wheels;
        for (std::size_t w = 0; w < wheels.size(); ++w) {
            add(sample.momenta.suspensions[s].wheels[w].spin, wheels[w].drive_share);
        }
    }
    return {.speed = sample.velocity.hub[0], .spin = weight > 0 ? sum / weight : 0};
}

}  // namespace

Ride::Ride(std::uint32_t number, const Wish& wish, const VehicleDescription& vehicle, ScenarioDescription scenario,
           std::optional<TestCourse> course)
    : number_(number),
      wish_(wish),
      judge_(course ? std::optional<CourseJudge>(std::in_place, std::move(*course), vehicle) : std::nullopt),
      simulation_(vehicle, for_a_person(std::move(scenario), wish.friction, vehicle, judge_)),
      hands_(car(), Column(vehicle.steering), shaft_ratio(), step()),
      channels_(all_channels(vehicle)),
      values_(channels_.size()),
      scene_(scene_json(vehicle, simulation_.scenario())),
      frames_(Frame{.values = std::vector<float>(channels_.size())}) {
    simulation_.prepare();  // here, where there is time for it
    simulation_.save(start_);
    reset();
}

// Of the first gear, by putting it in for a moment.
double Ride::shaft_ratio() {
    if (!car().powered) return 0;
    simulation_.follow(Control::gear, {1});
    return simulation_.senses().units[0].wheel_ratio;
}

long Ride::steps_in(double duration) const {
    return std::max(1L, std::lround(duration / step()));
}

std::optional<End> Ride::advance(const Held& held) {
    if (is_time(feeling_interval)) observe();
    if ((car().powered || judge_) && is_time(attention_interval)) {
        const Senses senses = simulation_.senses();
        if (judge_) judge_->look(senses);
        hands_.shift(held.controls, senses, static_cast<int>(steps_in(attention_interval)));
    }
    obey(hands_.next(held.controls, felt_, time()));
    std::optional<End> end = simulation_.advance();
    if (end && judge_) judge_->give_up();
    return end;
}

void Ride::obey(const Input<double>& now) {
    simulation_.follow(Control::rack, {now.rack.displacement, now.rack.rate, now.rack.acceleration});
    simulation_.follow(Control::drive_torque, {now.drive_torque});
    simulation_.follow(Control::brake, {now.brake});
    if (!car().powered) return;
    simulation_.follow(Control::throttle, {now.throttle});
    simulation_.follow(Control::clutch, {now.clutch});
    simulation_.follow(Control::gear, {now.gear});
}

void Ride::reset() {
    simulation_.restore(start_);
    hands_.let_go();
    obey({.time = time()});
    if (judge_) judge_->begin();
    observed_ = -1;
    show({});
}

std::span<const double> Ride::observe() {
    if (observed_ == steps_taken()) return values_;
    const Sample sample = simulation_.sample();
    for (std::size_t i = 0; i < channels_.size(); ++i) values_[i] = channels_[i].read(sample);
    // However often somebody looks, the hands feel at the same instants.
    if (is_time(feeling_interval)) felt_ = feel(simulation_.vehicle(), sample);
    observed_ = steps_taken();
    return values_;
}

void Ride::show(const Held& held) {
    const std::span<const double> values = observe();
    Frame& frame = frames_.draft();
    frame.time = time();
    frame.page = held.page, frame.sequence = held.sequence;
    frame.x = state().position()[0], frame.y = state().position()[1];
    std::transform(values.begin(), values.end(), frame.values.begin(),
                   [](double value) { return static_cast<float>(value); });
    if (judge_) frame.run = judge_->run();
    frames_.publish();
}

}  // namespace hamilcar::live
