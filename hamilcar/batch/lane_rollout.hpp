// As many runs of a rollout as a program has lanes, forwards and backwards.
#pragma once

#include "hamilcar/batch/lane_controls.hpp"
#include "hamilcar/batch/rollout_rhs.hpp"

namespace hamilcar {

// Runs [first, first + lanes) of all, or those up to the last; what lanes without a run compute is not used.
struct LaneRuns {
    std::span<const RolloutCar> cars;  // of all runs
    const RolloutNumbers* numbers;     // of all runs
    std::size_t rows, first;
    long steps;                         // of a row
    const std::function<bool()>& stop;  // as in Rollout::set_stop; may be empty
};

class LaneRollout {
public:
    // The programs that it runs must have been made.
    LaneRollout(RolloutPrograms& programs, const LaneRuns& runs, const RolloutNumbers* along = nullptr);

    void run(RolloutResults& out, RolloutResults* changes);
    void gradient(const RolloutResults& weights, RolloutNumbers& out);
    // As Rollout::closed; `states`: the directions of all runs.
    void close(std::vector<double>& states);

private:
    using Numbers = LaneNumbers<double>;

    std::size_t run_of(std::size_t lane) const { return std::min(runs_.first + lane, runs_.cars.size() - 1); }
    bool stops() const { return runs_.stop && runs_.stop(); }
    bool is_used(std::size_t lane) const { return runs_.first + lane < runs_.cars.size(); }
    std::size_t control_count(std::size_t run) const { return runs_.cars[run].controls->list().size(); }
    std::size_t place_of_controls(std::size_t run, std::size_t row) const {
        return (run * (runs_.rows + 1) + row) * control_count(run);
    }
    std::vector<LaneControls::Row> targets(const RolloutNumbers& of, std::size_t row) const;
    std::vector<RolloutCar> cars() const;
    void start();
    void set_lanes(const std::vector<double>& from, std::size_t count, double* to) const;
    RolloutRhs::Input input_at(long step, double ahead);
    void do_row(std::size_t row, std::vector<StepRecord>* records);
    void check(const Numbers& state);
    // Reads the channels after a row that was done.
    void read(std::size_t row, RolloutResults& out, RolloutResults* changes);
    void write_ends(RolloutResults& out, RolloutResults* changes) const;

    // Backwards. Adjoints of the state, of the parameters, and of the controls, where `gradient` gives them.
    struct Adjoints {
        Numbers state, parameters;
        Numbers report, read_state, read_input, read_parameters;  // scratch
        std::vector<Numbers> rates;                               // of the stages
        std::vector<LaneControls::RowAdjoint> controls;
    };
    Adjoints new_adjoints() const;
    void add_channels(std::size_t row, const RolloutResults& weights, Adjoints& adjoints);
    void step_back(long step, const StepRecord& record, Adjoints& adjoints);
    void run_back(const program::Executable& program, const RolloutRhs::Input& input, const Numbers& state,
                  Numbers& results, Adjoints& adjoints);

    RolloutPrograms* programs_;
    LaneRuns runs_;
    const RolloutNumbers* along_;
    std::size_t lanes_;
    double step_;
    RolloutRhs rhs_;
    LaneControls controls_;
    Integrator<Numbers> integrator_;
    Numbers inputs_, now_;
    RolloutRhs::Report first_, further_;
    std::vector<bool> failed_;
};

}  // namespace hamilcar
