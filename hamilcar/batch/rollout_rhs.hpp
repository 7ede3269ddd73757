// The right-hand side of a rollout's lanes for integrate(), plain or with tangents, whose numbers lie behind those that they belong to.
#pragma once

#include "hamilcar/batch/rollout_programs.hpp"
#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/lane_numbers.hpp"
#include "hamilcar/road/traced_ground.hpp"

namespace hamilcar {

// What a step's adjoint needs of it.
struct StepRecord {
    struct Stage {
        LaneNumbers<double> state;
        double ahead;  // of the step's beginning [s]
    };
    std::vector<Stage> stages;
    LaneNumbers<double> orientation;  // before it is normalized
};

class RolloutRhs {
public:
    using Numbers = LaneNumbers<double>;
    struct Report {
        Numbers numbers;
    };
    struct Input {
        const Numbers& numbers;
        const double* times;
        double ahead;
    };

    RolloutRhs(const RolloutPrograms& programs, const RolloutPrograms::Pair& program, bool has_tangents)
        : programs_(&programs),
          program_(&program),
          lanes_(static_cast<std::size_t>(programs.lanes())),
          copies_(has_tangents ? 2 : 1),
          parameters_(copies_ * programs.parameters().size() * lanes_),
          surfaces_(lanes_) {}

    std::size_t state_count() const { return copies_ * programs_->state_size() * lanes_; }
    Report report() const { return {Numbers(copies_ * programs_->report_size() * lanes_)}; }
    double& parameter(std::size_t i, std::size_t lane) { return parameters_.values[i * lanes_ + lane]; }
    void set_surface(std::size_t lane, const Surface* surface) { surfaces_[lane] = surface; }
    void record(StepRecord* to) { record_ = to; }

    void evaluate(const Input& input, const Numbers& state, Numbers& rate, Report& report) const {
        if (record_) record_->stages.push_back({state, input.ahead});
        run(*program_->rhs, input, state, [&](program::Frame& frame) {
            frame.arrays[rhs_rate] = rate.data();
            frame.arrays[rhs_report] = report.numbers.data();
        });
    }
    // One of the programs of these cars; `set` sets the arrays besides those that are read.
    template <class Set>
    void run(const program::Executable& executable, const Input& input, const Numbers& state, const Set& set) const {
        const LaneSurfaces ground{surfaces_.data(), input.times, input.ahead};
        program::Frame frame{.functions = rhs_functions(Precision::double_precision), .context = &ground};
        const auto read = [](const Numbers& numbers) { return const_cast<double*>(numbers.data()); };
        frame.arrays[rhs_state] = read(state);
        frame.arrays[rhs_input] = read(input.numbers);
        frame.arrays[rhs_parameters] = read(parameters_);
        set(frame);
        executable.run(frame);
    }
    static void include_health(const Report&, Report&) {
    }  // the first evaluation of the next step sees what a stage found

    void finish(const Report& first, Numbers& to) const {
        const std::vector<int>& indices = programs_->correction_indices();
        for (std::size_t copy = 0; copy < copies_; ++copy) {
            const double* correction =
                first.numbers.data() + (copy * programs_->report_size() + std::size_t{RhsReport::correction}) * lanes_;
            double* state = to.data() + copy * programs_->state_size() * lanes_;
            for (const int index : indices) {
                double* number = state + static_cast<std::size_t>(index) * lanes_;
                for (std::size_t i = 0; i < lanes_; ++i) number[i] += *correction++;
            }
        }
        if (programs_->chart() == ChassisChart::quaternion) normalize(to);
    }
    // What normalizing does to adjoints, in place; `before`: the quaternions as they were.
    void adjoint_of_normalizing(const Numbers& before, Numbers& adjoint) const {
        const double* q = before.data();
        double* a = adjoint.data() + orientation * lanes_;
        for (std::size_t i = 0; i < lanes_; ++i) {
            const auto at = [&](auto* numbers, std::size_t k) -> auto& {
                return numbers[k * lanes_ + i];
            };
            const double scale = normalizing_factor(at(q, 0), at(q, 1), at(q, 2), at(q, 3));
            double product = 0;
            for (std::size_t k = 0; k < 4; ++k) product += at(q, k) * at(a, k);
            for (std::size_t k = 0; k < 4; ++k) at(a, k) = scale * at(a, k) - product * at(q, k);
        }
    }

    static constexpr std::size_t orientation = 3;  // its index in a state

private:
    void normalize(Numbers& to) const {
        double* q = to.data() + orientation * lanes_;
        if (record_) record_->orientation.values.assign(q, q + 4 * lanes_);
        for (std::size_t i = 0; i < lanes_; ++i) {
            const auto at = [&](double* numbers, std::size_t k) -> double& { return numbers[k * lanes_ + i]; };
            const double scale = normalizing_factor(at(q, 0), at(q, 1), at(q, 2), at(q, 3));
            if (copies_ == 2) {
                double *tangent = q + programs_->state_size() * lanes_, product = 0;
                for (std::size_t k = 0; k < 4; ++k) product += at(q, k) * at(tangent, k);
                for (std::size_t k = 0; k < 4; ++k) at(tangent, k) = scale * at(tangent, k) - product * at(q, k);
            }
            for (std::size_t k = 0; k < 4; ++k) at(q, k) *= scale;
        }
    }

    const RolloutPrograms* programs_;
    const RolloutPrograms::Pair* program_;
    std::size_t lanes_, copies_;
    Numbers parameters_;
    std::vector<const Surface*> surfaces_;
    StepRecord* record_ = nullptr;
};

}  // namespace hamilcar
