// One car on its compiled program: a ring for integrate() (block/integration.hpp).
#pragma once

#include "hamilcar/block/integration.hpp"
#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/engine/turn_program.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

class CarRing {
public:
    // What TurnReport lists.
    struct Report {
        std::array<double, TurnReport::closing + state_capacity> numbers;
        Report() {}
        Health<double> health() const { return {numbers[TurnReport::violation], numbers[TurnReport::mobility]}; }
    };

    CarRing(const TurnProgram& program, const Surface* surface) : program_(&program), surface_(surface) {}

    void turn(const Input<double>& input, const State<double>& state, State<double>& rate, Report& report) const {
        std::array<double, TurnInput::size> numbers;
        write(input, numbers);
        const GroundBelowLanes ground{&surface_, input.time};
        program::Frame frame{.functions = turn_functions(Precision::double_precision), .context = &ground};
        frame.arrays[turn_state] = const_cast<double*>(state.values.data());  // only read
        frame.arrays[turn_input] = numbers.data();
        frame.arrays[turn_rate] = rate.values.data();
        frame.arrays[turn_report] = report.numbers.data();
        program_->run(frame);
    }
    static void include_health(const Report& further, Report& worst) {
        Health<double> health = worst.health();
        health.include(further.health());
        worst.numbers[TurnReport::violation] = health.violation;
        worst.numbers[TurnReport::mobility] = health.mobility;
    }
    void finish(const Report& first, State<double>& to) const {
        const std::vector<int>& places = program_->closing_places;
        for (std::size_t i = 0; i < places.size(); ++i) {
            to.values[static_cast<std::size_t>(places[i])] += first.numbers[TurnReport::closing + i];
        }
        if (program_->chart == ChassisChart::quaternion) to.orientation() = normalized<double>(to.orientation());
    }

private:
    static void write(const Input<double>& from, std::array<double, TurnInput::size>& to) {
        to = {from.rack.displacement,
              from.rack.rate,
              from.rack.acceleration,
              from.drive_torque,
              from.brake,
              from.throttle,
              from.clutch,
              from.gear,
              from.wind_x,
              from.wind_y};
    }

    const TurnProgram* program_;
    const Surface* surface_;
};

// One step, in place. Returns the worst health met on the way.
Health<double> advance_car(const CarRing& ring, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state);

}  // namespace hamilcar
