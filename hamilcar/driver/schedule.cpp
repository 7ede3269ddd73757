#include "hamilcar/driver/schedule.hpp"

#include <numbers>

namespace hamilcar {

namespace {

constexpr double finest_turn =
    std::numbers::pi / 180;  // of the steering wheel, between two points of a varying ratio [rad]

// Rack displacements for a column with a varying ratio: the table of angles, refined.
SignalDescription through(const Column& column, const SignalDescription& angles) {
    const Signal signal(angles);
    SignalDescription rack{.time = {}, .value = {}, .interpolation = angles.interpolation};
    const auto add = [&](double time) {
        rack.time.push_back(time);
        rack.value.push_back(column.rack(signal.at(time).value).displacement);
    };
    for (std::size_t i = 0; i < angles.time.size(); ++i) {
        add(angles.time[i]);
        if (i + 1 == angles.time.size()) break;
        const double turn = std::abs(angles.value[i + 1] - angles.value[i]);
        const int parts = 1 + static_cast<int>(turn / finest_turn);
        const double between = (angles.time[i + 1] - angles.time[i]) / parts;
        for (int k = 1; k < parts; ++k) add(angles.time[i] + k * between);
    }
    return rack;
}

SignalDescription constant(double value) {
    return {.time = {0}, .value = {value}, .interpolation = Interpolation::linear};
}

Signal rack_signal(const ScenarioDescription& scenario, const SteeringDescription& steering) {
    if (scenario.steering_input == SteeringInput::none) return {};
    if (scenario.steering_input == SteeringInput::rack) return Signal(scenario.steering);
    const Column column(steering);
    return steering.angle.empty() ? Signal(scenario.steering, column.center_ratio())
                                  : Signal(through(column, scenario.steering));
}

}  // namespace

Schedule::Schedule(const ScenarioDescription& scenario, const SteeringDescription& steering)
    : powered_(is_powered(scenario)),
      windy_(!scenario.wind_x.time.empty() || !scenario.wind_y.time.empty()),
      free_rack_(steering.moves_on_its_own()),
      parks_(!scenario.parking_brake.time.empty()) {
    const auto at = [this](Control control) -> Signal& { return signals_[static_cast<std::size_t>(control)]; };
    at(Control::rack) = rack_signal(scenario, steering);
    at(Control::drive_torque) = Signal(scenario.drive);
    at(Control::brake) = Signal(scenario.brake);
    at(Control::parking_brake) = Signal(scenario.parking_brake);
    at(Control::throttle) = Signal(scenario.throttle);
    at(Control::clutch) = Signal(scenario.clutch);
    at(Control::gear) = Signal(scenario.gear);
    at(Control::hands_hold) = Signal(scenario.hands.time.empty() ? constant(1) : scenario.hands);
    at(Control::hands_torque) = Signal(scenario.steering_torque);
    at(Control::wind_x) = Signal(scenario.wind_x);
    at(Control::wind_y) = Signal(scenario.wind_y);
}

void Schedule::save(Memory& to) const {
    for (std::size_t i = 0; i < control_count; ++i) {
        to.follows[i] = signals_[i].follows();
        if (to.follows[i]) to.spans[i] = signals_[i].followed();
    }
    to.command_count = commands_.size();
    std::ranges::copy(commands(), to.commands.begin());
}

void Schedule::restore(const Memory& from) {
    for (std::size_t i = 0; i < control_count; ++i) {
        if (from.follows[i]) signals_[i].follow(from.spans[i]);
    }
    parks_ = parks_ || from.follows[static_cast<std::size_t>(Control::parking_brake)];
    set_commands({from.commands.data(), from.command_count});
}

}  // namespace hamilcar
