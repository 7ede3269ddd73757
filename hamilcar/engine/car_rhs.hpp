// The right-hand side of one car by its compiled program, for integrate() (block/integration.hpp).
#pragma once

#include "hamilcar/block/integration.hpp"
#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/engine/rhs_program.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

class CarRhs {
public:
    // As in RhsReport.
    struct Report {
        std::array<double, RhsReport::correction + state_capacity + max_measurements> numbers;
        Report() {}
        Health<double> health() const { return {numbers[RhsReport::violation], numbers[RhsReport::mobility]}; }
    };

    CarRhs(const RhsProgram& program, const Surface* surface) : program_(&program), surface_(surface) {}

    void evaluate(const Input<double>& input, const State<double>& state, State<double>& rate, Report& report) const {
        std::array<double, static_cast<std::size_t>(RhsInput::size) + max_commands> numbers;
        write(input, numbers.data());
        HAMILCAR_ASSERT(input.commands || program_->commands == 0);
        std::copy_n(input.commands, program_->commands, numbers.data() + RhsInput::size);
        const LaneSurfaces ground{&surface_, &input.time, 0};
        program::Frame frame{.functions = rhs_functions(Precision::double_precision), .context = &ground};
        frame.arrays[rhs_state] = const_cast<double*>(state.values.data());  // only read
        frame.arrays[rhs_input] = numbers.data();
        frame.arrays[rhs_rate] = rate.values.data();
        frame.arrays[rhs_report] = report.numbers.data();
        program_->run(frame);
    }
    static void include_health(const Report& further, Report& worst) {
        Health<double> health = worst.health();
        health.include(further.health());
        worst.numbers[RhsReport::violation] = health.violation;
        worst.numbers[RhsReport::mobility] = health.mobility;
    }
    void finish(const Report& first, State<double>& to) const {
        const std::vector<int>& indices = program_->correction_indices;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            to.values[static_cast<std::size_t>(indices[i])] += first.numbers[RhsReport::correction + i];
        }
        if (program_->chart == ChassisChart::quaternion) to.orientation() = normalized<double>(to.orientation());
    }

    void read_measurement(const Report& first, double* to) const {
        std::copy_n(first.numbers.data() + program_->measurement(), program_->measured, to);
    }

private:
    static void write(const Input<double>& from, double* to) {
        const std::array<double, RhsInput::size> numbers{from.rack.displacement,
                                                         from.rack.rate,
                                                         from.rack.acceleration,
                                                         from.drive_torque,
                                                         from.brake,
                                                         from.throttle,
                                                         from.clutch,
                                                         from.gear,
                                                         from.wind_x,
                                                         from.wind_y,
                                                         from.hands_hold,
                                                         from.hands_torque,
                                                         from.parking_brake};
        std::ranges::copy(numbers, to);
    }

    const RhsProgram* program_;
    const Surface* surface_;
};

// One step, in place. Returns the worst health of all evaluations; `measured` becomes what sensors read at the step's beginning, if
// they read anything.
Health<double> advance_car(const CarRhs& rhs, Integrator<State<double>>& integrator, const Schedule& schedule,
                           double time, State<double>& state, double* measured = nullptr);

}  // namespace hamilcar
