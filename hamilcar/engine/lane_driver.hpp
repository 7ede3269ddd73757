// Drivers in lanes: the pieces of every lane's schedule, fetched anew only when one of them ends.
#pragma once

#include <algorithm>
#include <array>

#include "hamilcar/driver/schedule.hpp"

namespace hamilcar {

template <class T>
class LaneDriver {
public:
    static constexpr int lanes = lane_count<T>;

    void set_schedule(int lane, const Schedule& schedule) {
        schedules_[static_cast<std::size_t>(lane)] = &schedule;
        begin_ = 1, end_ = 0;  // nothing is in force
    }

    void copy_schedule(int from, int to) { set_schedule(to, *schedules_[static_cast<std::size_t>(from)]); }

    // All lanes at one time [s].
    Input<T> operator()(double time) {
        if (!(begin_ <= time && time < end_)) fetch(time);
        if (!constant_) return evaluate(time);
        constants_.time = time;
        return constants_;
    }

private:
    using Number = Element<T>;

    // A time in two parts, so that single precision does not wear out during a long run.
    struct Parts {
        Number high, low;
        explicit Parts(double time)
            : high(static_cast<Number>(time)), low(static_cast<Number>(time - static_cast<double>(high))) {}
    };

    struct Pieces {
        SignalPiece<T> piece;
        T start_high, start_low;  // [s]
        SignalValue<T> at(double time) const {
            const Parts t(time);
            return piece.at((T(t.high) - start_high) + (T(t.low) - start_low));
        }
    };

    Input<T> evaluate(double time) const {
        return input_of<T>(time, powered_, windy_,
                           [&](Control control) { return pieces_[static_cast<std::size_t>(control)].at(time); });
    }

    void fetch(double time) {
        constant_ = true, powered_ = windy_ = false;
        begin_ = -std::numeric_limits<double>::infinity(), end_ = -begin_;
        for (const Schedule* schedule : schedules_) {
            powered_ = powered_ || schedule->powered();
            windy_ = windy_ || schedule->windy();
        }
        for (std::size_t i = 0; i < control_count; ++i) fetch(pieces_[i], time, static_cast<Control>(i));
        constants_ = evaluate(time);
    }
    void fetch(Pieces& to, double time, Control control) {
        for (int i = 0; i < lanes; ++i) {
            const Signal::Span& span = schedules_[static_cast<std::size_t>(i)]->signal(control).piece_at(time);
            begin_ = std::max(begin_, span.begin), end_ = std::min(end_, span.end);
            constant_ = constant_ && span.piece.inverse_duration == 0;
            const Parts start(span.start());
            set_lane(to.start_high, i, start.high), set_lane(to.start_low, i, start.low);
            const auto set = [i](T& number, double value) { set_lane(number, i, static_cast<Number>(value)); };
            set(to.piece.inverse_duration, span.piece.inverse_duration);
            set(to.piece.y0, span.piece.y0), set(to.piece.a, span.piece.a);
            set(to.piece.b, span.piece.b), set(to.piece.c, span.piece.c);
        }
    }

    std::array<const Schedule*, static_cast<std::size_t>(lanes)> schedules_{};
    std::array<Pieces, control_count> pieces_;
    double begin_ = 1, end_ = 0;
    bool constant_ = false;                 // in all lanes, between these times
    bool powered_ = false, windy_ = false;  // in any lane
    Input<T> constants_;
};

}  // namespace hamilcar
