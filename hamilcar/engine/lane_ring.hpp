// A car in each lane on their compiled program: a ring for integrate() (block/integration.hpp).
#pragma once

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/lane_numbers.hpp"
#include "hamilcar/engine/turn_program.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

template <class E>
class LaneRing {
public:
    using Numbers = LaneNumbers<E>;
    // What TurnReport lists.
    struct Report {
        Numbers numbers;
        std::size_t lanes;
        Health<E> health(std::size_t lane) const {
            return {numbers.values[TurnReport::violation * lanes + lane],
                    numbers.values[TurnReport::mobility * lanes + lane]};
        }
    };
    // Inputs of all lanes, at a time [s].
    struct Input {
        const Numbers& numbers;
        double time;
    };

    explicit LaneRing(const TurnProgram& program)
        : program_(&program),
          lanes_(static_cast<std::size_t>(program.executable->lanes())),
          parameters_(program.parameters.size() * lanes_),
          surfaces_(lanes_),
          closing_runs_(runs(program.closing_places)) {}

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

    void turn(const Input& input, const Numbers& state, Numbers& rate, Report& report) const {
        const GroundBelowLanes ground{surfaces_.data(), input.time};
        program::Frame frame{.functions = turn_functions(program_->executable->precision()), .context = &ground};
        const auto read = [](const Numbers& numbers) { return const_cast<E*>(numbers.data()); };
        frame.arrays[turn_state] = read(state);
        frame.arrays[turn_input] = read(input.numbers);
        frame.arrays[turn_parameters] = read(parameters_);
        frame.arrays[turn_rate] = rate.data();
        frame.arrays[turn_report] = report.numbers.data();
        program_->run(frame);
    }
    static void include_health(const Report& further, Report& worst) {
        for (std::size_t i = 0; i < worst.lanes; ++i) {
            Health<E> health = worst.health(i);
            health.include(further.health(i));
            worst.numbers.values[TurnReport::violation * worst.lanes + i] = health.violation;
            worst.numbers.values[TurnReport::mobility * worst.lanes + i] = health.mobility;
        }
    }
    void finish(const Report& first, Numbers& to) const {
        const E* closing = first.numbers.data() + TurnReport::closing * lanes_;
        for (const auto& [place, count] : closing_runs_) {
            add_scaled(E(1), closing, to.data() + place * lanes_, static_cast<int>(count * lanes_));
            closing += count * lanes_;
        }
        if (program_->chart == ChassisChart::quaternion) normalize(to);
    }

private:
    // Numbers of the state that stand in a row.
    struct Run {
        std::size_t place, count;
    };
    static std::vector<Run> runs(const std::vector<int>& places) {
        std::vector<Run> out;
        for (const int one : places) {
            const auto place = static_cast<std::size_t>(one);
            if (!out.empty() && out.back().place + out.back().count == place) {
                ++out.back().count;
            } else {
                out.push_back({place, 1});
            }
        }
        return out;
    }

    // All lanes side by side.
    void normalize(Numbers& to) const {
        constexpr std::size_t first = 3;  // place of the orientation in a state
        E *x = to.data() + first * lanes_, *y = x + lanes_, *z = y + lanes_, *w = z + lanes_;
#pragma GCC ivdep
        for (std::size_t i = 0; i < lanes_; ++i) {
            const E scale = normalizing_factor<E>(x[i], y[i], z[i], w[i]);
            x[i] *= scale, y[i] *= scale, z[i] *= scale, w[i] *= scale;
        }
    }

    const TurnProgram* program_;
    std::size_t lanes_;
    Numbers parameters_;
    std::vector<const Surface*> surfaces_;
    std::vector<Run> closing_runs_;
};

}  // namespace hamilcar
