#include "hamilcar/block/equilibrium.hpp"

#include "hamilcar/block/freedoms.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/block/integration.hpp"
#include "hamilcar/block/road_wheels.hpp"
#include "hamilcar/math/dense.hpp"
#include "hamilcar/tire/contact_deflection.hpp"

namespace hamilcar {

namespace {

// Tire deflections and brake wind-up that balance the component of the weight along the road. Laterally every wheel takes a
// share in proportion to its load; longitudinally the braked wheels do, if their brakes can hold.
void hold_on_slope(const Model<double>& model, const Velocity<double>& velocity, const Momenta<double>& momenta,
                   State<double>& state) {
    const std::vector<RoadWheel> wheels = road_wheels(model, momenta, state);
    const auto braking_torque = [&](const RoadWheel& wheel) { return momenta.brakes.limit[wheel.number]; };
    double total_load = 0, braked_load = 0;
    for (const RoadWheel& wheel : wheels) {
        for (const RoadTire& tire : wheel.tires) {
            total_load += tire.forces->tire.Fz;
            if (braking_torque(wheel) > 0) braked_load += tire.forces->tire.Fz;
        }
    }
    const double share = braked_load > 0 ? total_load / braked_load : 0;
    struct Pull {
        double along, across;  // per load
    };
    const auto pull = [&](const RoadWheel& wheel, const RoadTire& tire) {
        const Vec3<double> gravity = gravity_in_unit(model, velocity, momenta, wheel.unit);
        const ContactFrame<double>& frame = tire.forces->frame;
        const double pressing = -gravity.dot(frame.normal);
        return Pull{braking_torque(wheel) > 0 ? -share * gravity.dot(frame.longitudinal) / pressing : 0,
                    -gravity.dot(frame.lateral) / pressing};
    };
    bool brakes_hold = braked_load > 0;
    for (const RoadWheel& wheel : wheels) {
        double torque = 0;
        for (const RoadTire& tire : wheel.tires) {
            torque += std::abs(pull(wheel, tire).along * tire.forces->tire.Fz) * rolling_radius(*tire.tire);
        }
        brakes_hold = brakes_hold && torque <= braking_torque(wheel);
    }
    for (const RoadWheel& wheel : wheels) {
        *wheel.windup = 0;
        for (const RoadTire& tire : wheel.tires) {
            const double load = tire.forces->tire.Fz;
            const Pull p = pull(wheel, tire);
            const double x = brakes_hold ? p.along : 0.0;
            const auto deflection = contact_deflection(*tire.tire, tire.forces->contact, x * load, p.across * load);
            *tire.u = deflection.u, *tire.v = deflection.v;
            if (deflection.u != 0) *wheel.windup -= rolling_radius(*tire.tire) * x * load * wheel.brake->compliance;
        }
    }
}

// Normal of the ground below the vehicle, in ground axes: the road plane's, or the mean over the wheels' contacts.
Vec3<double> ground_normal(const Model<double>& model, const Input<double>& input, State<double>& state) {
    if (!model.surface) return model.road.normal;
    const auto velocity = velocity_block(model, state, input);
    const auto momenta = momenta_block(model, state, input, velocity);
    Vec3<double> sum = Vec3<double>::Zero();
    for (const RoadWheel& wheel : road_wheels(model, momenta, state)) {
        if (wheel.unit != 0) continue;
        for (const RoadTire& tire : wheel.tires) sum += tire.forces->frame.normal;
    }
    return (velocity.R_GC * sum).normalized();
}

// The equilibrium problem: unknowns heave, roll, pitch, then every V and the hitches' angles but yaw, which is indifferent;
// residuals force along the ground's normal, moments about the center of mass along chassis x and y, then every rate of those
// momenta.
class Equilibrium {
public:
    Equilibrium(const Model<double>& model, const Input<double>& input, const Vec3<double>& normal,
                const State<double>& start, const std::vector<bool>& held)
        : model_(model), input_(input), normal_(normal), start_(start), R_(velocity_block(model, start, input).R_GC) {
        input_.rack.rate = input_.rack.acceleration = 0;
        for (const StateFreedom& freedom : state_freedoms(model.vehicle)) {
            const auto suspension = static_cast<std::size_t>(freedom.suspension);
            const bool is_held = freedom.suspension >= 0 && suspension < held.size() && held[suspension];
            if (!freedom.hitch_yaw && !is_held) freedoms_.push_back(freedom);
        }
    }
    Eigen::Index unknowns() const { return 3 + static_cast<Eigen::Index>(freedoms_.size()); }

    State<double> state_at(const Eigen::VectorXd& x) const {
        State<double> state = start_;
        place_chassis(model_, Vec3<double>(start_.position()) + normal_ * x[0],
                      R_ * axis_rotation<double>(Vec3<double>::UnitX(), x[1]) *
                          axis_rotation<double>(Vec3<double>::UnitY(), x[2]),
                      state);
        for (std::size_t i = 0; i < freedoms_.size(); ++i) {
            state.values[static_cast<std::size_t>(freedoms_[i].coordinate)] += x[3 + static_cast<Eigen::Index>(i)];
        }
        close_loops(model_, input_.rack, state, 10);
        const auto velocity = velocity_block(model_, state, input_);
        hold_on_slope(model_, velocity, momenta_block(model_, state, input_, velocity), state);
        return state;
    }

    Eigen::VectorXd residual(const Eigen::VectorXd& x) const {
        const State<double> state = state_at(x);
        const auto velocity = velocity_block(model_, state, input_);
        const auto momenta = momenta_block(model_, state, input_, velocity);
        State<double> rate;
        rate_of_state(model_, state, velocity, momenta, rate);
        const Vec3<double> center = mass_moment(model_, velocity) / model_.vehicle.total_mass;
        const Vec3<double> F = momenta.external.head<3>();
        const Vec3<double> N = Vec3<double>(momenta.external.tail<3>()) - center.cross(F);
        Eigen::VectorXd r(unknowns());
        r[0] = F.dot(velocity.R_GC.transpose() * normal_);
        r[1] = N[0], r[2] = N[1];
        for (std::size_t i = 0; i < freedoms_.size(); ++i) {
            r[3 + static_cast<Eigen::Index>(i)] = rate.values[static_cast<std::size_t>(freedoms_[i].momentum)];
        }
        return r;
    }

private:
    const Model<double>& model_;
    Input<double> input_;
    Vec3<double> normal_;
    const State<double>& start_;
    Mat3<double> R_;
    std::vector<StateFreedom> freedoms_;
};

Eigen::MatrixXd finite_difference_jacobian(const Equilibrium& problem, const Eigen::VectorXd& x) {
    constexpr double step = 1e-6;
    Eigen::MatrixXd jacobian(problem.unknowns(), problem.unknowns());
    for (Eigen::Index j = 0; j < problem.unknowns(); ++j) {
        Eigen::VectorXd above = x, below = x;
        above[j] += step, below[j] -= step;
        jacobian.col(j) = (problem.residual(above) - problem.residual(below)) / (2 * step);
    }
    return jacobian;
}

// Puts the lowest wheel a typical static deflection into the road, so that Newton's method starts in contact.
void touch_road(const Model<double>& model, const Input<double>& input, const Vec3<double>& normal,
                State<double>& state) {
    constexpr double static_deflection = 0.015;
    const auto velocity = velocity_block(model, state, input);
    const auto momenta = momenta_block(model, state, input, velocity);
    double deepest = -1e9, sum = 0;
    int count = 0;
    for (const RoadWheel& wheel : road_wheels(model, momenta, state)) {
        for (const RoadTire& tire : wheel.tires) {
            deepest = std::max(deepest, tire.forces->frame.depth);
            sum += tire.forces->frame.depth, ++count;
        }
    }
    // On uneven ground the wheels' mean: a single high one would hold the others in the air.
    state.position() += normal * ((model.surface ? sum / count : deepest) - static_deflection);
}

}  // namespace

EquilibriumResult settle(const Model<double>& model, Input<double> input, State<double>& state,
                         const std::vector<bool>& held) {
    constexpr int max_iterations = 60;
    input.drive_torque = 0;
    hold_inputs(model, input, state);
    close_loops(model, input.rack, state, 10);
    const Vec3<double> normal = ground_normal(model, input, state);
    touch_road(model, input, normal, state);
    const State<double> start = state;
    const Equilibrium problem(model, input, normal, start, held);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.unknowns());
    Eigen::VectorXd r = problem.residual(x);
    const double weight = model.vehicle.total_mass * model.vehicle.gravity;
    for (int i = 0; i < max_iterations && r.norm() > 1e-12 * weight; ++i) {
        const Eigen::VectorXd full = solve(finite_difference_jacobian(problem, x), r);
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
