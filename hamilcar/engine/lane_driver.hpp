// The inputs of all lanes: the current pieces of every lane's schedule, fetched again only when one of them ends.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "hamilcar/driver/schedule.hpp"
#include "hamilcar/engine/lane_numbers.hpp"
#include "hamilcar/engine/rhs_trace.hpp"

namespace hamilcar {

template <class E>
class LaneDriver {
public:
    explicit LaneDriver(int lanes)
        : lanes_(static_cast<std::size_t>(lanes)),
          schedules_(lanes_),
          pieces_(control_count * lanes_),
          inputs_(RhsInput::size * lanes_) {}

    void set_schedule(int lane, const Schedule& schedule) {
        schedules_[static_cast<std::size_t>(lane)] = &schedule;
        begin_ = 1, end_ = 0;  // no piece is valid
    }
    void copy_schedule(int from, int to) { set_schedule(to, *schedules_[static_cast<std::size_t>(from)]); }

    // The RhsInput of all lanes at one time [s].
    const LaneNumbers<E>& operator()(double time) {
        if (!(begin_ <= time && time < end_)) fetch(time);
        for (std::size_t control = 0; control < control_count; ++control) {
            if (!constant_[control]) evaluate(control, time);
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
    struct Piece {
        SignalPiece<E> piece;
        E start_high, start_low;  // [s]
    };

    // Where each control begins in RhsInput; the rack has its rates as well.
    static constexpr std::array<int, control_count> first_input{
        RhsInput::rack,   RhsInput::drive_torque, RhsInput::brake,  RhsInput::throttle,
        RhsInput::clutch, RhsInput::gear,         RhsInput::wind_x, RhsInput::wind_y};

    void evaluate(std::size_t control, double time) {
        const Parts t(time);
        const Piece* piece = &pieces_[control * lanes_];
        E* to = inputs_.data() + static_cast<std::size_t>(first_input[control]) * lanes_;
        for (std::size_t i = 0; i < lanes_; ++i) {
            const SignalValue<E> value =
                piece[i].piece.at((t.high - piece[i].start_high) + (t.low - piece[i].start_low));
            to[i] = value.value;
            if (control == static_cast<std::size_t>(Control::rack)) {
                to[lanes_ + i] = value.rate, to[2 * lanes_ + i] = value.acceleration;
            }
        }
    }

    void fetch(double time) {
        begin_ = -std::numeric_limits<double>::infinity(), end_ = -begin_;
        for (std::size_t control = 0; control < control_count; ++control) {
            constant_[control] = true;
            for (std::size_t i = 0; i < lanes_; ++i) fetch(control, i, time);
            evaluate(control, time);
        }
    }
    void fetch(std::size_t control, std::size_t lane, double time) {
        const Signal::Span& span = schedules_[lane]->signal(static_cast<Control>(control)).piece_at(time);
        begin_ = std::max(begin_, span.begin), end_ = std::min(end_, span.end);
        constant_[control] = constant_[control] && span.piece.inverse_duration == 0;
        const Parts start(span.start());
        const auto number = [](double value) { return static_cast<E>(value); };
        pieces_[control * lanes_ + lane] = {{number(span.piece.inverse_duration), number(span.piece.y0),
                                             number(span.piece.a), number(span.piece.b), number(span.piece.c)},
                                            start.high,
                                            start.low};
    }

    std::size_t lanes_;
    std::vector<const Schedule*> schedules_;
    std::vector<Piece> pieces_;                   // control by control
    std::array<bool, control_count> constant_{};  // in all lanes, between these times
    double begin_ = 1, end_ = 0;
    LaneNumbers<E> inputs_;
};

}  // namespace hamilcar
