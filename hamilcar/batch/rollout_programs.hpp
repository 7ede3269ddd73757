// The programs of a rollout: the right-hand side and what is read off the car, each with its tangents and its adjoint; the
// derivatives made when they are first asked for.
#pragma once

#include <memory>
#include <span>

#include "hamilcar/engine/traced_sample.hpp"
#include "hamilcar/program/derivative.hpp"

namespace hamilcar {

// Arrays of the adjoint programs besides those of RhsArray: rates and report hold the adjoints of what the right-hand side writes there,
// and these receive those of what it reads.
enum RolloutArray : int { rollout_state_adjoint = rhs_report + 1, rollout_input_adjoint, rollout_parameter_adjoint };

class RolloutPrograms {
public:
    // `cars` have one structure; numbers in which they differ become parameters.
    RolloutPrograms(std::span<const Model<double>* const> cars, const TracedReaders& readers, const Engine& engine);

    // A right-hand side, and the same for what is read, whose results are in the array of the rates.
    struct Pair {
        std::unique_ptr<const program::Executable> rhs, sample;
    };
    const Pair& plain() const { return plain_; }
    const Pair& with_tangents();  // tangents lie behind the numbers of each array
    const Pair& adjoint();

    int lanes() const { return plain_.rhs->lanes(); }
    std::size_t state_size() const { return state_size_; }
    std::size_t report_size() const { return RhsReport::correction + rhs_.correction_indices.size(); }
    std::size_t channel_count() const { return channel_count_; }
    const std::vector<int>& parameters() const { return rhs_.parameters; }
    std::vector<double> parameters_of(const Model<double>& car) const;
    const std::vector<int>& correction_indices() const { return rhs_.correction_indices; }
    ChassisChart chart() const { return chart_; }

private:
    std::unique_ptr<const program::Executable> made(const program::Graph& graph) const;

    const Engine* engine_;
    RhsTrace rhs_, sample_;
    std::size_t state_size_, channel_count_;
    ChassisChart chart_;
    Pair plain_, with_tangents_, adjoint_;
};

}  // namespace hamilcar
