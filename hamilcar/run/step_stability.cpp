#include "hamilcar/run/step_stability.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/block/integration.hpp"
#include "hamilcar/math/dense.hpp"
#include "hamilcar/math/eigenvalues.hpp"
#include "hamilcar/vehicle/state_layout.hpp"

namespace hamilcar {

namespace {

using Complex = std::complex<double>;

constexpr double min_speed = 10, min_force = 1000;  // where it becomes worth looking again [m/s, N]
constexpr double grown = 2;

double speed_of(const Sample& s) {
    return linear(s.velocity.chassis).norm();
}

// Of all stops together.
double stop_force(const Sample& s) {
    double sum = 0;
    for (std::size_t i = 0; i < s.model.vehicle.suspensions.size(); ++i) {
        const std::size_t wheels = s.model.vehicle.suspensions[i].wheels.size();
        for (std::size_t w = 0; w < wheels; ++w) sum += std::abs(s.momenta.suspensions[i].wheels[w].stop);
    }
    return sum;
}

// Rates of the independent numbers, with dependent coordinates that fit them.
Eigen::VectorXd rates_of(const Sample& s, State<double>& state, const std::vector<int>& independent) {
    close_loops(s.model, rack_of(s.model.vehicle, state, s.input), state, 2);
    State<double> rate;
    evaluate_rhs(s.model, s.input, state, rate);
    Eigen::VectorXd out(static_cast<Eigen::Index>(independent.size()));
    for (std::size_t i = 0; i < independent.size(); ++i) {
        out[static_cast<Eigen::Index>(i)] = rate.values[static_cast<std::size_t>(independent[i])];
    }
    return out;
}

// As a controller may set them at any time.
void make_dampers_firm(const Vehicle<double>& vehicle, State<double>& state) {
    for (const Suspension<double>& suspension : vehicle.suspensions) {
        for (const SuspensionDamper<double>& damper : suspension.dampers) {
            if (damper.actuator < 0) continue;
            state.values.data()[vehicle.actuator_place + damper.actuator] = 1;
        }
    }
}

// One-sided, as a step meets what has a kink.
Eigen::MatrixXd jacobian(const Sample& s, const std::vector<int>& independent) {
    constexpr double share = 1e-7;
    State<double> state = s.state;
    make_dampers_firm(s.model.vehicle, state);
    const Eigen::VectorXd here = rates_of(s, state, independent);
    const State<double> closed = state;
    Eigen::MatrixXd out(here.size(), here.size());
    for (std::size_t i = 0; i < independent.size(); ++i) {
        const auto place = static_cast<std::size_t>(independent[i]);
        const double change = share * std::max(1.0, std::abs(closed.values[place]));
        state = closed;
        state.values[place] += change;
        out.col(static_cast<Eigen::Index>(i)) = (rates_of(s, state, independent) - here) / change;
    }
    return out;
}

// By inverse iteration, from a vector that has a part of everything.
Eigen::VectorXcd eigenvector(const Eigen::MatrixXd& A, Complex lambda) {
    const Complex beside = lambda * (1 + 1e-9);
    const Eigen::MatrixXcd shifted = A.cast<Complex>() - beside * Eigen::MatrixXcd::Identity(A.rows(), A.cols());
    Eigen::VectorXcd v = Eigen::VectorXcd::Ones(A.rows());
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i] += Complex(0, 1e-3 * static_cast<double>(i));
    for (int i = 0; i < 3; ++i) v = solve(shifted, v).normalized();
    return v;
}

// The number with the largest participation factor: its share in the mode times the mode's share in it, which no unit changes.
int participant(const Eigen::MatrixXd& A, Complex lambda) {
    const Eigen::VectorXcd right = eigenvector(A, lambda), left = eigenvector(A.transpose(), lambda);
    Eigen::Index most = 0;
    left.cwiseProduct(right).cwiseAbs().maxCoeff(&most);
    return static_cast<int>(most);
}

}  // namespace

StepLimit step_limit(const Sample& sample, const Method& method, double step, const std::vector<int>& independent) {
    const Eigen::MatrixXd A = jacobian(sample, independent);
    StepLimit out{.stable_step = step, .lambda = 0, .number = independent.front()};
    if (!A.allFinite()) return out;
    const Eigen::VectorXcd all = eigenvalues(A);
    const std::span<const Complex> lambda(all.data(), static_cast<std::size_t>(all.size()));
    if (is_stable(method, step, lambda)) return out;
    out.stable_step = stable_step(method, step, lambda);
    out.lambda =
        *std::ranges::max_element(lambda, {}, [&](const Complex& one) { return spurious_growth(method, step, one); });
    out.number = independent[static_cast<std::size_t>(participant(A, out.lambda))];
    return out;
}

StepStability::StepStability(const Simulation& simulation)
    : method_(simulation.scenario().solver.integrator), step_(simulation.scenario().solver.step) {
    chooses_steps_ = find_method(method_)->family == MethodFamily::embedded_runge_kutta;
    worst_.stable_step = step_;
    const StateLayout layout(simulation.vehicle());
    for (std::size_t i = 0; i < layout.numbers().size(); ++i) {
        const StateNumber& number = layout.numbers()[i];
        numbers_.push_back(number.name);
        if (number.kind == StateKind::dependent || number.kind == StateKind::work ||
            number.kind == StateKind::energy_supplied)
            continue;
        independent_.push_back(static_cast<int>(i));
    }
}

void StepStability::look(const Sample& sample) {
    const double speed = speed_of(sample), force = stop_force(sample);
    if (chooses_steps_ || is_exceeded() || (speed < next_speed_ && force < next_force_)) return;
    next_speed_ = grown * std::max(speed, min_speed), next_force_ = grown * std::max(force, min_force);
    worst_ = step_limit(sample, *find_method(method_), step_, independent_);
    time_ = sample.time;
}

std::vector<double> StepStability::marks() const {
    return {worst_.stable_step, worst_.lambda.real(), worst_.lambda.imag(), static_cast<double>(worst_.number), time_,
            next_speed_,        next_force_};
}

bool StepStability::take_marks(const double* m) {
    const double number = m[3];
    if (!(m[0] > 0 && m[0] <= step_ && number >= 0 && number < static_cast<double>(numbers_.size()))) return false;
    worst_ = {m[0], {m[1], m[2]}, static_cast<int>(number)};
    time_ = m[4], next_speed_ = m[5], next_force_ = m[6];
    return true;
}

}  // namespace hamilcar
