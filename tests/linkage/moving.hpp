// A linkage with a motion of its own: independent coordinates and rack are given functions of time.
#pragma once

#include "hamilcar/linkage/compose.hpp"
#include "linkage/motion.hpp"

namespace hamilcar::test {

inline constexpr double step = 1e-4;  // of differences [s, m, rad]
inline constexpr double gain = 40;    // alpha of the open loops [1/s]

class MovingLinkage {
public:
    using Independent = std::array<double, max_freedoms>;
    using Dependent = Vector<double, max_equations>;  // zero beyond the linkage's own
    using Position = LinkagePosition<double>;
    using Rack = RackMotion<double>;

    explicit MovingLinkage(const LinkageDescription& d) : linkage_(compose(d)) {}
    const Linkage<double>& linkage() const { return linkage_; }

    Independent V(double t) const {
        Independent V{};
        for (int i = 0; i < linkage_.nV(); ++i) V[i] = 0.04 * std::sin(7 * t + 0.3 + i);
        return V;
    }
    Independent V_rate(double t) const {
        Independent rate{};
        for (int i = 0; i < linkage_.nV(); ++i) rate[i] = 0.28 * std::cos(7 * t + 0.3 + i);
        return rate;
    }
    static Rack rack(double t) {
        return {0.02 * std::sin(5 * t - 0.4), 0.1 * std::cos(5 * t - 0.4), -0.5 * std::sin(5 * t - 0.4)};
    }

    Position position(const Independent& V, const Dependent& W, const Rack& rack, double alpha = 0) const {
        Position out;
        linkage_.find_position(V.data(), W.data(), rack, alpha, out);
        return out;
    }
    // Frames, columns and equations at coordinates in the order of the joints.
    Position loops(const std::array<double, max_coordinates>& q, const Rack& rack) const {
        std::array<double, max_coordinates> V, W;
        for (int i = 0; i < linkage_.nV(); ++i) V[i] = q[linkage_.independent[i]];
        for (int i = 0; i < linkage_.nW(); ++i) W[i] = q[linkage_.dependent[i]];
        Position out;
        linkage_.find_loops(V.data(), W.data(), rack, out);
        return out;
    }
    // W on the closed loops.
    Dependent closed(const Independent& V, const Rack& rack) const {
        Dependent W = Dependent::Zero();
        for (int i = 0; i < 12; ++i) linkage_.newton_step(V.data(), W.data(), rack);
        return W;
    }
    Position closed_position(const Independent& V, const Rack& rack) const {
        return position(V, closed(V, rack), rack);
    }
    Dependent opened(double t) const {
        Dependent W = closed(V(t), rack(t));
        for (int i = 0; i < linkage_.nW(); ++i) W[i] += 0.02 * std::cos(2.0 * i + 1);
        return W;
    }
    // W at t from W' = H V' + X with loops open at t0, by Runge-Kutta steps a quarter as long as the difference's.
    Dependent stabilized(double t0, double t) const {
        const double h = (t - t0) / 8;
        Dependent W = opened(t0);
        for (int i = 0; i < 8; ++i) {
            const double at = t0 + i * h;
            const Dependent k1 = W_rate(at, W), k2 = W_rate(at + h / 2, W + h / 2 * k1),
                            k3 = W_rate(at + h / 2, W + h / 2 * k2), k4 = W_rate(at + h, W + h * k3);
            W += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        return W;
    }

private:
    Dependent W_rate(double t, const Dependent& W) const {
        const Position at = position(V(t), W, rack(t), gain);
        const Independent rate = V_rate(t);
        Dependent out = Dependent::Zero();
        for (int i = 0; i < linkage_.nW(); ++i) {
            const int k = linkage_.dependent[i];
            out[i] = at.X[k];
            for (int j = 0; j < linkage_.nV(); ++j) out[i] += at.Y[k][j] * rate[j];
        }
        return out;
    }

    Linkage<double> linkage_;
};

}  // namespace hamilcar::test
