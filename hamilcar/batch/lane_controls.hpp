// The controls of a rollout's row in each lane: inputs of the right-hand side over time, and how they change with the targets that they
// go between.
#pragma once

#include <span>

#include "hamilcar/batch/rollout.hpp"
#include "hamilcar/engine/lane_driver.hpp"

namespace hamilcar {

class LaneControls {
public:
    using Numbers = LaneNumbers<double>;

    // A car for each lane.
    LaneControls(const std::vector<RolloutCar>& lanes, long steps, double step);

    // Targets of one lane: where its controls are at a row's beginning and at its end, each a number for each control.
    struct Row {
        const double *from = nullptr, *to = nullptr;
    };
    // Of all lanes; the rows stay where they are until the next one.
    void begin_row(std::size_t row, const std::vector<Row>& targets);
    // Before the row, or after it: at rest at its beginning or its end.
    void hold_end();

    // Inputs of all lanes at a step of the row, so far ahead of it [s].
    const Numbers& inputs(long step, double ahead);
    const LaneTimes& times() const { return times_; }  // of the step

    // With tangents of the targets those of the inputs, at the place of the latest `inputs`: input i of lane l goes to [i * lanes + l].
    void tangents(const std::vector<Row>& targets, double* to) const;
    // With adjoints of the inputs those of the targets, added to those of each lane.
    struct RowAdjoint {
        double *from = nullptr, *to = nullptr;
    };
    void add_adjoints(const double* inputs, const std::vector<RowAdjoint>& targets) const;
    // The place of an earlier `inputs`.
    void go_to(long step, double ahead) { place_ = static_cast<double>(step) * step_ + ahead; }

private:
    // Calls f(input, control, weight of the target before, of that after) for each input that a control moves; the weights are of the
    // schedule's numbers.
    template <class F>
    void for_each_input(const F& f) const;
    struct Slopes {
        double from, to;
    };
    const Slopes& slopes(std::size_t lane, std::size_t control) const {
        return slopes_[lane * cars_[0].controls->list().size() + control];
    }

    std::vector<RolloutCar> cars_;
    DirectControls::Interval interval_;
    double step_;
    std::vector<Schedule> schedules_;
    LaneDriver<double> driver_;
    LaneTimes times_;
    std::vector<Row> targets_;
    std::vector<Slopes> slopes_;  // of the schedule's numbers by the targets, lane by lane
    std::size_t row_ = 0;
    double place_ = 0;  // in the row [s]
    bool at_rest_ = false;
};

}  // namespace hamilcar
