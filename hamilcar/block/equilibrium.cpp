#include "hamilcar/block/equilibrium.hpp"

#include <Eigen/Dense>

#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/block/integration.hpp"

namespace hamilcar {

namespace {

double rolling_radius(const Spoke<double>& spoke) {
    return std::visit([](const auto& tire) { return tire.rolling_radius; }, spoke.tire);
}

// Deflections and wind-up with which the wheels carry the weight's pull along the road: across it every wheel by its load,
// along it the braked ones, if their brakes can.
void hold_on_slope(const Model<double>& model, const Input<double>& input, const Momenta<double>& momenta,
                   const Vec3<double>& gravity, State<double>& state) {
    const int count = model.vehicle.spoke_count();
    const auto braking_torque = [&](int i) { return input.brake * model.vehicle.spokes[i].brake.max_torque; };
    const auto load = [&](int i) { return momenta.spokes[i].forces.tire.Fz; };
    double total_load = 0, braked_load = 0;
    for (int i = 0; i < count; ++i) {
        total_load += load(i);
        if (braking_torque(i) > 0) braked_load += load(i);
    }
    const double share = braked_load > 0 ? total_load / braked_load : 0;
    std::array<double, max_spokes> along{}, across{};  // forces per load
    bool brakes_hold = braked_load > 0;
    for (int i = 0; i < count; ++i) {
        const SpokeForces<double>& f = momenta.spokes[i].forces;
        const double pressing = -gravity.dot(f.frame.normal);
        along[i] = braking_torque(i) > 0 ? -share * gravity.dot(f.frame.longitudinal) / pressing : 0;
        across[i] = -gravity.dot(f.frame.lateral) / pressing;
        const double radius = rolling_radius(model.vehicle.spokes[i]);
        brakes_hold = brakes_hold && std::abs(along[i] * load(i)) * radius <= braking_torque(i);
    }
    for (int i = 0; i < count; ++i) {
        const Spoke<double>& spoke = model.vehicle.spokes[i];
        const double x = brakes_hold ? along[i] : 0.0;
        const auto deflection =
            std::visit([&](const auto& tire) { return tire.holding(x, across[i], load(i)); }, spoke.tire);
        const bool carries = deflection.u != 0;
        state.spoke(i).deflection_x = deflection.u;
        state.spoke(i).deflection_y = deflection.v;
        state.spoke(i).brake_windup = carries ? -rolling_radius(spoke) * x * load(i) * spoke.brake.compliance : 0.0;
    }
}

// The equilibrium problem: unknowns heave, roll, pitch, then every V; residuals force along the road's normal, moments
// about the center of mass along chassis x and y, then every P_V'.
class Equilibrium {
public:
    Equilibrium(const Model<double>& model, const Input<double>& input, const State<double>& start)
        : model_(model), input_(input), start_(start), R_(velocity_block(model, start, input).R_GC) {
        input_.rack.rate = input_.rack.acceleration = 0;
        for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
            std::visit([&](const auto& s) { unknowns_ += std::decay_t<decltype(s)>::Linkage::nV; },
                       model.vehicle.spokes[i].suspension);
        }
    }
    int unknowns() const { return unknowns_; }

    State<double> state_at(const Eigen::VectorXd& x) const {
        const Mat3<double> R = R_ * axis_rotation<double>(Vec3<double>::UnitX(), x[1]) *
                               axis_rotation<double>(Vec3<double>::UnitY(), x[2]);
        State<double> state = design_state(model_, Vec3<double>(start_.position()) + model_.road.normal * x[0], R);
        int next = 3;
        for_each_independent(
            [&](int i, int j) { state.spoke(i).independent[j] = start_.spoke(i).independent[j] + x[next++]; });
        for (int i = 0; i < model_.vehicle.spoke_count(); ++i) {
            for (int j = 0; j < max_dependent; ++j) state.spoke(i).dependent[j] = start_.spoke(i).dependent[j];
        }
        close_loops(model_, input_.rack, state, 10);
        const auto velocity = velocity_block(model_, state, input_);
        const Vec3<double> gravity = velocity.R_GC.transpose() * Vec3<double>(0, 0, -model_.vehicle.gravity);
        hold_on_slope(model_, input_, momenta_block(model_, state, input_, velocity), gravity, state);
        return state;
    }

    Eigen::VectorXd residual(const Eigen::VectorXd& x) const {
        const State<double> state = state_at(x);
        const auto velocity = velocity_block(model_, state, input_);
        const auto momenta = momenta_block(model_, state, input_, velocity);
        Vec3<double> moment = model_.vehicle.chassis_inertia.moment;  // mass times center, of the whole car
        for (int i = 0; i < model_.vehicle.spoke_count(); ++i) {
            visit_spoke(model_.vehicle, velocity, i,
                        [&](const auto&, const auto&, const auto& at) { moment += at.inertia.moment; });
        }
        const Vec3<double> center = moment / model_.vehicle.total_mass;
        const Vec3<double> F = momenta.external.head<3>();
        const Vec3<double> N = Vec3<double>(momenta.external.tail<3>()) - center.cross(F);
        Eigen::VectorXd r(unknowns_);
        r[0] = F.dot(velocity.R_GC.transpose() * model_.road.normal);
        r[1] = N[0], r[2] = N[1];
        int next = 3;
        for_each_independent([&](int i, int j) { r[next++] = momenta.spokes[i].momentum_rate[j]; });
        return r;
    }

private:
    template <class F>
    void for_each_independent(F&& f) const {
        for (int i = 0; i < model_.vehicle.spoke_count(); ++i) {
            std::visit(
                [&](const auto& s) {
                    for (int j = 0; j < std::decay_t<decltype(s)>::Linkage::nV; ++j) f(i, j);
                },
                model_.vehicle.spokes[i].suspension);
        }
    }

    const Model<double>& model_;
    Input<double> input_;
    const State<double>& start_;
    Mat3<double> R_;
    int unknowns_ = 3;
};

Eigen::MatrixXd finite_difference_jacobian(const Equilibrium& problem, const Eigen::VectorXd& x) {
    constexpr double step = 1e-6;
    Eigen::MatrixXd jacobian(problem.unknowns(), problem.unknowns());
    for (int j = 0; j < problem.unknowns(); ++j) {
        Eigen::VectorXd above = x, below = x;
        above[j] += step, below[j] -= step;
        jacobian.col(j) = (problem.residual(above) - problem.residual(below)) / (2 * step);
    }
    return jacobian;
}

// Puts the lowest wheel a typical static deflection into the road, so that Newton starts in contact.
void touch_road(const Model<double>& model, const Input<double>& input, State<double>& state) {
    constexpr double static_deflection = 0.015;
    const auto velocity = velocity_block(model, state, input);
    const auto momenta = momenta_block(model, state, input, velocity);
    double deepest = -1e9;
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        deepest = std::max(deepest, momenta.spokes[i].forces.frame.depth);
    }
    state.position() += model.road.normal * (deepest - static_deflection);
}

}  // namespace

EquilibriumResult settle(const Model<double>& model, Input<double> input, State<double>& state) {
    constexpr int max_iterations = 60;
    input.drive_torque = 0;
    close_loops(model, input.rack, state, 10);
    touch_road(model, input, state);
    const State<double> start = state;
    const Equilibrium problem(model, input, start);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.unknowns());
    Eigen::VectorXd r = problem.residual(x);
    const double weight = model.vehicle.total_mass * model.vehicle.gravity;
    for (int i = 0; i < max_iterations && r.norm() > 1e-12 * weight; ++i) {
        const Eigen::VectorXd full = finite_difference_jacobian(problem, x).partialPivLu().solve(r);
        double share = std::min(1.0, 0.1 / full.lpNorm<Eigen::Infinity>());  // stay within the range of the linkages
        Eigen::VectorXd best = problem.residual(x - share * full);
        while (!(best.norm() < r.norm()) && share > 1e-3) {
            share /= 2;
            best = problem.residual(x - share * full);
        }
        if (!(best.norm() < r.norm())) break;  // at round-off, or stuck
        x -= share * full;
        r = best;
    }
    state = problem.state_at(x);
    const double residual = r.lpNorm<Eigen::Infinity>();
    return {residual < 1e-6 * weight, residual};
}

}  // namespace hamilcar
