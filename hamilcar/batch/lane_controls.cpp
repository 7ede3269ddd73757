#include "hamilcar/batch/lane_controls.hpp"

namespace hamilcar {

LaneControls::LaneControls(const std::vector<RolloutCar>& lanes, long steps, double step)
    : cars_(lanes),
      interval_{0, steps, step},
      step_(step),
      driver_(static_cast<int>(lanes.size()), 0),
      times_{std::vector<double>(lanes.size())} {
    for (const RolloutCar& car : lanes) schedules_.push_back(car.simulation->schedule());
    for (std::size_t i = 0; i < lanes.size(); ++i) driver_.set_schedule(static_cast<int>(i), schedules_[i]);
}

void LaneControls::begin_row(std::size_t row, const std::vector<Row>& targets) {
    row_ = row, targets_ = targets, at_rest_ = false;
    slopes_.clear();
    interval_.begin = static_cast<double>(static_cast<long>(row) * interval_.steps) * step_;
    for (std::size_t lane = 0; lane < cars_.size(); ++lane) {
        const DirectControls& controls = *cars_[lane].controls;
        for (std::size_t i = 0; i < controls.list().size(); ++i) {
            controls.hold(i, targets[lane].from[i], interval_.begin, schedules_[lane], nullptr);
            controls.move(i, targets[lane].to[i], interval_, schedules_[lane], nullptr);
            slopes_.push_back({controls.slope(i, targets[lane].from[i]), controls.slope(i, targets[lane].to[i])});
        }
        driver_.set_schedule(static_cast<int>(lane), schedules_[lane]);
    }
}

void LaneControls::hold_end() {
    const double end = static_cast<double>(static_cast<long>(row_ + 1) * interval_.steps) * step_;
    for (std::size_t lane = 0; lane < cars_.size(); ++lane) {
        const DirectControls& controls = *cars_[lane].controls;
        for (std::size_t i = 0; i < controls.list().size(); ++i) {
            controls.hold(i, targets_[lane].to[i], end, schedules_[lane], nullptr);
        }
        driver_.set_schedule(static_cast<int>(lane), schedules_[lane]);
    }
    at_rest_ = true;
}

const LaneControls::Numbers& LaneControls::inputs(long step, double ahead) {
    const long count = static_cast<long>(row_) * interval_.steps + step;
    std::ranges::fill(times_.at, static_cast<double>(count) * step_);
    go_to(step, ahead);
    return driver_(times_, ahead);
}

template <class F>
void LaneControls::for_each_input(const F& f) const {
    const DirectControls& controls = *cars_[0].controls;
    for (std::size_t i = 0; i < controls.list().size(); ++i) {
        const Control which = controls.list()[i].control;
        const auto first = static_cast<std::size_t>(LaneDriver<double>::first_input[static_cast<std::size_t>(which)]);
        const SignalValue<double> share =
            at_rest_ ? SignalValue<double>{.value = 1} : controls.shape(i, interval_).at(place_);
        f(first, i, 1 - share.value, share.value);
        if (which != Control::rack) continue;
        f(first + 1, i, -share.rate, share.rate);
        f(first + 2, i, -share.acceleration, share.acceleration);
    }
}

void LaneControls::tangents(const std::vector<Row>& targets, double* to) const {
    std::fill_n(to, RhsInput::size * cars_.size(), 0.0);
    for_each_input([&](std::size_t input, std::size_t control, double before, double after) {
        for (std::size_t lane = 0; lane < cars_.size(); ++lane) {
            const Slopes& slope = slopes(lane, control);
            to[input * cars_.size() + lane] =
                before * slope.from * targets[lane].from[control] + after * slope.to * targets[lane].to[control];
        }
    });
}

void LaneControls::add_adjoints(const double* inputs, const std::vector<RowAdjoint>& targets) const {
    for_each_input([&](std::size_t input, std::size_t control, double before, double after) {
        for (std::size_t lane = 0; lane < cars_.size(); ++lane) {
            const Slopes& slope = slopes(lane, control);
            const double adjoint = inputs[input * cars_.size() + lane];
            targets[lane].from[control] += before * slope.from * adjoint;
            targets[lane].to[control] += after * slope.to * adjoint;
        }
    });
}

}  // namespace hamilcar
