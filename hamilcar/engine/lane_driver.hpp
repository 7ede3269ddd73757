// The inputs of all lanes, each at its own time: the current pieces of every lane's schedule, fetched again only when one of
// them ends.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/engine/lane_numbers.hpp"
#include "hamilcar/engine/rhs_trace.hpp"

namespace hamilcar {

// Of the lanes, each its own [s]; mostly they are the same.
struct LaneTimes {
    std::vector<double> at;
    bool same = true;
};

template <class E>
class LaneDriver {
public:
    // Where each control begins in RhsInput; the rack has its rates as well.
    static constexpr std::array<int, control_count> first_input{
        RhsInput::rack,       RhsInput::drive_torque, RhsInput::brake,        RhsInput::throttle,
        RhsInput::clutch,     RhsInput::gear,         RhsInput::wind_x,       RhsInput::wind_y,
        RhsInput::hands_hold, RhsInput::hands_torque, RhsInput::parking_brake};

    LaneDriver(int lanes, int commands)
        : lanes_(static_cast<std::size_t>(lanes)),
          commands_(static_cast<std::size_t>(commands)),
          schedules_(lanes_),
          valid_(lanes_),
          pieces_(control_count * lanes_),
          inputs_((RhsInput::size + commands_) * lanes_) {}

    void set_schedule(int lane, const Schedule& schedule) {
        schedules_[static_cast<std::size_t>(lane)] = &schedule;
        valid_[static_cast<std::size_t>(lane)] = all_valid_ = {1, 0};
    }
    void copy_schedule(int from, int to) { set_schedule(to, *schedules_[static_cast<std::size_t>(from)]); }

    // The inputs of all lanes as in RhsInput, so far ahead of the times of each [s].
    const LaneNumbers<E>& operator()(const LaneTimes& times, double ahead) {
        if (!is_valid(times, ahead)) fetch(times, ahead);
        for (std::size_t control = 0; control < control_count; ++control) {
            if (!constant_[control]) evaluate(control, times, ahead);
        }
        return inputs_;
    }

private:
    // A time in two parts, so that single precision keeps its accuracy during a long run.
    struct Parts {
        E high, low;
        explicit Parts(double time)
            : high(static_cast<E>(time)), low(static_cast<E>(time - static_cast<double>(high))) {}
    };
    struct Interval {
        double begin = 1, end = 0;  // of the lane's own time [s]
        bool holds(double time) const { return begin <= time && time < end; }
    };
    struct Piece {
        SignalPiece<E> piece;
        E start_high, start_low;  // [s]
    };

    bool is_valid(const LaneTimes& times, double ahead) const {
        if (times.same) return all_valid_.holds(times.at[0] + ahead);
        bool valid = true;
        for (std::size_t i = 0; i < lanes_; ++i) valid &= valid_[i].holds(times.at[i] + ahead);
        return valid;
    }

    void evaluate(std::size_t control, const LaneTimes& times, double ahead) {
        if (times.same) return evaluate(control, [t = Parts(times.at[0] + ahead)](std::size_t) { return t; });
        evaluate(control, [&](std::size_t lane) { return Parts(times.at[lane] + ahead); });
    }
    template <class TimeOf>
    void evaluate(std::size_t control, const TimeOf& time_of) {
        const Piece* piece = &pieces_[control * lanes_];
        E* to = inputs_.data() + static_cast<std::size_t>(first_input[control]) * lanes_;
        for (std::size_t i = 0; i < lanes_; ++i) {
            const Parts t = time_of(i);
            const SignalValue<E> value =
                piece[i].piece.at((t.high - piece[i].start_high) + (t.low - piece[i].start_low));
            to[i] = value.value;
            if (control == static_cast<std::size_t>(Control::rack)) {
                to[lanes_ + i] = value.rate, to[2 * lanes_ + i] = value.acceleration;
            }
        }
    }

    void fetch(const LaneTimes& times, double ahead) {
        constexpr double endless = std::numeric_limits<double>::infinity();
        std::ranges::fill(valid_, Interval{-endless, endless});
        all_valid_ = {-endless, endless};
        for (std::size_t control = 0; control < control_count; ++control) {
            constant_[control] = true;
            for (std::size_t i = 0; i < lanes_; ++i) fetch(control, i, times.at[i] + ahead);
            evaluate(control, times, ahead);
        }
        for (std::size_t i = 0; i < lanes_; ++i) {
            const std::span<const double> told = schedules_[i]->commands();
            HAMILCAR_ASSERT(told.size() == commands_);
            for (std::size_t k = 0; k < commands_; ++k) {
                inputs_.values[(RhsInput::size + k) * lanes_ + i] = static_cast<E>(told[k]);
            }
        }
    }
    void fetch(std::size_t control, std::size_t lane, double time) {
        const Signal::Span& span = schedules_[lane]->signal(static_cast<Control>(control)).piece_at(time);
        for (Interval* interval : {&valid_[lane], &all_valid_}) {
            interval->begin = std::max(interval->begin, span.begin);
            interval->end = std::min(interval->end, span.end);
        }
        constant_[control] = constant_[control] && span.piece.inverse_duration == 0;
        const Parts start(span.start());
        const auto number = [](double value) { return static_cast<E>(value); };
        pieces_[control * lanes_ + lane] = {{number(span.piece.inverse_duration), number(span.piece.y0),
                                             number(span.piece.a), number(span.piece.b), number(span.piece.c)},
                                            start.high,
                                            start.low};
    }

    std::size_t lanes_, commands_;
    std::vector<const Schedule*> schedules_;
    std::vector<Interval> valid_;                 // the pieces below
    Interval all_valid_;                          // in all lanes, where their times are the same
    std::vector<Piece> pieces_;                   // control by control
    std::array<bool, control_count> constant_{};  // in all lanes, while their pieces are valid
    LaneNumbers<E> inputs_;
};

}  // namespace hamilcar
