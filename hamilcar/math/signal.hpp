// A table over time as piecewise cubics, smooth enough for rates to be continuous.
#pragma once

#include <limits>
#include <vector>

#include "hamilcar/description/signal.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct SignalValue {
    T value{0}, rate{0}, acceleration{0};
};

// A cubic between two instants: y0 + s (a + s (b + s c)), s from 0 to 1.
template <class T>
struct SignalPiece {
    T inverse_duration{0};  // [1/s]; zero where the signal is constant
    T y0{0}, a{0}, b{0}, c{0};

    // At a time after the piece's start [s].
    SignalValue<T> at(const T& time) const {
        const T s = time * inverse_duration;
        return {y0 + s * (a + s * (b + s * c)), (a + s * (T(2) * b + s * (T(3) * c))) * inverse_duration,
                (T(2) * b + T(6) * s * c) * (inverse_duration * inverse_duration)};
    }
};

// One input over time. Smooth: monotone cubic Hermite pieces (Fritsch and Butland 1984), which never overshoot the table
// and have a continuous first derivative. Smoother: three cubic pieces between two points, monotone as well, whose second
// derivative is continuous and zero at the points. Linear: straight lines. Constant outside the table.
class Signal {
public:
    Signal() = default;
    // `scale` turns the table's unit into the input's.
    explicit Signal(const SignalDescription& description, double scale = 1);
    // From `time` on: value + rate t + acceleration t^2 / 2, with t since `time` [s]. Without allocation; `scale` is the time
    // scale of the polynomial [s].
    void follow(double time, const SignalValue<double>& now, double scale);
    // A piece that begins at `time` and goes on, until the next call.
    void follow(double time, const SignalPiece<double>& piece) { follow(Span{piece, time, forever}); }

    // A piece and its interval of validity.
    struct Span {
        SignalPiece<double> piece;
        double begin, end;  // [s]
        double start() const { return piece.inverse_duration == 0 ? 0 : begin; }
    };
    // For checkpoints: the piece set by follow(). A signal without one needs no memory.
    bool follows() const { return follows_; }
    const Span& followed() const { return spans_[0]; }
    void follow(const Span& span) {
        spans_.resize(1);
        spans_[0] = span;
        follows_ = true;
    }

    SignalValue<double> at(double time) const {
        const Span& span = piece_at(time);
        return span.piece.at(time - span.start());
    }
    const Span& piece_at(double time) const {
        std::size_t first = 0, count = spans_.size() - 1;  // the last piece never ends
        while (count > 0) {
            const std::size_t half = count / 2;
            const bool later = time >= spans_[first + half].end;
            first = later ? first + half + 1 : first;
            count = later ? count - half - 1 : half;
        }
        return spans_[first];
    }

private:
    static constexpr double forever = std::numeric_limits<double>::infinity();
    std::vector<Span> spans_{Span{{}, -forever, forever}};
    bool follows_ = false;
};

}  // namespace hamilcar
