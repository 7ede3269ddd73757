#include "hamilcar/live/ride.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/live/handled_car.hpp"
#include "hamilcar/run/scene.hpp"

namespace hamilcar::live {

namespace {

constexpr double feeling_interval = 0.01;  // of simulated time, at which the hands learn how the car moves [s]

ScenarioDescription for_a_person(ScenarioDescription scenario, double friction) {
    scenario.road.friction = friction;
    scenario.steering_input = SteeringInput::none;
    scenario.steering = scenario.drive = scenario.brake = {};
    scenario.duration = scenario.solver.step;  // nobody asks whether the run has finished
    return scenario;
}

}  // namespace

Ride::Ride(std::uint32_t number, const Wish& wish, const VehicleDescription& vehicle, ScenarioDescription scenario)
    : number_(number),
      wish_(wish),
      simulation_(vehicle, for_a_person(std::move(scenario), wish.friction)),
      car_(handled_car(simulation_)),
      hands_(car_, step()),
      channels_(all_channels(vehicle)),
      values_(channels_.size()),
      scene_(scene_json(vehicle, simulation_.scenario())),
      frames_(Frame{.values = std::vector<float>(channels_.size())}) {
    simulation_.save(start_);
    reset();
}

long Ride::steps_in(double duration) const {
    return std::max(1L, std::lround(duration / step()));
}

std::optional<End> Ride::advance(const Held& held) {
    if (steps_taken() % steps_in(feeling_interval) == 0) observe();
    simulation_.follow(hands_.next(held.controls, felt_, time()));
    return simulation_.advance();
}

void Ride::reset() {
    simulation_.restore(start_);
    hands_.let_go();
    simulation_.follow({.time = time()});
    observed_ = -1;
    show({});
}

std::span<const double> Ride::observe() {
    if (observed_ == steps_taken()) return values_;
    const Sample sample = simulation_.sample();
    for (std::size_t i = 0; i < channels_.size(); ++i) values_[i] = channels_[i].read(sample);
    // However often somebody looks, the hands feel at the same instants.
    if (steps_taken() % steps_in(feeling_interval) == 0) felt_ = feel(simulation_.vehicle(), sample);
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
    frames_.publish();
}

}  // namespace hamilcar::live
