// The right-hand side of a car in each lane by their compiled program, for integrate() (block/integration.hpp).
#pragma once

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/lane_numbers.hpp"
#include "hamilcar/engine/rhs_program.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

template <class E>
class LaneRhs {
public:
    using Numbers = LaneNumbers<E>;
    // As in RhsReport.
    struct Report {
        Numbers numbers;
        std::size_t lanes;
        Health<E> health(std::size_t lane) const {
            return {numbers.values[RhsReport::violation * lanes + lane],
                    numbers.values[RhsReport::mobility * lanes + lane]};
        }
    };
    // Inputs of all lanes, at a time `ahead` of that of each [s].
    struct Input {
        const Numbers& numbers;
        const double* times;
        double ahead;
    };

    explicit LaneRhs(const RhsProgram& program)
        : program_(&program),
          lanes_(static_cast<std::size_t>(program.executable->lanes())),
          parameters_(program.parameters.size() * lanes_),
          surfaces_(lanes_),
          correction_runs_(runs(program.correction_indices)) {}

    Report report() const { return {Numbers(static_cast<std::size_t>(program_->report_size()) * lanes_), lanes_}; }

    void set_car(int lane, const Model<double>& model) {
        const std::vector<double> numbers = numbers_of(model).numbers;
        const auto at = static_cast<std::size_t>(lane);
        for (std::size_t i = 0; i < program_->parameters.size(); ++i) {
            parameters_.values[i * lanes_ + at] =
                static_cast<E>(numbers[static_cast<std::size_t>(program_->parameters[i])]);
        }
        surfaces_[at] = model.surface;
    }
    void copy_car(int from, int to) {
        copy_lane(parameters_, static_cast<int>(lanes_), from, to);
        surfaces_[static_cast<std::size_t>(to)] = surfaces_[static_cast<std::size_t>(from)];
    }

    void evaluate(const Input& input, const Numbers& state, Numbers& rate, Report& report) const {
        run(*program_->executable, input, state, rate.data(), report.numbers.data());
    }
    // Another program of the same cars.
    void run(const program::Executable& executable, const Input& input, const Numbers& state, E* results,
             E* report = nullptr) const {
        const LaneSurfaces ground{surfaces_.data(), input.times, input.ahead};
        program::Frame frame{.functions = rhs_functions(executable.precision()), .context = &ground};
        const auto read = [](const Numbers& numbers) { return const_cast<E*>(numbers.data()); };
        frame.arrays[rhs_state] = read(state);
        frame.arrays[rhs_input] = read(input.numbers);
        frame.arrays[rhs_parameters] = read(parameters_);
        frame.arrays[rhs_rate] = results;
        frame.arrays[rhs_report] = report;
        executable.run(frame);
    }
    static void include_health(const Report& further, Report& worst) {
        for (std::size_t i = 0; i < worst.lanes; ++i) {
            Health<E> health = worst.health(i);
            health.include(further.health(i));
            worst.numbers.values[RhsReport::violation * worst.lanes + i] = health.violation;
            worst.numbers.values[RhsReport::mobility * worst.lanes + i] = health.mobility;
        }
    }
    void finish(const Report& first, Numbers& to) const {
        const E* correction = first.numbers.data() + RhsReport::correction * lanes_;
        for (const auto& [first_index, count] : correction_runs_) {
            add_scaled(E(1), correction, to.data() + first_index * lanes_, static_cast<int>(count * lanes_));
            correction += count * lanes_;
        }
        if (program_->chart == ChassisChart::quaternion) normalize(to);
    }

private:
    // Consecutive numbers of the state.
    struct Run {
        std::size_t first, count;
    };
    static std::vector<Run> runs(const std::vector<int>& indices) {
        std::vector<Run> out;
        for (const int one : indices) {
            const auto index = static_cast<std::size_t>(one);
            if (!out.empty() && out.back().first + out.back().count == index) {
                ++out.back().count;
            } else {
                out.push_back({index, 1});
            }
        }
        return out;
    }

    // The quaternions of all lanes.
    void normalize(Numbers& to) const {
        constexpr std::size_t first = 3;  // index of the orientation in a state
        E *x = to.data() + first * lanes_, *y = x + lanes_, *z = y + lanes_, *w = z + lanes_;
#pragma GCC ivdep
        for (std::size_t i = 0; i < lanes_; ++i) {
            const E scale = normalizing_factor<E>(x[i], y[i], z[i], w[i]);
            x[i] *= scale, y[i] *= scale, z[i] *= scale, w[i] *= scale;
        }
    }

    const RhsProgram* program_;
    std::size_t lanes_;
    Numbers parameters_;
    std::vector<const Surface*> surfaces_;
    std::vector<Run> correction_runs_;
};

}  // namespace hamilcar
